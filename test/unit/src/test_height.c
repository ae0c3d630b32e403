// test_height.c - the height filter: what it follows, when it gives up, and that neither is a step.
#include "flight/height.h"
#include "flight/params.h"
#include "flight/thrust.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <math.h>

#define MASS_KG     0.0329f
#define RAD_PER_DEG (3.14159265358979 / 180.0)
#define FIT_S       3.0 // until it has settled and fades in

// A point that moves up and down in free air and leans, told without noise but where a row says.
typedef struct {
  double swing_m, radps, lean_rad;
  flight_param_t p;
  height_t h;
  height_fly_t fly;
  float share, down_m, acc_more_mps2, acc_shake_mps2, z_more_m, thrust, floor, more_last_m, kd_last_per_s;
  double step_m, step_per_s; // the largest change of what is flown, in a step: height; gain
  bool lost, frozen;
  int k;
} point_t;

static double z_at(const point_t *w, double t_s) {
  return 0.7 + w->swing_m * sin(w->radps * t_s);
}

static double climb_at(const point_t *w, double t_s) {
  return w->swing_m * w->radps * cos(w->radps * t_s);
}

static double acc_at(const point_t *w, double t_s) {
  return -w->radps * w->radps * (z_at(w, t_s) - 0.7);
}

// What is to be sent for the motors' lag to make this acceleration of it.
static double sent_at(const point_t *w, double t_s) {
  return acc_at(w, t_s) - (double)w->p.height.tau_s * w->radps * w->radps * climb_at(w, t_s);
}

// The firmware's: a cone of 15 degrees sees the nearest of the floor.
static double down_at(const point_t *w, double t_s) {
  return z_at(w, t_s) / cos(fmax(w->lean_rad - 7.5 * RAD_PER_DEG, 0.0));
}

static void start(point_t *w) {
  *w = (point_t){.swing_m = 0.003, .radps = 2.0, .thrust = 1.0f};
  params_default(&w->p);
  w->p.height.own = 1;
  w->p.height.delay_s = 0.0f;
  // Whatever ships; every gain another than the estimator's.
  w->p.height.kp_per_s = 5.0f, w->p.height.kd_per_s = 12.0f;
  w->p.height.quick = 2.1f, w->p.height.catch_s = 0.1f;
  w->share = thrust_lag_share(HEIGHT_S, w->p.height.tau_s);
  height_init(&w->h);
}

static void step(point_t *w) {
  const double t_s = 0.01 * w->k;
  // The sensors' delays; a command is seen 9.5 ms late and holds for a step.
  const double up = cos(w->lean_rad), felt_mps2 = acc_at(w, t_s - 0.0075);
  const double sent_mps2 = sent_at(w, t_s + 0.0095 - 0.005);
  const float seen_m = (float)down_at(w, t_s - 0.0175) + 1e-5f * (float)(w->k % 7);
  if (!w->frozen) w->down_m = seen_m;
  const height_in_t in = {
      .acc_b_mps2 = {0.0f, 0.0f,
                     (float)((9.81 + felt_mps2) / up) + w->acc_more_mps2 +
                         (w->k % 2 ? w->acc_shake_mps2 : -w->acc_shake_mps2)},
      .q_wb = {.w = (float)cos(0.5 * w->lean_rad), .x = (float)sin(0.5 * w->lean_rad)},
      .thrust_N = w->thrust * MASS_KG * (float)((9.81 + sent_mps2) / up) / (1.0f + w->floor),
      .mass_kg = MASS_KG,
      .z_m = (float)z_at(w, t_s) + 0.002f, // the estimator's zero is another
      .climb_mps = (float)climb_at(w, t_s),
      .at = {.ratio = 1.0f + w->floor},
      .ground_excess = w->floor,
      .ceiling_z_m = NAN,
      .down_m = w->lost || w->k % 3 != 0 ? 0.0f : w->down_m + w->z_more_m,
  };
  height_step(&w->h, &w->p.height, w->share, &in);
  height_fly(&w->h, &w->p.height, &w->p.pos, in.z_m, in.climb_mps, &w->fly);
  if (w->k > 0) w->step_m = fmax(w->step_m, fabs((double)(w->fly.more_m - w->more_last_m)));
  if (w->k > 0) w->step_per_s = fmax(w->step_per_s, fabs((double)(w->fly.law.kd_z_per_s - w->kd_last_per_s)));
  w->more_last_m = w->fly.more_m;
  w->kd_last_per_s = w->fly.law.kd_z_per_s;
  w->k++;
}

static void fly_for(point_t *w, double s) {
  for (int n = (int)(100.0 * s); n > 0; n--) step(w);
}

