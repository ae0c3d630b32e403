// test_gap_columns.c - the columns of candidates in a log that misses commands.
#include "gap/4_candidates/candidates.h"
#include "rig/gap_track.h"
#include "rig/test.h"
#include <math.h>
#include <string.h>

#define EVERY 10 // of the samples of 500 Hz

static void thin(gap_track_t *t) {
  gap_track_thin(t, EVERY);
}

static void thin_to_means(gap_track_t *t) {
  thin(t);
  t->flight[0].rows_are_means = t->flight[1].rows_are_means = true;
}

// Of two columns of one flight about their means.
static double alike(const double *a, const double *b, int n) {
  double sa = 0.0, sb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (int i = 0; i < n; i++) sa += a[i] / n, sb += b[i] / n;
  for (int i = 0; i < n; i++)
    aa += (a[i] - sa) * (a[i] - sa), bb += (b[i] - sb) * (b[i] - sb), ab += (a[i] - sa) * (b[i] - sb);
  return aa * bb > 0.0 ? fabs(ab) / sqrt(aa * bb) : 0.0;
}

// The first candidate of that name.
static const candidate_t *find(const candidates_t *c, const char *name) {
  for (int i = 0; i < c->n; i++)
    if (strcmp(c->candidate[i].use.fx->name, name) == 0) return &c->candidate[i];
  return NULL;
}

// How much of a column about x is what the commands predict of the turning: inertia's is that alone.
static double scale_in(const design_t *t, const set_t *s, const candidates_t *c, const char *name) {
  const double *const own = t->x[CH_WX][find(c, name)->first], *const all =
                                                                   t->x[CH_WX][find(c, "inertia")->first];
  double most = 0.0;
  for (int f = 0; own && f < s->n_grid; f++) {
    const int from = rows_from(&s->smooth, f), n = rows_from(&s->smooth, f + 1) - from;
    most = fmax(most, alike(own + from, all + from, n));
  }
  return most;
}

TEST(gap_leaves_a_scale_of_the_turning_out_of_slopes_and_bends_where_a_log_misses_commands) {
  static const struct {
    const char *what;
    void (*spoil)(gap_track_t *t);
    bool left_out;
  } row[] = {
      {"every command", NULL, false}, {"one in ten", thin, true}, {"means of ten", thin_to_means, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    gap_track_t r;
    candidates_t c;
    design_t t;
    why_t why = {""};
    if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = row[i].spoil}, &why))) return;
    CHECK_OK(candidates_make(&c, &r.vehicle, &r.set, &why));
    CHECK_OK(design_make(&t, &r.set, &r.vehicle, &c, &(chosen_t){.n = 0}, &why));
    CHECK_TEXT(why.text, "");
    const double slope = scale_in(&t, &r.set, &c, "thrust_slope"),
                 scale = scale_in(&t, &r.set, &c, "thrust_scale");
    CHECK(row[i].left_out ? slope < 1e-6 : slope > 0.9);
    CHECK(scale > 0.9); // the forces tell it
    design_free(&t);
    candidates_free(&c);
    gap_track_free(&r);
  }
}

// One name, by so much of what is typical.
static chosen_t with(const candidates_t *c, const char *name, double by) {
  chosen_t chosen = {.n = 0};
  const candidate_t *const own = find(c, name);
  fx_use_resize(chosen_take(&chosen, c, (int)(own - c->candidate)), 0, by * own->typical[0]);
  return chosen;
}

// Row 10 of a column; one that is zero throughout is not there.
static double at(const design_t *t, int channel, int column) {
  return t->x[channel][column] ? t->x[channel][column][10] : 0.0;
}

// What a heavier vehicle's thrust does is less; by a fifth of what is typical nobody minds. More thrust of a
// rotor that leans pushes to a side.
TEST(gap_forms_columns_anew_from_a_quarter_of_what_is_typical_on) {
  static const struct {
    const char *name;
    int channel;
    double by;
    bool anew;
  } row[] = {{"mass", CH_FZ, 0.2, false},       {"mass", CH_FZ, 0.3, true},
             {"mass", CH_FZ, -0.2, false},      {"mass", CH_FZ, -0.3, true},
             {"motor_tilt", CH_FX, 0.2, false}, {"motor_tilt", CH_FX, 1.0, true}};
  gap_track_t r;
  candidates_t c;
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  CHECK_OK(candidates_make(&c, &r.vehicle, &r.set, &why));
  const int scale = find(&c, "thrust_scale")->first;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s by %g", row[i].name, row[i].by);
    design_t t, fresh;
    const chosen_t before = with(&c, row[i].name, 0.0), now = with(&c, row[i].name, row[i].by);
    CHECK_OK(design_make(&t, &r.set, &r.vehicle, &c, &before, &why));
    const double was = at(&t, row[i].channel, scale);
    CHECK_OK(design_make(&fresh, &r.set, &r.vehicle, &c, &now, &why));
    CHECK_OK(design_renew(&t, &r.set, &r.vehicle, &c, &now, true, &why));
    const double anew = at(&fresh, row[i].channel, scale);
    CHECK(anew != was && at(&t, row[i].channel, scale) == (row[i].anew ? anew : was));
    design_free(&t);
    design_free(&fresh);
  }
  candidates_free(&c);
  gap_track_free(&r);
}
