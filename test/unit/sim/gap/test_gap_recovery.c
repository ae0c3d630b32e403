// test_gap_recovery.c - every effect of the library, hidden at its nominal size in two flights (lag and
// delay: a fifth more): it is named, or the workflow says that these flights could not show it.
#include "rig/gap_case.h"
#include "rig/test.h"

#include <string.h>

// May be silent: these flights are too slow, or too seldom near a surface, for the nominal size; no wall is
// known.
static const char *const SILENT[] = {"body_drag", "ceiling",   "ceiling_rpm",       "ground",
                                     "sidewall",  "tof_floor", "translational_lift"};

static bool is_silent(const char *name) {
  for (unsigned i = 0; i < sizeof SILENT / sizeof *SILENT; i++)
    if (strcmp(SILENT[i], name) == 0) return true;
  return false;
}

static bool says_so(const gap_case_t *c, const fx_t *fx) {
  return c->d.unknown || candidates_obstacle(fx, &c->given, &c->d.fit) ||
         found_least(&c->d.found, &c->d.candidates, fx, NULL) > 1.0;
}

TEST(gap_finds_every_effect_of_the_library_or_says_that_it_could_not) {
  const int step = test_long() ? 1 : 8; // the other effects are hidden in the long form
  for (int i = 0; i < fx_count; i += step) {
    const fx_t *const fx = fx_table[i];
    ROW("%s", fx->name);
    gap_hidden_t hidden = {1, {fx_use(fx)}};
    // A period of the log is the least that is named.
    if (fx->group == FX_TIMING && fx->n_size)
      fx_use_resize(&hidden.use[0], 0, 1.2 * fx_use_size(&hidden.use[0], 0));
    gap_case_t *const c = gap_case(&hidden, &hidden);
    const bool alone = c->d.found.n == 1 && gap_case_named(c, fx->name);
    if (alone)
      CHECK(c->d.held_out.left_after < c->d.held_out.left_before);
    else
      CHECK(c->d.found.n == 0 && is_silent(fx->name) && says_so(c, fx));
    gap_case_free(c);
  }
}
