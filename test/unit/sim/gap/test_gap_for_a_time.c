// test_gap_for_a_time.c - what has no name is told to act as an effect that began or ended would.
#include "gap/5_infer/for_a_time.h"
#include "gap/5_infer/coordinates.h"
#include "rig/gap_track.h"
#include "rig/test.h"

#include <string.h>

static double from_s, to_s;

// Another tenth of specific force upwards for a time: so much less mass.
static void lighten(gap_track_t *t) {
  for (int f = 0; f < 2; f++)
    for (int i = 0; i < t->flight[f].n; i++) {
      const double t_s = t->flight[f].t_s[i] - t->flight[f].t_s[0];
      if (t_s >= from_s && t_s < to_s) t->flight[f].v[SIG_AZ][i] *= 1.1;
    }
}

static bool would(const for_a_time_t *f, const char *name) {
  for (int i = 0; i < f->as.n; i++)
    if (strcmp(f->as.would[i].use.fx->name, name) == 0) return true;
  return false;
}

// also: something else was found first.
static for_a_time_t look(int along, double cell_from_s, double cell_to_s, bool also) {
  gap_track_t t;
  candidates_t c;
  lines_t left;
  for_a_time_t f = {.outside = false};
  why_t why = {""};
  const chosen_t none = {.n = 0};
  const cell_t nowhere = {.statistic = 0.0},
               cell = {
                   .along = along, .from = cell_from_s, .to = cell_to_s, .channel = CH_FZ, .statistic = 20.0};
  if (!CHECK_OK(gap_track_make(&t, &(gap_track_job_t){.spoil = lighten}, &why))) return f;
  CHECK_OK(candidates_make(&c, &t.vehicle, &t.set, &why));
  CHECK_OK(residual_lines(&t.set, &t.vehicle, &left, &why));
  CHECK_OK(for_a_time(&f, &t.set, left.r, &t.vehicle, &c, &none, also ? &nowhere : &cell,
                      also ? &cell : &nowhere, &why));
  lines_free(&left);
  candidates_free(&c);
  gap_track_free(&t);
  return f;
}

TEST(gap_says_as_which_effect_something_acts_for_a_time) {
  static const struct {
    double from_s, to_s;           // when it acts
    double cell_from_s, cell_to_s; // what is found
    int along;
    bool also, told, outside;
  } row[] = {{10.0, 25.0, 10.0, 25.0, COORDINATE_TIME, false, true, false},
             {15.0, 99.0, 0.0, 15.0, COORDINATE_TIME, false, true, true},
             {10.0, 25.0, 10.0, 25.0, COORDINATE_TIME, true, true, false},
             {10.0, 13.5, 10.0, 13.5, COORDINATE_TIME, false, false, false}, // a touch: less than two blocks
             {0.0, 99.0, 10.0, 25.0, COORDINATE_TIME, false, false, false},  // always
             {10.0, 25.0, 10.0, 25.0, COORDINATE_HEIGHT, false, false, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("from %g to %g s, seen from %g to %g", row[i].from_s, row[i].to_s, row[i].cell_from_s,
        row[i].cell_to_s);
    from_s = row[i].from_s;
    to_s = row[i].to_s;
    const for_a_time_t f = look(row[i].along, row[i].cell_from_s, row[i].cell_to_s, row[i].also);
    CHECK((f.as.n > 0) == row[i].told);
    if (!row[i].told) continue;
    CHECK(f.outside == row[i].outside);
    CHECK(would(&f, "mass") && !would(&f, "rotor_drag") && !would(&f, "inertia"));
    CHECK(f.as.would[0].share > 0.8 && f.as.would[0].share <= 1.0);
  }
}
