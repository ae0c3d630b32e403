// test_gap_nominal.c - nominal flights: tracks with holes, flights that cannot be flown, and the disturbance
// of the log.
#include "base/lane.h"
#include "base/random.h"
#include "body/side_by_side.h"
#include "gap/2_predict/lines.h"
#include "gap/5_infer/loop_fit.h"
#include "gap/5_infer/nominal_sums.h"
#include "rig/gap_track.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

static void spoil_a_sample(gap_track_t *r) {
  gap_flight_t *const f = &r->flight[0];
  for (int i = f->n / 2; i < f->n / 2 + 40; i++)
    f->v[SIG_X][i] = f->v[SIG_VZ][i] = f->v[SIG_QX][i] = (double)NAN;
  f->v[SIG_VBAT][f->n / 3] = (double)NAN;
}

TEST(gap_nominal_flight_is_not_poisoned_by_a_sample_that_is_not_there) {
  gap_track_t r;
  why_t why = {""};
  gap_flight_t flown;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = spoil_a_sample}, &why))) return;
  if (!CHECK_OK(nominal_fly(&r.set.grid[0], &r.vehicle, &r.loop, 5, &flown, NULL, &why))) return;
  const grid_t *const g = &r.set.grid[0];
  const double most_N = r.vehicle.thrust_max_N / ROTORS;
  int bad = 0, far = 0, at_limit = 0;
  for (int i = 0; i < flown.n; i++) {
    const d3_t track = g->point[i / g->every].pos_w_m; // NaN where x is not there: no distance
    const double m1_N = flown.v[SIG_M1][i];
    at_limit += m1_N <= 0.0 || m1_N >= most_N;
    bad += !isfinite(flown.v[SIG_Z][i]) || !isfinite(flown.v[SIG_M1][i]);
    far += fabs(flown.v[SIG_Y][i] - track.y) > 0.5 || fabs(flown.v[SIG_X][i] - track.x) > 0.5;
  }
  ROW("%d bad, %d far, %d at a limit of %d", bad, far, at_limit, flown.n);
  CHECK(bad == 0);
  CHECK(far < flown.n / 50);
  CHECK(at_limit < flown.n / 50);
  gap_flight_free(&flown);
  gap_track_free(&r);
}

// Not the smoothed ones: the pilot saw no better.
TEST(gap_nominal_pilots_follow_places_as_they_were_logged) {
  gap_track_t r;
  why_t why = {""};
  gap_flight_t flown;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  const grid_t *const g = &r.set.grid[0];
  bool smoothed = false;
  for (int j = 0; j < g->n; j++) {
    smoothed = smoothed || g->point[j].pos_w_m.y != g->point[j].seen_w_m.y;
    g->point[j].seen_w_m.y += 0.3;
  }
  CHECK(smoothed); // what is read from a log is
  if (!CHECK_OK(nominal_fly(g, &r.vehicle, &r.loop, 5, &flown, NULL, &why))) return;
  double off_m = 0.0;
  for (int i = 0; i < flown.n; i++) off_m += (flown.v[SIG_Y][i] - g->point[i / g->every].pos_w_m.y) / flown.n;
  CHECK_NEAR(off_m, 0.3, 0.1);
  gap_flight_free(&flown);
  gap_track_free(&r);
}

static double shaking_N(const gap_flight_t *f) {
  double squares = 0.0;
  for (int i = 3; i < f->n; i++) {
    const double *const v = f->v[SIG_M1] + i, x = v[0] - 3.0 * v[-1] + 3.0 * v[-2] - v[-3];
    squares += x * x;
  }
  return sqrt(squares / (20.0 * f->n));
}

// Of a log whose noise its pilot did not see: it follows a smooth track, and the log is as noisy all the
// same.
TEST(gap_nominal_pilots_may_be_spared_a_logs_noise) {
  gap_track_t r;
  why_t why = {""};
  double shaking[2], gyro[2] = {0.0};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  r.loop.gyro_radps[0] = r.loop.gyro_radps[1] = 0.05;
  for (int spared = 0; spared < 2; spared++) {
    gap_flight_t flown;
    r.loop.spared = spared;
    if (!CHECK_OK(nominal_fly(&r.set.grid[0], &r.vehicle, &r.loop, 5, &flown, NULL, &why))) return;
    shaking[spared] = shaking_N(&flown);
    for (int i = 1; i < flown.n; i++)
      gyro[spared] += fabs(flown.v[SIG_GX][i] - flown.v[SIG_GX][i - 1]) / flown.n;
    gap_flight_free(&flown);
  }
  CHECK(shaking[1] < 0.2 * shaking[0]);
  CHECK_NEAR(gyro[1] / gyro[0], 1.0, 0.2);
  gap_track_free(&r);
}

