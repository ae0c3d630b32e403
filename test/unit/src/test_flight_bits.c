// test_flight_bits.c - any one bit of the controller's memory flips in flight (faults row 50 flies some of
// them in closed loop).
#include "rig/flight_state.h"
#include "rig/test.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define FLIES_MS  1200
#define AFTER_MS  300
#define MOST_N    0.025f // of a motor, a third of what it hovers with: by so much may it be off by then
#define CEILING_M 0.10f
#define FLOOR_M   0.05f

// A sanitizer refuses a truth value that is none, which hardware does not: there, the lowest bit of each
// byte.
#ifndef __has_feature
#define __has_feature(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
#define BITS 1
#else
#define BITS 8
#endif

static flight_in_t hovering(uint32_t ms, yaw_mode_t yaw) {
  const float noise = 1e-3f * (float)(ms * 7919u % 13u), each_N = 0.25f * 0.032f * GRAVITY_MPS2;
  return (flight_in_t){
      .step = ms,
      .rate_b_radps = {noise, -noise, noise},
      .acc_b_mps2 = {noise, noise, GRAVITY_MPS2 + noise},
      .pos_w_m = {.z = FLOOR_M},
      .q_wb = {.w = 1.0f},
      .force_N = {each_N, each_N, each_N, each_N},
      .range_new = ms % 100 == 0,
      .range_m = CEILING_M + noise,
      .range_age_s = 0.07f,
      .down_m = ms % 20 == 2 ? FLOOR_M + 0.1f * noise : 0.0f, // in the height's own millisecond
      .setpoint =
          {.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION, .pos_w_m = {.z = FLOOR_M}, .yaw = yaw},
  };
}

static bool within(const flight_t *f) {
  for (int i = 0; i < MOTORS; i++) {
    const float force_N = f->out.motors.force_N[i];
    if (!(force_N >= 0.0f && force_N <= f->outer.param.mixer.force_max_N)) return false;
  }
  return true;
}

static bool as_without(const flight_t *f, const flight_t *without) {
  for (int i = 0; i < MOTORS; i++)
    if (!(fabsf(f->out.motors.force_N[i] - without->out.motors.force_N[i]) <= MOST_N)) return false;
  return f->guard.action == without->guard.action;
}

#define FIELD(name) offsetof(flight_t, name), sizeof(((flight_t *)0)->name)

// The app puts its own copy of the set back (settings.h).
static bool is_param(size_t byte) {
  const struct { size_t at, size; } all = {FIELD(outer.param)};
  return byte >= all.at && byte < all.at + all.size;
}

// What with one bit flipped is another that could as well be true, and is flown by: only a second memory of
// it would tell.
static bool could_be_true(size_t byte) {
  static const struct {
    size_t at, size;
  } field[] = {{FIELD(outer.hold.ceiling_z_m)},  // until three samples refute it
               {FIELD(outer.height_last_m)},     // a reset of the estimated height
               {FIELD(height_m)},                // the same
               {FIELD(height_off_m)},            // the sum of such; beyond 1 m it goes down
               {FIELD(guard.nearer)},            // a ceiling that is too near: it goes down
               {FIELD(outer.bias.vel_off_mps)}}; // is forgotten over half a second
  for (unsigned i = 0; i < sizeof field / sizeof *field; i++)
    if (byte >= field[i].at && byte < field[i].at + field[i].size) return true;
  return false;
}

// What is not as it should be afterwards; null: all is. A command that was there stands until the inner loop
// runs, and the learner mends its own with the next lesson (rls_recovers_from_any_flipped_bit_of_p).
static const char *with_flipped(const flight_t *before, const flight_t *without, yaw_mode_t yaw, size_t byte,
                                int bit) {
  static flight_t f; // too large for the stack of a test
  memcpy(&f, before, sizeof f);
  ((unsigned char *)&f)[byte] ^= (unsigned char)(1u << bit);
  for (uint32_t ms = 0; ms < AFTER_MS; ms++) {
    const flight_in_t in = hovering(FLIES_MS + ms, yaw);
    flight_step(&f, &in);
    if (ms >= 2 && !within(&f)) return "motors";
  }
  const char *wrong = flight_not_finite(&f);
  if (wrong && !strstr(wrong, "learn.rls")) return wrong;
  return could_be_true(byte) || as_without(&f, without) ? NULL : "not as without";
}

TEST(flight_flies_on_with_any_bit_of_its_memory_flipped) {
  static const struct {
    const char *what;
    int32_t own, ground;
    yaw_mode_t yaw;
  } row[] = {{"as shipped", 0, CURVE_OFF, YAW_ANGLE},
             {"with all that it can, turning", 1, CURVE_LIVE, YAW_RATE}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    flight_param_t p;
    params_default(&p);
    p.curve.mode = CURVE_LIVE;
    p.height.own = row[i].own;
    p.ground.mode = row[i].ground;
    static flight_t f;
    CHECK_OK(flight_init(&f, &p));
    for (uint32_t ms = 0; ms < FLIES_MS; ms++) {
      const flight_in_t in = hovering(ms, row[i].yaw);
      flight_step(&f, &in);
    }
    ROW("%s", row[i].what);
    CHECK(f.out.outer.zc_known && within(&f) && !flight_not_finite(&f));
    CHECK(f.height.share == (float)row[i].own);
    static flight_t without;
    without = f;
    for (uint32_t ms = 0; ms < AFTER_MS; ms++) {
      const flight_in_t in = hovering(FLIES_MS + ms, row[i].yaw);
      flight_step(&without, &in);
    }
    const bool few = !test_long(); // every second bit: of a float the one that makes most of it
    for (size_t byte = 0; byte < sizeof f; byte++)
      for (int bit = few ? (int)((byte + 1) % 2) : 0; bit < BITS && !is_param(byte); bit += few ? 2 : 1) {
        const char *wrong = with_flipped(&f, &without, row[i].yaw, byte, bit);
        if (!wrong) continue;
        ROW("%s: byte %zu, bit %d: %s", row[i].what, byte, bit, wrong);
        CHECK(false);
        return;
      }
  }
}
