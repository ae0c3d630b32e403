// app.c - appMain(): says on the console what flies, what is missing and what was found wrong.
#include "app.h"

#include "FreeRTOS.h"
#include "glue.h"
#include "param.h"
#include "radio.h"
#include "platform_defaults.h"
#include "task.h"

#define DEBUG_MODULE "CEIL"
#include "debug.h"

#ifndef APP_VERSION
#define APP_VERSION "of unknown version"
#endif

#ifdef CONFIG_CRAZYFLIE_LEGACY_PROPELLERS
#define PROPELLERS "legacy propellers"
#elif defined(CONFIG_CRAZYFLIE_21_PLUS)
#define PROPELLERS "2.1+ propellers"
#else
#error "built for neither legacy nor 2.1+ propellers: curve, limits and inertia here are theirs"
#endif

static bool is_there(const char *deck) {
  const paramVarId_t id = paramGetVarId("deck", deck);
  return PARAM_VARID_IS_VALID(id) && paramGetUint(id) != 0;
}

static void report_decks(void) {
  GLUE.decks = (is_there("bcFlow2") ? DECK_FLOW : 0) | (is_there("bcMultiranger") ? DECK_MULTIRANGER : 0);
  if (!(GLUE.decks & DECK_FLOW)) DEBUG_PRINT("MISSING: flow deck v2. There is no position to hold\n");
  if (!(GLUE.decks & DECK_MULTIRANGER)) DEBUG_PRINT("MISSING: multiranger deck. No ceiling will be seen\n");
  if (GLUE.decks == (DECK_FLOW | DECK_MULTIRANGER)) DEBUG_PRINT("Flow and multiranger decks are there\n");
  if (is_there("bcUSD")) DEBUG_PRINT("uSD deck is there\n");
}

static void report_flyable(unsigned not_flyable) {
#define SAY(bit, reason, words)                                                                              \
  if (not_flyable & FLYABLE_##reason) DEBUG_PRINT("NOT FLYABLE: " words "\n");
  FLYABLE_REASONS(SAY)
  if (not_flyable == 0) DEBUG_PRINT("Flyable again\n");
}

static void report_who_flies(bool shadow) {
  if (shadow)
    DEBUG_PRINT("SHADOW: the stock controller flies, this one computes (ceil.shadow 0: it flies)\n");
  else
    DEBUG_PRINT("This controller flies (ceil.shadow 1: the stock one)\n");
}

static void report_not_flown(unsigned kinds) {
  if (kinds & NOT_FLOWN_RATES) DEBUG_PRINT("REFUSED: set points of rates. Level, at that thrust\n");
  if (kinds & NOT_FLOWN_QUAT)
    DEBUG_PRINT("REFUSED: attitude as quaternion without position. Level, at that thrust\n");
  if (kinds & NOT_FLOWN_TURN)
    DEBUG_PRINT("REFUSED: rates of roll and pitch of a full state. The rest is flown\n");
}

// What was reported last.
typedef struct {
  unsigned not_flyable, latched, refused, not_flown;
  bool shadow, mixed;
} reported_t;

static reported_t now(void) {
  return (reported_t){.not_flyable = GLUE.flyable.not_flyable,
                      .latched = GLUE.flight.guard.latched,
                      .refused = GLUE.sets_refused,
                      .not_flown = GLUE.not_flown,
                      .shadow = GLUE.shadow != 0,
                      .mixed = GLUE.weights_mixed != 0};
}

static reported_t report_changes(reported_t was) {
  const reported_t is = now();
  if (is.shadow != was.shadow) report_who_flies(is.shadow);
  if (is.mixed && !was.mixed)
    DEBUG_PRINT(
        "WEIGHTS REFUSED: w1..w7 of ceil and ground are not one set (ceil.wSum). The last good ones fly\n");
  if (is.not_flyable != was.not_flyable) report_flyable(is.not_flyable);
  if (is.latched != was.latched) DEBUG_PRINT("Guard: reasons 0x%x\n", is.latched);
  if (is.refused != was.refused)
    DEBUG_PRINT("Parameters refused (out of range, or against each other): the last good set flies\n");
  report_not_flown(is.not_flown & ~was.not_flown);
  return is;
}

void appMain(void) {
  reported_t reported = {.shadow = GLUE.shadow == 0};
  DEBUG_PRINT("Ceiling controller " APP_VERSION ", for " PROPELLERS "\n");
  report_decks();
  for (;;) {
    reported = report_changes(reported);
    for (int i = 0; i < 5; i++) {
      vTaskDelay(M2T(100));
      radio_watch();
    }
  }
}
