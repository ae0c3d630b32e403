// test_storm.c - the whole controller under anything: parameters from all of their ranges, sensors that lie,
// calls that are missed or come twice, floors that slope, modes that change. Nothing of its state may become
// no number, no motor may be asked for more than its most, and after 6 s of good input with the shipped
// parameters nothing of it may be left. STORM_SEED takes other seeds, STORM_TICKS more or fewer ticks.
#include "rig/flight_state.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

#define STORM_MS 3000
#define CALM_MS  6000
#define AT_M     1.0f
#define OTHER_M  1.3f
#define ASKED_MS 1500 // until the pilot asks for the other height again

// --- the storm ------------------------------------------------------------------------------------------

static float between(splitmix_t *r, double lo, double hi) {
  return (float)splitmix_between(r, lo, hi);
}

static bool one_in(splitmix_t *r, unsigned n) {
  return splitmix_bits(r) % n == 0;
}

// Most of them as they come, some at an end of their range or anywhere in it; often, sets contradict
// themselves.
static void draw_params(splitmix_t *r, flight_param_t *p) {
  do {
    params_default(p);
    const unsigned some = (unsigned)(splitmix_bits(r) % 16);
    for (int i = 0; i < params_count; i++) {
      const param_row_t *row = &params_table[i];
      if (splitmix_bits(r) % 16 > some) continue;
      const double at = one_in(r, 2) ? (double)(splitmix_bits(r) % 2) : splitmix_between(r, 0.0, 1.0);
      float value = (float)((double)row->min + at * ((double)row->max - (double)row->min));
      if (row->type == PARAM_INT) value = roundf(value);
      (void)!params_set(p, row, f_clamp(value, row->min, row->max));
    }
  } while (params_check(p) != ST_OK);
}

static float garbage(splitmix_t *r) {
  static const float odd[] = {NAN,   INFINITY, -INFINITY, 3.4e38f, -3.4e38f,
                              1e20f, 1e-40f,   0.0f,      -0.0f,   32.767f};
  return one_in(r, 3) ? between(r, -50.0, 50.0) : odd[splitmix_bits(r) % (sizeof odd / sizeof *odd)];
}

static void draw_setpoint(splitmix_t *r, flight_setpoint_t *sp) {
  *sp = (flight_setpoint_t){
      .x = (axis_mode_t)(splitmix_bits(r) % 3),
      .y = (axis_mode_t)(splitmix_bits(r) % 3),
      .z = (axis_mode_t)(splitmix_bits(r) % 3),
      .yaw = (yaw_mode_t)(splitmix_bits(r) % 2),
      .vel_in_body = one_in(r, 2),
      .pos_w_m = {between(r, -2, 2), between(r, -2, 2), between(r, 0, 2)},
      .vel_mps = {between(r, -1, 1), between(r, -1, 1), between(r, -1, 1)},
      .acc_w_mps2 = {between(r, -5, 5), between(r, -5, 5), between(r, -5, 5)},
      .roll_rad = between(r, -1, 1),
      .pitch_rad = between(r, -1, 1),
      .thrust_N = between(r, 0, 0.6),
      .yaw_rad = between(r, -10, 10),
      .yaw_rate_radps = between(r, -5, 5),
  };
}

// A vehicle that hovers, stands on a slope or is turned about; seen with a sensor's noise.
static void good_input(splitmix_t *r, flight_in_t *in, v3_t pos_w_m, quat_t q, const float force_N[MOTORS]) {
  in->rate_b_radps = (v3_t){between(r, -0.01, 0.01), between(r, -0.01, 0.01), between(r, -0.01, 0.01)};
  in->q_wb = q;
  in->acc_b_mps2 = v3_add(quat_to_body(q, (v3_t){0.0f, 0.0f, GRAVITY_MPS2}),
                          (v3_t){between(r, -0.05, 0.05), between(r, -0.05, 0.05), between(r, -0.05, 0.05)});
  in->pos_w_m = pos_w_m;
  in->vel_w_mps = (v3_t){0.0f, 0.0f, 0.0f};
  memcpy(in->force_N, force_N, sizeof in->force_N);
  in->no_lesson = false;
}

