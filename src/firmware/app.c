// app.c - appMain(): says on the console what is missing and what was found wrong.
#include "app.h"

#include "FreeRTOS.h"
#include "glue.h"
#include "param.h"
#include "task.h"

#define DEBUG_MODULE "CEIL"
#include "debug.h"

static bool is_there(const char *deck) {
  const paramVarId_t id = paramGetVarId("deck", deck);
  return PARAM_VARID_IS_VALID(id) && paramGetUint(id) != 0;
}

static void check_decks(void) {
  GLUE.decks = (is_there("bcFlow2") ? DECK_FLOW : 0) | (is_there("bcMultiranger") ? DECK_MULTIRANGER : 0);
  if (!(GLUE.decks & DECK_FLOW)) DEBUG_PRINT("MISSING: flow deck v2. There is no position to hold\n");
  if (!(GLUE.decks & DECK_MULTIRANGER)) DEBUG_PRINT("MISSING: multiranger deck. No ceiling will be seen\n");
  if (GLUE.decks == (DECK_FLOW | DECK_MULTIRANGER)) DEBUG_PRINT("Flow and multiranger decks are there\n");
}

static void tell_flyable(unsigned not_flyable) {
  if (not_flyable & FLYABLE_UP) DEBUG_PRINT("NOT FLYABLE: at rest the accelerometer does not point up\n");
  if (not_flyable & (FLYABLE_TURN_X | FLYABLE_TURN_Y))
    DEBUG_PRINT("NOT FLYABLE: gyro and accelerometer contradict each other\n");
  if (not_flyable == 0) DEBUG_PRINT("Flyable again\n");
}

void appMain(void) {
  unsigned not_flyable = 0, latched = 0, refused = 0;
  check_decks();
  for (;;) {
    vTaskDelay(M2T(500));
    if (GLUE.flyable.not_flyable != not_flyable) tell_flyable(GLUE.flyable.not_flyable);
    if (GLUE.flight.guard.latched != latched) DEBUG_PRINT("Guard: reasons 0x%x\n", GLUE.flight.guard.latched);
    if (GLUE.sets_refused != refused) DEBUG_PRINT("Parameters out of range, the last good set flies on\n");
    not_flyable = GLUE.flyable.not_flyable;
    latched = GLUE.flight.guard.latched;
    refused = GLUE.sets_refused;
  }
}