// So fast that a range taken for a tick older or younger is 6 mm off.
TEST(height_follows_a_known_motion) {
  static const struct {
    const char *what;
    double swing_m, radps, lean_deg;
  } row[] = {{"slow", 0.003, 2.0, 0.0},
             {"fast", 0.4, 1.5, 0.0},
             {"within the cone", 0.4, 1.5, 5.0},
             {"leaning", 0.4, 1.5, 20.0},
             {"shaken", 0.01, 5.0, 20.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    static point_t w;
    start(&w);
    w.swing_m = row[i].swing_m;
    w.radps = row[i].radps;
    w.lean_rad = row[i].lean_deg * RAD_PER_DEG;
    fly_for(&w, 10.0);
    double worst_m = 0.0, worst_mps = 0.0;
    for (int n = 0; n < 500; n++) {
      step(&w);
      const double t_s = 0.01 * (w.k - 1);
      worst_m = fmax(worst_m, fabs((double)w.h.x[HEIGHT_H] - z_at(&w, t_s)));
      worst_mps = fmax(worst_mps, fabs((double)w.h.x[HEIGHT_W] - climb_at(&w, t_s)));
    }
    ROW("%s: %g mm, %g mm/s off", row[i].what, 1e3 * worst_m, 1e3 * worst_mps);
    CHECK(w.h.share == 1.0f);
    CHECK(worst_m < 1e-4 && worst_mps < 2e-4);
    CHECK_NEAR(w.h.off_m, 0.002, 3e-4);
  }
}

// What goes wrong for a while, and that it is flown by again when it is over.
TEST(height_takes_what_the_ground_gives_for_no_disturbing_force) {
  static const float excess[] = {0.0f, 0.05f, 0.1f};
  for (int i = 0; i < 3; i++) {
    ROW("the ground gives %g", (double)excess[i]);
    static point_t w;
    start(&w);
    w.floor = excess[i];
    fly_for(&w, 5.0);
    CHECK_NEAR(w.h.x[HEIGHT_D], 0.0, 0.05); // half of what 0.01 makes
    CHECK(w.h.share == 1.0f);
  }
}

TEST(height_falls_back_without_a_step_and_comes_back) {
  static const struct {
    const char *what;
    float acc_more_mps2, acc_shake_mps2, z_more_m, thrust;
    bool lost, frozen;
  } row[] = {{"a contact", -1.8f, 0.0f, 0.0f, 1.0f, false, false},
             {"a jump of the range", 0.0f, 0.0f, 0.1f, 1.0f, false, false},
             {"a lost sensor", 0.0f, 0.0f, 0.0f, 1.0f, true, false},
             {"a frozen sensor", 0.0f, 0.0f, 0.0f, 1.0f, false, true},
             {"an acceleration that no model has", 0.0f, 0.5f, 0.0f, 1.0f, false, false},
             {"a thrust map that is 15 % wrong", 0.0f, 0.0f, 0.0f, 1.15f, false, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    static point_t w;
    start(&w);
    fly_for(&w, FIT_S);
    CHECK(w.h.share == 1.0f);
    w.step_m = w.step_per_s = 0.0;
    w.acc_more_mps2 = row[i].acc_more_mps2;
    w.acc_shake_mps2 = row[i].acc_shake_mps2;
    w.z_more_m = row[i].z_more_m;
    w.thrust = row[i].thrust;
    w.lost = row[i].lost, w.frozen = row[i].frozen;
    bool fell = false;
    for (int n = 0; n < 80; n++) {
      step(&w);
      fell = fell || w.h.share == 0.0f;
    }
    CHECK(fell);
    CHECK(w.step_m < 2.5e-3);
    CHECK(w.step_per_s > 0.0 && w.step_per_s < 0.05 * 4.0); // of 12 to 8
    CHECK(w.fly.law.kp_z_per_s == w.p.pos.kp_z_per_s && w.fly.law.kd_z_per_s == w.p.pos.kd_z_per_s);
    CHECK(w.fly.law.quick == w.p.pos.quick && w.fly.law.catch_s == w.p.pos.catch_s);
    w.acc_more_mps2 = w.acc_shake_mps2 = w.z_more_m = 0.0f;
    w.thrust = 1.0f;
    w.lost = w.frozen = false;
    fly_for(&w, FIT_S);
    CHECK(w.h.share == 1.0f);
  }
}

// At rest 20 mm below a ceiling, nothing known of what came before but its covariance.
static height_in_t below(height_t *h) {
  const float T_N = MASS_KG * GRAVITY_MPS2 / 1.1f;
  *h = (height_t){.x = {0.4f},
                  .P = {{1e-5f}, {0.0f, 1e-3f}, {0.0f, 0.0f, 0.25f}, {0.0f, 0.0f, 0.0f, 4e-3f}},
                  .thrust_N = T_N,
                  .sent_N = {T_N, T_N, T_N},
                  .acc_odd = 1.0f,
                  .down_odd = 1.0f,
                  .started = true};
  return (height_in_t){.acc_b_mps2.z = GRAVITY_MPS2,
                       .q_wb = {.w = 1.0f},
                       .thrust_N = T_N,
                       .mass_kg = MASS_KG,
                       .z_m = 0.4f,
                       .at = {.ratio = 1.1f, .slope_per_m = -6.0f},
                       .zc_m = 0.02f,
                       .ceiling_z_m = 0.42f};
}

// P <- F P F' + Q, K = P H / (H' P H + R), x += K e, P -= K H' P, as the header has it, in double.
TEST(height_takes_the_ceilings_pull_into_its_covariance) {
  static point_t w;
  start(&w);
  height_in_t in = below(&w.h);
  const double k = 9.81 * 6.0 / 1.1, e = 0.05, walk = (double)w.p.height.walk_mps2;
  const double F[4][4] = {{1.0, 0.01}, {0.01 * k, 1.0, 0.01}, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 1.0}};
  const double P0[4] = {1e-5, 1e-3, 0.25, 4e-3}, H[4] = {k, 0.0, 1.0, 1.0};
  const double Q[4] = {0.0, 0.01 * 0.007 * 0.007, 0.01 * walk * walk, 0.01 * 0.003 * 0.003};
  double P[4][4], PH[4], var = 9.6e-3;
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      P[i][j] = i == j ? Q[i] : 0.0;
      for (int n = 0; n < 4; n++) P[i][j] += F[i][n] * P0[n] * F[j][n];
    }
  for (int i = 0; i < 4; i++) {
    PH[i] = 0.0;
    for (int j = 0; j < 4; j++) PH[i] += P[i][j] * H[j];
    var += H[i] * PH[i];
  }
  in.acc_b_mps2.z += (float)e;
  height_step(&w.h, &w.p.height, 1.0f, &in);
  for (int i = 0; i < 4; i++) {
    const double was = i == HEIGHT_H ? 0.4 : 0.0;
    ROW("state %d", i);
    CHECK_NEAR((double)w.h.x[i] - was, PH[i] / var * e, 1e-6 + 1e-4 * fabs(PH[i] / var * e));
    for (int j = 0; j < 4; j++) {
      const double want = P[i][j] - PH[i] * PH[j] / var;
      CHECK_NEAR(w.h.P[i][j], want, 1e-8 + 1e-3 * fabs(want));
    }
  }
}