// A track that goes on by steps has its commands step with it, and a log of them misses none.
TEST(gap_nominal_pilots_are_told_their_track_between_its_points) {
  gap_track_t r;
  why_t why = {""};
  gap_flight_t flown;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  closed_loop_t calm = r.loop;
  memset(calm.gyro_radps, 0, sizeof calm.gyro_radps);
  memset(calm.force_mps2, 0, sizeof calm.force_mps2);
  memset(calm.quick_mps2, 0, sizeof calm.quick_mps2);
  memset(calm.turn_radps2, 0, sizeof calm.turn_radps2);
  memset(calm.rate_lead, 0, sizeof calm.rate_lead);
  calm.slow_pos_m = calm.slow_vel_mps = calm.slow_angle_rad = (slow_t){.sd = {0.0}};
  memset(calm.pos_m, 0, sizeof calm.pos_m);
  memset(calm.vel_mps, 0, sizeof calm.vel_mps);
  calm.angle_rad = 0.0;
  if (!CHECK_OK(nominal_fly(&r.set.grid[0], &r.vehicle, &calm, 5, &flown, NULL, &why))) return;
  const int every = r.set.grid[0].every;
  double at = 0.0, within = 0.0; // mean squares of a command's steps, at a point and between two
  CHECK(every > 2);
  for (int i = 1; i < flown.n; i++) {
    const double step = flown.v[SIG_M1][i] - flown.v[SIG_M1][i - 1];
    *(i % every ? &within : &at) += step * step * (i % every ? 1.0 / (every - 1) : 1.0);
  }
  CHECK(at < 2.0 * within);
  gap_flight_free(&flown);
  gap_track_free(&r);
}

// Five seconds are not there, and the log goes on two metres farther.
static void spoil_by_a_gap(gap_track_t *r) {
  gap_flight_t *const f = &r->flight[0];
  f->segment = f->segment ? f->segment : calloc((size_t)f->n, sizeof(int));
  if (!f->segment) abort();
  for (int i = f->n / 2; i < f->n; i++) {
    f->t_s[i] += 5.0;
    f->v[SIG_X][i] += 2.0;
    f->segment[i] = 1;
  }
}

#define BESIDE 5

typedef struct {
  const gap_track_t *rig;
  gap_flight_t flown[BESIDE];
} beside_t;

static void fly_beside(void *self, int i) {
  beside_t *const b = self;
  const closed_loop_t loop = closed_loop_varied(&b->rig->loop, i);
  why_t why;
  CHECK_OK(nominal_fly(&b->rig->set.grid[0], &b->rig->vehicle, &loop, 5 + (unsigned long)i, &b->flown[i],
                       NULL, &why));
}

TEST(gap_nominal_flights_side_by_side_have_the_bits_that_each_has_alone) {
  gap_track_t r;
  why_t why;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = spoil_by_a_gap}, &why))) return;
  beside_t alone = {.rig = &r}, beside = {.rig = &r};
  for (int i = 0; i < BESIDE; i++) fly_beside(&alone, i);
  const long together = side_by_side(BESIDE, fly_beside, &beside);
  if (lane_possible()) CHECK(together > (long)alone.flown[0].n * BESIDE / 2);
  for (int i = 0; i < BESIDE; i++) {
    gap_flight_t *const a = &alone.flown[i], *const b = &beside.flown[i];
    ROW("flight %d", i);
    if (CHECK(a->n == b->n && a->n > 0))
      for (int k = 0; k < SIG_COUNT; k++)
        if (a->v[k]) CHECK(memcmp(a->v[k], b->v[k], (size_t)a->n * sizeof(double)) == 0);
    gap_flight_free(a);
    gap_flight_free(b);
  }
  gap_track_free(&r);
}

TEST(gap_nominal_flight_goes_on_where_the_log_does_after_a_gap) {
  gap_track_t r;
  why_t why = {""};
  gap_flight_t flown;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = spoil_by_a_gap}, &why))) return;
  if (!CHECK_OK(nominal_fly(&r.set.grid[0], &r.vehicle, &r.loop, 5, &flown, NULL, &why))) return;
  const grid_t *const g = &r.set.grid[0];
  int at = 0, first = 0, far = 0;
  while (at + 1 < flown.n && flown.segment[at + 1] == 0) at++;
  while (first < g->n && g->point[first].segment == 0) first++;
  CHECK_NEAR(flown.t_s[at + 1] - flown.t_s[at], 5.0, 0.1);
  CHECK_NEAR(flown.v[SIG_X][at + 1], g->point[first].pos_w_m.x, 0.1); // put there, it does not fly there
  for (int i = 0; i < flown.n; i++) {
    const int since = i - at - 1;
    const int j = since < 0 ? i / g->every : first + since / g->every;
    far += j < g->n && fabs(flown.v[SIG_X][i] - g->point[j].pos_w_m.x) > 0.5;
  }
  CHECK(far < flown.n / 50);
  CHECK(flown.saturated[at + 1] && !flown.saturated[at]); // not compared until what it does is its own
  gap_flight_free(&flown);
  gap_track_free(&r);
}

