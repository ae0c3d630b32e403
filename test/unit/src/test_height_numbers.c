// test_height_numbers.c - the height filter's numbers, each by what it does; half or double moves its row.
#include "flight/height.h"
#include "rig/height_rest.h"
#include "rig/test.h"

#include <math.h>

#define LEAN_COS 0.98480775f // by 10 degrees
#define LEAN_SIN 0.17364818f

static double fitting(height_rest_t *r, int most) {
  int n = 0;
  for (; n < most && r->h.fit > 0; n++) height_rest_step(r);
  return n;
}

static double five_steps(height_rest_t *r) {
  height_rest_start(r);
  r->in.climb_mps = 0.1f;
  r->silent = true;
  height_rest_for(r, 5);
  return 1e3 * ((double)r->h.x[HEIGHT_H] - 0.4);
}

static double ahead(height_rest_t *r) {
  height_rest_settle(r);
  r->h.x[HEIGHT_W] = 0.1f;
  r->h.x[HEIGHT_H] = 0.4f;
  r->h.off_m = r->h.acc_mps2 = 0.0f;
  height_fly_t fly;
  height_fly(&r->h, &r->p.height, &r->p.pos, 0.4f, 0.1f, &fly);
  return 1e3 * (double)fly.more_m;
}

static double command(height_rest_t *r) {
  height_rest_settle(r);
  r->in.thrust_N *= 2.0f;
  height_rest_step(r);
  return (double)(r->h.thrust_N / (HEIGHT_REST_KG * GRAVITY_MPS2)) - 1.0;
}

static double range_age(height_rest_t *r) {
  height_rest_settle(r);
  r->h.x[HEIGHT_W] = r->in.climb_mps = 0.1f;
  r->h.wild = 0;
  r->k = 0;
  const float h_m = r->h.x[HEIGHT_H];
  r->h.P[HEIGHT_H][HEIGHT_H] = 1e3f; // the sample is all that is known
  for (int i = 1; i < HEIGHT_N; i++) r->h.P[i][HEIGHT_H] = r->h.P[HEIGHT_H][i] = 0.0f;
  r->down_m = h_m;
  height_rest_step(r);
  return 1e3 * (double)(r->h.x[HEIGHT_H] - h_m);
}

static double acc_odd(height_rest_t *r) {
  height_rest_settle(r);
  r->shake_mps2 = 0.078f;
  height_rest_for(r, 300);
  return (double)r->h.acc_odd;
}

static double down_odd(height_rest_t *r) {
  height_rest_settle(r);
  r->shake_m = 0.0025f;
  height_rest_for(r, 900);
  return (double)r->h.down_odd;
}

static double bias_sd(height_rest_t *r) {
  height_rest_start(r);
  height_rest_for(r, 30000);
  return sqrt((double)r->h.P[HEIGHT_B][HEIGHT_B]);
}

static double climb_sd(height_rest_t *r) {
  height_rest_settle(r);
  return 1e3 * sqrt((double)r->h.P[HEIGHT_W][HEIGHT_W]);
}

// A force that grows, and the vehicle stays where it is.
static double force(height_rest_t *r) {
  height_rest_settle(r);
  double most = 0.0;
  for (int n = 0; n < 3000 && r->h.fit > 0; n++) {
    r->in.thrust_N -= HEIGHT_REST_KG * 0.001f;
    most = fmax(most, (double)r->h.x[HEIGHT_D]);
    height_rest_step(r);
  }
  return most;
}

static double bias_to_begin_with(height_rest_t *r) {
  height_rest_start(r);
  r->in.bias_mps2 = 5.0f;
  r->in.acc_b_mps2.z += 5.0f;
  height_rest_step(r);
  return (double)r->h.x[HEIGHT_B];
}

static double oddest(height_rest_t *r) {
  height_rest_settle(r);
  double most = 0.0;
  for (int n = 0; n < 4000 && r->h.fit > 0; n++) {
    most = fmax(most, (double)r->h.acc_odd);
    r->shake_mps2 += 2e-4f;
    height_rest_step(r);
  }
  return most;
}

// The largest jump of one sample that is believed, in its standard deviations.
static double wildest(height_rest_t *r) {
  for (int tenth_mm = 1; tenth_mm < 1000; tenth_mm++) {
    height_rest_settle(r);
    r->k = 0;
    const double var = (double)(r->h.P[HEIGHT_H][HEIGHT_H] + HEIGHT_DOWN_VAR);
    r->down_m += 1e-4f * (float)tenth_mm;
    height_rest_step(r);
    if (r->h.wild > 0) return 1e-4 * tenth_mm / sqrt(var);
  }
  return 0.0;
}

static double wild_in_a_row(height_rest_t *r) {
  height_rest_settle(r);
  r->k = 0;
  r->down_m += 0.02f;
  r->h.down_odd = 0.0f;
  int n = 0;
  for (; n < 60 && r->h.fit > 0; n++) {
    height_rest_step(r);
    if (r->h.down_odd > 1.0f) r->h.down_odd = 0.0f; // the mean is another row's
  }
  return n;
}

