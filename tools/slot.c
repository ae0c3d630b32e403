// slot.c - the hover in a gap of 71 mm, simulated with each form of the ceiling effect, beside the real
// flights.
#include "base/made.h"
#include "flight/slot_many.h"

#include <stdio.h>
#include <string.h>

#define SEEDS 80

static void print(const char *what, const slot_many_t *m) {
  char median[64] = "-", closest[16] = "-";
  if (m->captured > 0)
    snprintf(median, sizeof median, "%.1f (%.1f to %.1f)", 1e3 * m->median_m, 1e3 * m->low_m,
             1e3 * m->high_m);
  if (m->captured < m->flights) snprintf(closest, sizeof closest, "%.1f", 1e3 * m->free_m);
  printf("%-46s %3d of %d  %19s  %9s ", what, m->captured, m->flights, median, closest);
  for (int k = 0; k < SLOT_FLIGHTS; k++) printf(" %2d", m->captured_as[k]);
  putchar('\n');
}

static done_t fly(const char *what, fly_kind_t kind, const char *effect, double mass_kg, why_t *why) {
  const slot_case_t c = {kind, effect, mass_kg, true, SLOT_RISE_M, SEEDS};
  slot_many_t m;
  TRY(slot_fly_many(&c, &m, why));
  print(what, &m);
  return DONE;
}

// Published ceiling effects. Weight over thrust is known only to some grams, so that each flies with several
// masses.
static const struct {
  const char *name, *effect;
  int low_g, high_g;
} form[] = {
    {"square root", SLOT_CEILING, 34, 38},
    {"exponential (thesis)", "ceiling:form=exponential,Ca=0.44,Cb=1.8", 32, 36},
    {"Cheeseman and Bennett", "ceiling:form=cheeseman-bennett", 32, 36},
};

static done_t fly_forms(why_t *why) {
  for (unsigned i = 0; i < sizeof form / sizeof *form; i++)
    for (int g = form[i].low_g; g <= form[i].high_g; g++) {
      char what[64];
      snprintf(what, sizeof what, "stock PID, %s, %d g", form[i].name, g);
      TRY(fly(what, FLY_STOCK_PID, form[i].effect, 1e-3 * g, why));
    }
  return DONE;
}

static done_t run(const char *folder, why_t *why) {
  slot_many_t m;
  if (folder) TRY(slot_real_many(folder, &m, why));
  printf("%-46s %9s  %19s  %9s  %s\n", "", "captured", "their gap mm", "free mm", "captured, by real flight");
  if (folder) print("real flights, stock PID", &m);
  if (!folder) puts("real flights: skipped, no measured data");
  TRY(fly_forms(why));
  return fly("air garage, square root, 36 g", FLY_AIR_GARAGE, SLOT_CEILING, 0.0, why);
}

static const char USAGE[] = "usage: slot [FOLDER of recorded flights]\n       slot --version\n";

int main(int argc, char **argv) {
  why_t why;
  const char *const folder = argc > 1 && argv[1][0] ? argv[1] : NULL;
  if (argc == 2 && strcmp(argv[1], "--help") == 0) {
    fputs(USAGE, stdout);
    return 0;
  }
  if (argc == 2 && strcmp(argv[1], "--version") == 0) {
    made_version("slot");
    return 0;
  }
  const bool bad = argc > 2 || (folder && folder[0] == '-');
  const done_t status =
      bad ? error_set(&why, "%s: allowed: slot [FOLDER of recorded flights]", argv[argc > 2 ? 2 : 1])
          : run(folder, &why);
  return error_exit("slot", status, &why);
}