TEST(height_motors_follow_what_was_sent_before_the_delay) {
  static const struct {
    float delay_s;
    double late; // in steps, of the newest command
  } row[] = {{0.0f, 0.95}, {0.0005f, 1.0}, {0.006f, 1.55}, {0.0105f, 2.0}, {0.0145f, 2.4}};
  static const float more_mN[] = {0.0f, 1.0f, 3.0f, -1.0f}; // the newest first
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    static point_t w;
    start(&w);
    height_in_t in = below(&w.h);
    const float T_N = in.thrust_N;
    for (int n = 0; n < 3; n++) w.h.sent_N[n] = T_N + 1e-3f * more_mN[n + 1];
    w.p.height.delay_s = row[i].delay_s;
    height_step(&w.h, &w.p.height, 1.0f, &in);
    const int whole = (int)row[i].late;
    const double want_mN =
        (double)more_mN[whole] + (row[i].late - whole) * (double)(more_mN[whole + 1] - more_mN[whole]);
    ROW("%g ms", 1e3 * (double)row[i].delay_s);
    CHECK_NEAR(1e3 * (double)(w.h.thrust_N - T_N), want_mN, 2e-3);
  }
}

TEST(height_stays_within_bounds_under_whatever_it_is_told) {
  static const float odd[] = {NAN, INFINITY, -INFINITY, 1e38f, -1e30f, 0.0f, 1e-40f};
  splitmix_t r = {7};
  static point_t w;
  start(&w);
  for (int k = 0; k < 200000; k++) {
    height_in_t in = {.acc_b_mps2 = {0.0f, 0.0f, (float)(9.81 + splitmix_normal(&r, 0.5))},
                      .q_wb = {.w = 1.0f},
                      .thrust_N = 0.32f,
                      .mass_kg = MASS_KG,
                      .z_m = 0.4f,
                      .at = {.ratio = 1.1f, .slope_per_m = -6.0f},
                      .zc_m = 0.02f,
                      .ceiling_z_m = 0.42f,
                      .down_m = k % 3 == 0 ? 0.4f : 0.0f};
    float *const at[] = {&in.acc_b_mps2.z, &in.thrust_N, &in.z_m,        &in.climb_mps,
                         &in.down_m,       &in.q_wb.w,   &in.ceiling_z_m};
    const uint64_t bits = splitmix_bits(&r);
    if (bits % 20 == 0) *at[(bits >> 8) % 7] = odd[(bits >> 16) % 7];
    height_step(&w.h, &w.p.height, w.share, &in);
    height_fly(&w.h, &w.p.height, &w.p.pos, 0.4f, 0.0f, &w.fly);
    bool good = fabsf(w.fly.more_m) <= HEIGHT_APART_M && fabsf(w.fly.more_mps) <= HEIGHT_APART_MPS &&
                w.h.share >= 0.0f && w.h.share <= 1.0f;
    for (int i = 0; i < HEIGHT_N; i++) good = good && f_finite(w.h.x[i]) && w.h.P[i][i] >= 0.0f;
    if (!CHECK(good)) return;
  }
}