static double silence(height_rest_t *r) {
  height_rest_settle(r);
  r->h.silent = 0;
  r->silent = true;
  return fitting(r, 100);
}

static double same(height_rest_t *r) {
  height_rest_settle(r);
  int n = 0;
  for (r->h.same = 0; n < 100 && r->h.fit > 0; n++) {
    height_in_t in = r->in;
    in.down_m = 0.4f;
    height_step(&r->h, &r->p.height, r->share, &in);
  }
  return n;
}

static double until_flown(height_rest_t *r) {
  height_rest_start(r);
  int n = 0;
  for (; n < 500 && !(r->h.share > 0.0f); n++) height_rest_step(r);
  return n;
}

static double fading_in(height_rest_t *r) {
  until_flown(r);
  int n = 0;
  for (; n < 500 && r->h.share < 1.0f; n++) height_rest_step(r);
  return 0.01 * n;
}

// Handed back so often, it is flown again after so many steps.
static int waits(height_rest_t *r, int times) {
  height_rest_settle(r);
  int n = 0;
  for (; times > 0; times--) {
    r->in.climb_mps = 1.0f;
    height_rest_step(r);
    r->in.climb_mps = 0.0f;
    height_rest_for(r, 30); // faded out
    for (n = 30; n < 3000 && !(r->h.share > 0.0f); n++) height_rest_step(r);
  }
  return n;
}

static double longer(height_rest_t *r) {
  return (double)waits(r, 2) / waits(r, 1);
}

static double longest(height_rest_t *r) {
  return waits(r, 7);
}

static double trusted(height_rest_t *r) {
  const int wait = waits(r, 2) - 1;
  int n = wait;
  for (; n < 5000 && r->h.wait >= wait - 1; n++) height_rest_step(r);
  return (double)n / wait;
}

static double other_zero(height_rest_t *r) {
  height_rest_settle(r);
  const float before_m = r->h.off_m;
  r->in.z_m += 0.002f;
  height_rest_for(r, 400);
  return (double)(r->h.off_m - before_m) / 0.002;
}

static double apart(height_rest_t *r) {
  for (int mm = 1; mm < 100; mm++) {
    height_rest_settle(r);
    r->in.z_m += 1e-3f * (float)mm;
    height_rest_step(r);
    if (r->h.fit == 0) return mm;
  }
  return 0.0;
}

static double climbs_apart(height_rest_t *r) {
  for (int cmps = 1; cmps < 100; cmps++) {
    height_rest_settle(r);
    r->in.climb_mps += 0.01f * (float)cmps;
    height_rest_step(r);
    if (r->h.fit == 0) return cmps;
  }
  return 0.0;
}

// What the accelerometer is expected to show at once of a thrust that jumps: no surprise leaves the bias.
static double at_once(height_rest_t *r) {
  double least = 1.0, of = 0.0;
  for (int percent = 0; percent <= 100; percent++) {
    height_rest_settle(r);
    for (int i = 0; i < 3; i++) r->h.sent_N[i] += HEIGHT_REST_KG; // 1 m/s2 more
    r->in.thrust_N += HEIGHT_REST_KG;
    r->in.acc_b_mps2.z += 0.01f * (float)percent;
    r->k = 1;
    const float b_mps2 = r->h.x[HEIGHT_B];
    height_rest_step(r);
    const double more = fabs((double)(r->h.x[HEIGHT_B] - b_mps2));
    if (more < least) {
      least = more;
      of = 0.01 * percent;
    }
  }
  return of;
}

static double mean_of_acc(height_rest_t *r) {
  height_rest_settle(r);
  r->shake_mps2 = 0.1f;
  const int most = 500;
  height_rest_for(r, most);
  const float all = r->h.acc_odd;
  height_rest_settle(r);
  r->shake_mps2 = 0.1f;
  int n = 0;
  for (; n < most && r->h.acc_odd < 0.632f * all; n++) height_rest_step(r);
  return 0.01 * n;
}

static double mean_of_range(height_rest_t *r) {
  height_rest_settle(r);
  r->shake_m = 0.004f;
  height_rest_for(r, 900);
  const float all = r->h.down_odd;
  height_rest_settle(r);
  r->shake_m = 0.004f;
  int n = 0;
  for (; n < 900 && r->h.down_odd < 0.632f * all; n++) height_rest_step(r);
  return n / 3.0;
}

// 20 mm from where the curve was looked up; what its slope of -6 per metre is made to be at most.
static double straight(height_rest_t *r) {
  height_rest_start(r);
  r->in.at = (rbf_point_t){.ratio = 1.0f, .slope_per_m = -6.0f};
  r->in.ceiling_z_m = 0.42f;
  r->in.zc_m = 0.04f;
  height_rest_step(r);
  return 1e3 * (double)((r->h.acc_mps2 - r->h.x[HEIGHT_D]) / GRAVITY_MPS2) / 6.0;
}

static double highest(height_rest_t *r) {
  int dm = 5;
  for (; dm < 100; dm++) {
    height_rest_start(r);
    r->in.z_m = r->down_m = 0.1f * (float)dm - 0.05f;
    height_rest_for(r, 100);
    if (r->h.fit == 0) break;
  }
  return 0.1 * (dm - 1);
}