static void spoil(splitmix_t *r, flight_in_t *in) {
  float *const at[] = {&in->rate_b_radps.x,
                       &in->rate_b_radps.z,
                       &in->acc_b_mps2.x,
                       &in->acc_b_mps2.z,
                       &in->pos_w_m.x,
                       &in->pos_w_m.z,
                       &in->vel_w_mps.x,
                       &in->vel_w_mps.z,
                       &in->q_wb.w,
                       &in->q_wb.y,
                       &in->force_N[0],
                       &in->force_N[3],
                       &in->range_m,
                       &in->range_age_s,
                       &in->setpoint.pos_w_m.z,
                       &in->setpoint.vel_mps.x,
                       &in->setpoint.roll_rad,
                       &in->setpoint.thrust_N,
                       &in->setpoint.yaw_rad,
                       &in->setpoint.yaw_rate_radps,
                       &in->setpoint.acc_w_mps2.z};
  *at[splitmix_bits(r) % (sizeof at / sizeof *at)] = garbage(r);
}

// Most calls come in time; or all of a storm are late alike.
static uint32_t time_passes(splitmix_t *r, uint32_t pace) {
  static const uint32_t steps[] = {0,  2,  3,  5,   7,      10,          13,         30,
                                   49, 50, 51, 500, 100000, 0x7fffffffu, 0xffffff00u};
  return one_in(r, 40) ? steps[splitmix_bits(r) % (sizeof steps / sizeof *steps)] : pace;
}

typedef struct {
  flight_t f;
  flight_in_t in;
  float most_N; // that a motor may be asked for: parameters change between two runs of the inner loop
} storm_t;

static bool step(storm_t *s, uint32_t ms) {
  s->in.step += ms;
  const flight_out_t *out = flight_step(&s->f, &s->in);
  const float now_N = s->f.outer.param.mixer.force_max_N;
  // While no loop runs, the last command stands; as in a second call of the same millisecond.
  if ((ms > 0 && s->f.inner_ms == 0) || now_N > s->most_N) s->most_N = now_N;
  for (int i = 0; i < MOTORS; i++)
    if (!CHECK(out->motors.force_N[i] >= 0.0f && out->motors.force_N[i] <= s->most_N)) return false;
  const char *bad = flight_not_finite(&s->f);
  if (bad) ROW("%s", bad);
  return CHECK(bad == NULL);
}

static bool rage(storm_t *s, splitmix_t *r) {
  static const uint32_t paces[] = {1, 1, 1, 1, 2, 10, 30, 40, 50};
  const uint32_t pace = paces[splitmix_bits(r) % (sizeof paces / sizeof *paces)];
  const unsigned bad = 2u + (unsigned)(splitmix_bits(r) % 200);
  v3_t pos = {0.0f, 0.0f, between(r, 0.0, 2.0)};
  quat_t q = quat_unit((quat_t){1.0f, between(r, -0.1, 0.1), between(r, -0.1, 0.1), between(r, -1, 1)});
  for (int k = 0; k < STORM_MS; k++) {
    if (one_in(r, 300)) draw_setpoint(r, &s->in.setpoint);
    if (one_in(r, 500)) pos.z += between(r, -0.5, 0.5);
    if (one_in(r, 500))
      q = quat_unit((quat_t){between(r, -1, 1), between(r, -1, 1), between(r, -1, 1), 0.3f});
    if (one_in(r, 1000)) {
      flight_param_t p;
      draw_params(r, &p);
      CHECK_OK(flight_tune(&s->f, &p));
    }
    float force_N[MOTORS];
    memcpy(force_N, s->f.out.motors.force_N, sizeof force_N);
    good_input(r, &s->in, pos, q, force_N);
    s->in.range_new = k % 100 == 0 || one_in(r, 200);
    s->in.range_m = between(r, 0.0, 3.0);
    s->in.range_age_s = 0.07f;
    flight_setpoint_t kept = s->in.setpoint;
    while (one_in(r, bad) || (bad < 6 && one_in(r, 3))) spoil(r, &s->in);
    if (!step(s, time_passes(r, pace))) return false;
    s->in.setpoint = kept;
  }
  return true;
}