TEST(gap_flies_the_first_minute_of_a_flight_and_half_of_it_in_a_trial) {
  enum { ALL = 90, ON_FLOOR = 10 };
  static const struct {
    const char *what;
    double most_s;
    int points, flown;
  } row[] = {{"one that counts", NOMINAL_S, ALL, ON_FLOOR + 60},
             {"a trial", TRIAL_S, ALL, ON_FLOOR + 30},
             {"a short one", NOMINAL_S, 50, 50},
             {"a trial of it", TRIAL_S, 35, 35}};
  grid_point_t point[ALL];
  for (int j = 0; j < ALL; j++) point[j] = (grid_point_t){.t_s = j, .ok = j >= ON_FLOOR};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const grid_t g = {.n = row[i].points, .period_s = 1.0, .point = point};
    const grid_t part = nominal_part(&g, row[i].most_s);
    CHECK(part.n == row[i].flown && part.point == point);
  }
}

// Nothing flies that is 5 m away every other second.
static void jump(gap_flight_t *f) {
  for (int i = 0; i < f->n; i++) f->v[SIG_X][i] += fmod(f->t_s[i], 2.0) < 1.0 ? 0.0 : 5.0;
}
static void spoil_one_track(gap_track_t *r) {
  jump(&r->flight[1]);
}
static void spoil_both_tracks(gap_track_t *r) {
  jump(&r->flight[0]);
  jump(&r->flight[1]);
}

TEST(gap_nominal_flight_that_cannot_be_flown_costs_itself_alone) {
  static const struct {
    const char *what;
    void (*spoil)(gap_track_t *r);
    done_t status;
    int flown;
  } row[] = {{"both can", NULL, DONE, 2},
             {"one cannot", spoil_one_track, DONE, 1},
             {"none can", spoil_both_tracks, BAD_INPUT, 0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_track_t r;
    why_t why = {""};
    gap_flight_t room[2];
    gap_flights_t flown = {.flight = room};
    ROW("%s", row[i].what);
    if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = row[i].spoil}, &why))) return;
    CHECK_STATUS(row[i].status,
                 nominal_flights(&flown, NULL, &r.set, &r.vehicle, &r.loop, NOMINAL_S, 1, &why));
    CHECK(flown.n == row[i].flown);
    for (int k = 0; k < flown.n; k++) gap_flight_free(&room[k]);
    gap_track_free(&r);
  }
}

TEST(gap_counts_the_flights_that_cannot_be_flown) {
  gap_track_t r;
  why_t why = {""};
  candidates_t c;
  nominal_t n;
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = spoil_one_track}, &why))) return;
  if (!CHECK_OK(candidates_make(&c, &r.vehicle, &r.set, &why))) return;
  const chosen_t none = {.n = 0};
  const nominal_job_t job = {&r.set, &r.vehicle, r.vehicle, &c, &none, &r.loop, 1, NULL};
  if (!CHECK_OK(nominal_make(&n, &job, &why))) return;
  CHECK(n.n == NOMINAL_FLIGHTS && n.flown == NOMINAL_FLIGHTS && n.lost == NOMINAL_FLIGHTS);
  for (int k = 0; k < c.columns; k++) CHECK(n.kept[k] > 0.0 && n.kept[k] <= 1.0);
  nominal_free(&n);
  candidates_free(&c);
  gap_track_free(&r);
}

// --- the disturbance --------------------------------------------------------------------------------------

static void rms_of(set_t *s, const model_t *m, double rms[CHANNELS]) {
  lines_t l = {.r = {NULL}};
  why_t why = {""};
  CHECK_OK(lines_make(&l, s, &why));
  CHECK_OK(residual_of(s, m, l.r, &why));
  for (int ch = 0; ch < CHANNELS; ch++) {
    double sum = 0.0;
    for (int i = 0; i < set_rows(s, ch)->n; i++) sum += l.r[ch][i] * l.r[ch][i];
    rms[ch] = sqrt(sum / fmax(set_rows(s, ch)->n, 1));
  }
  lines_free(&l);
}