// Leaning by 10 degrees, 2.5 beyond the cone, 0.4 m of range: what the filter takes for the height.
static double leaning(height_rest_t *r) {
  height_rest_start(r);
  r->in.q_wb = (quat_t){.w = 0.9961947f, .x = 0.08715574f};
  r->in.acc_b_mps2.z = GRAVITY_MPS2 / LEAN_COS;
  r->in.thrust_N /= LEAN_COS;
  r->in.z_m = 0.99904823f * r->down_m; // cos 2.5 degrees
  height_rest_for(r, 600);
  return ((double)((r->in.z_m - r->h.off_m) / r->down_m) - (double)LEAN_COS) / (double)LEAN_SIN;
}

static double first_range(height_rest_t *r) {
  height_rest_start(r);
  r->down_m = 0.401f;
  height_rest_step(r);
  return 1e3 * (double)(r->h.x[HEIGHT_H] - 0.4f);
}

static double first_climb(height_rest_t *r) {
  height_rest_start(r);
  r->down_m = 0.401f;
  height_rest_for(r, 4);
  return 1e3 * (double)r->h.x[HEIGHT_W];
}

static double first_force(height_rest_t *r) {
  height_rest_start(r);
  r->in.acc_b_mps2.z += 0.1f;
  r->silent = true;
  height_rest_step(r);
  return (0.1 - (double)(r->h.x[HEIGHT_D] + r->h.x[HEIGHT_B])) / 0.1;
}

static double first_bias(height_rest_t *r) {
  height_rest_start(r);
  r->in.acc_b_mps2.z += 0.1f;
  r->silent = true;
  height_rest_step(r);
  return (double)r->h.x[HEIGHT_B] / 0.1;
}

static const struct {
  const char *what;
  double (*of)(height_rest_t *);
  double want, tol;
} row[] = {
    {"S: mm in five steps of 0.1 m/s", five_steps, 5.0, 0.1},
    {"AHEAD_S: mm at 0.1 m/s", ahead, 0.8, 0.01},
    {"COMMAND_S: of the newest command", command, 0.05, 0.001},
    {"DOWN_AGE_S: mm at 0.1 m/s", range_age, 1.75, 0.02},
    {"ACC_VAR: surprise of 0.078 m/s2", acc_odd, 0.632, 0.05},
    {"DOWN_VAR: surprise of 2.5 mm", down_odd, 0.976, 0.1},
    {"BIAS_WALK: m/s2 it is known to", bias_sd, 0.0062, 0.0006},
    {"CLIMB_WALK: mm/s it is known to", climb_sd, 6.44, 0.6},
    {"FORCE_MAX: m/s2 flown", force, 1.2, 0.02},
    {"BIAS_MAX: m/s2 to begin with", bias_to_begin_with, 0.6, 0.1},
    {"ODD: mean square flown", oddest, 4.0, 0.1},
    {"WILD: standard deviations", wildest, 5.0, 0.1},
    {"WILD_ROW: steps of them", wild_in_a_row, 7.0, 0.0},
    {"SILENT: steps", silence, 10.0, 0.0},
    {"SAME: samples", same, 11.0, 0.0},
    {"FIT: steps until it is flown", until_flown, 51.0, 0.0},
    {"FIT: times so long after each time that it did not", longer, 2.0, 0.02},
    {"FIT_MAX: steps at most", longest, 1602.0, 1.0},
    {"TRUST: times so long as it waits", trusted, 8.0, 0.1},
    {"FADE_S: s", fading_in, 0.24, 0.011},
    {"OFF_STEPS: share followed in as many", other_zero, 0.632, 0.01},
    {"APART_M: mm", apart, 16.0, 0.0},
    {"APART_MPS: cm/s", climbs_apart, 15.0, 1.0},
    {"ACC_DELAY_S: of a jump at once", at_once, 0.25, 0.011},
    {"MEAN_S: of the accelerometer, s", mean_of_acc, 0.25, 0.03},
    {"MEAN_S, DOWN_S: samples", mean_of_range, 10.0, 1.0},
    {"CURVE_NEAR_M: mm", straight, 5.0, 0.1},
    {"RANGE_MAX_M: m", highest, 2.0, 0.06},
    {"CONE_SIN: of the lean's sine more than its cosine", leaning, 0.0820, 0.002},
    {"BEGIN_H: mm of the first range's 1", first_range, 0.612, 0.01},
    {"BEGIN_W: mm/s of two ranges' 1 mm", first_climb, 1.765, 0.1},
    {"BEGIN_D: share of an acceleration left", first_force, 0.036, 0.001},
    {"BEGIN_B: share of an acceleration", first_bias, 0.0152, 0.0005},
};

TEST(the_height_filters_numbers_are_what_it_does) {
  height_rest_t r;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    const double got = row[i].of(&r);
    ROW("%s", row[i].what);
    CHECK_NEAR(got, row[i].want, row[i].tol);
  }
}