static bool calm(storm_t *s, splitmix_t *r) {
  flight_param_t p;
  params_default(&p);
  CHECK_OK(flight_tune(&s->f, &p));
  const float each_N = 0.25f * p.pos.mass_kg * GRAVITY_MPS2;
  const float hover_N[MOTORS] = {each_N, each_N, each_N, each_N};
  // What a pilot has to let go of the height for: a hand-over, or a height that was reset by more than 1 m.
  const float off_m = s->f.height_off_m + (AT_M - s->f.height_m);
  const bool let_go = s->f.guard.action == GUARD_HAND_OVER || fabsf(s->f.height_off_m) > 0.9f ||
                      fabsf(off_m) > 0.9f || one_in(r, 2);
  s->in.setpoint = (flight_setpoint_t){.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION};
  for (int k = 0; k < CALM_MS; k++) {
    good_input(r, &s->in, (v3_t){0.0f, 0.0f, AT_M}, (quat_t){.w = 1.0f}, hover_N);
    s->in.setpoint.z = let_go && k < 100 ? AXIS_OFF : AXIS_POSITION;
    s->in.setpoint.thrust_N = 4.0f * each_N;
    // A retreat is over when the pilot asks for another height.
    s->in.setpoint.pos_w_m.z = (k / ASKED_MS % 2 ? OTHER_M : AT_M) + s->f.height_off_m;
    s->in.range_new = k % 100 == 0;
    s->in.range_m = between(r, 1.49, 1.51);
    if (!step(s, 1)) return false;
  }
  const flight_t *f = &s->f;
  CHECK(f->guard.now == 0u);
  CHECK(f->guard.action == GUARD_FLY);
  CHECK_NEAR(f->guard.acc_bias_mps2, 0.0, 0.05);
  CHECK_NEAR(f->outer.bias.bias_mps2.x, 0.0, 0.05);
  CHECK_NEAR(f->outer.bias.bias_mps2.z, 0.0, 0.05);
  CHECK(!f->guard.acc_lost && !f->guard.vel_lost);
  if (let_go) CHECK(f->height_off_m == 0.0f);
  CHECK_NEAR(f->att.torque_model_Nm.x, 0.0, 1e-6);
  CHECK_NEAR(f->outer.signals.thrust_N, 4.0f * each_N, 1e-3);
  CHECK_NEAR(f->outer.signals.up_w.z, 1.0, 1e-3);
  return true;
}

static uint64_t number(const char *name, uint64_t otherwise) {
  const char *text = getenv(name);
  return text ? strtoull(text, NULL, 10) : otherwise;
}

// Storm number k of a seed, and 6 s of good input after it.
static bool weather(uint64_t seed, long k) {
  splitmix_t r = {seed * 1000003u + (uint64_t)k};
  storm_t s = {.in = {.step = (uint32_t)splitmix_bits(&r), .q_wb = {.w = 1.0f}}};
  flight_param_t p;
  draw_params(&r, &p);
  CHECK_OK(flight_init(&s.f, &p));
  ROW("seed %llu, storm %ld", (unsigned long long)seed, k);
  if (!rage(&s, &r)) return false;
  ROW("seed %llu, after storm %ld", (unsigned long long)seed, k);
  return calm(&s, &r);
}

TEST(nothing_that_comes_leaves_a_trace) {
  const uint64_t seed = number("STORM_SEED", 1);
  const long ticks = (long)number("STORM_TICKS", test_long() ? 10000000 : 300000);
  for (long k = 0; k < ticks / (STORM_MS + CALM_MS); k++)
    if (!weather(seed, k)) return;
}

// What the guard and the outer loop each held of the accelerometer's bias cancelled, and stayed.
TEST(storms_that_left_something_once_leave_nothing) {
  static const struct {
    uint64_t seed;
    long storm;
  } row[] = {{3, 656}, {77, 217}, {1, 854}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) (void)weather(row[i].seed, row[i].storm);
}