static void spoil_by_shaking(gap_track_t *r) {
  random_t *const random = random_open(3);
  for (int f = 0; f < 2; f++) {
    double off[3] = {0.0};
    for (int i = 0; i < 3 * r->flight[f].n; i++) {
      off[i % 3] = 0.95 * off[i % 3] + 0.2 * random_normal(random);
      r->flight[f].v[SIG_AX + i % 3][i / 3] += off[i % 3];
    }
  }
  random_close(random);
}

// Velocities that err for longer than a sample, and stand for the acceleration.
static void spoil_velocities(gap_track_t *r) {
  random_t *const random = random_open(4);
  for (int f = 0; f < 2; f++)
    for (int k = 0; k < 3; k++) {
      double *const v = r->flight[f].v[SIG_VX + k], off = 0.0;
      for (int i = 0; i < r->flight[f].n; i++) v[i] += off = 0.8 * off + 0.004 * random_normal(random);
      free(r->flight[f].v[SIG_AX + k]);
      r->flight[f].v[SIG_AX + k] = NULL;
    }
  random_close(random);
}

static void spoil_into_means(gap_track_t *r) {
  gap_track_average(r, 5);
}

TEST(gap_nominal_flights_shake_as_the_log_does) {
  static const struct {
    const char *what;
    void (*spoil)(gap_track_t *r);
    int channels; // an accelerometer that shakes shows in forces; a force of that size shakes what turns, too
  } row[] = {{"as flown", NULL, CH_SMOOTH},
             {"as means of five samples", spoil_into_means, CH_SMOOTH},
             {"shaken", spoil_by_shaking, CH_FORCES},
             {"without an accelerometer", spoil_velocities, CH_FORCES}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_track_t r;
    why_t why = {""};
    closed_loop_t loop;
    along_t a;
    double log[CHANNELS], came[CHANNELS];
    ROW("%s", row[i].what);
    if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = row[i].spoil}, &why))) return;
    if (!CHECK_OK(loop_fit(&loop, &r.set, &r.vehicle, NULL, 9, &why))) return;
    if (!CHECK_OK(nominal_along(&a, &r.set, &r.vehicle, &loop, 77, &why))) return;
    rms_of(&r.set, &r.vehicle, log);
    rms_of(&a.seen, &r.vehicle, came);
    for (int ch = 0; ch < row[i].channels; ch++) CHECK_NEAR(came[ch] / log[ch], 1.0, 0.25);
    along_free(&a);
    gap_track_free(&r);
  }
}

// Of commands that are not compared a weak rotor makes a moment that nobody gave; with this one it cannot be
// flown either, so that no trial takes the moment back.
TEST(gap_takes_no_moment_for_a_disturbance_that_cannot_be_compared) {
  gap_track_t r;
  why_t why = {""};
  closed_loop_t loop;
  fx_use_t weak = fx_use(fx_find("motor_damage"));
  fx_use_resize(&weak, 0, 0.9);
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  for (int ch = CH_WX; ch <= CH_WZ; ch++) r.set.excluded[ch] = true;
  model_t m = r.vehicle;
  CHECK_OK(model_add_fx(&m, &weak, &why));
  if (!CHECK_OK(loop_fit(&loop, &r.set, &m, NULL, 9, &why))) return;
  for (int k = 0; k < 3; k++) CHECK(loop.turn_radps2[k] == 0.0);
  gap_track_free(&r);
}

// Rms of the turning that was measured, about each axis.
static void turning_of(set_t *s, double rms_radps2[3]) {
  lines_t l = {.r = {NULL}};
  why_t why = {""};
  CHECK_OK(lines_make(&l, s, &why));
  CHECK_OK(residual_measured(s, l.r, &why));
  for (int k = 0; k < 3; k++) {
    double sum = 0.0;
    for (int i = 0; i < s->smooth.n; i++) sum += l.r[CH_WX + k][i] * l.r[CH_WX + k][i];
    rms_radps2[k] = sqrt(sum / fmax(s->smooth.n, 1));
  }
  lines_free(&l);
}

// Gains that are read off few rows are too small by far: the vehicle turns with its track all the same.
TEST(gap_nominal_flights_turn_as_much_as_the_log_does) {
  gap_track_t r;
  why_t why = {""};
  along_t a;
  double log_radps2[3], came_radps2[3];
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  for (int k = 0; k < 2; k++) r.loop.rate_gain[k] = 8.0; // the least that is taken
  r.loop.tilt_gain = 22.0;
  r.loop.unread = true;
  if (!CHECK_OK(nominal_along(&a, &r.set, &r.vehicle, &r.loop, 77, &why))) return;
  turning_of(&r.set, log_radps2);
  turning_of(&a.seen, came_radps2);
  for (int k = 0; k < 3; k++) CHECK_NEAR(came_radps2[k] / log_radps2[k], 1.0, 0.35);
  along_free(&a);
  gap_track_free(&r);
}
