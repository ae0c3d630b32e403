// test_flight_in_the_air.c - what has flown is in the air until it has landed; blind, and after long faults.
#include "flight/flight.h"
#include "rig/test.h"

#include <limits.h>
#include <string.h>

#define HOVER_N (0.032f * GRAVITY_MPS2)

static flight_t started(const flight_param_t *p) {
  flight_t f;
  CHECK_OK(flight_init(&f, p));
  return f;
}

// Level hover with sensors that are alive.
static flight_in_t hovering(uint32_t ms) {
  const float noise = 1e-3f * (float)(ms * 7919u % 13u);
  return (flight_in_t){
      .step = ms,
      .rate_b_radps = {noise, -noise, noise},
      .acc_b_mps2 = {noise, noise, GRAVITY_MPS2 + noise},
      .pos_w_m = {.z = 1.0f},
      .q_wb = {.w = 1.0f},
      .force_N = {0.25f * HOVER_N, 0.25f * HOVER_N, 0.25f * HOVER_N, 0.25f * HOVER_N},
      .setpoint = {.x = AXIS_POSITION, .y = AXIS_POSITION, .z = AXIS_POSITION, .pos_w_m = {.z = 1.0f}},
  };
}

typedef enum { HOVERS, FALLS, FALLS_TURNED, STANDS, TURNED_BY_HAND } phase_t;

// Little thrust, and what the accelerometer feels then.
static flight_in_t in_phase(phase_t phase, uint32_t ms) {
  flight_in_t in = hovering(ms);
  if (phase == HOVERS) return in;
  for (int m = 0; m < MOTORS; m++) in.force_N[m] = 0.002f;
  if (phase == FALLS || phase == FALLS_TURNED) in.acc_b_mps2.z -= 9.5f;
  if (phase == TURNED_BY_HAND) in.acc_b_mps2 = (v3_t){in.acc_b_mps2.x, 8.5f, -4.9f};
  if (phase == FALLS_TURNED || phase == TURNED_BY_HAND) in.q_wb = (quat_t){.w = 0.5f, .x = 0.8660254f};
  return in;
}

TEST(flight_is_in_the_air_until_a_floor_carries_it) {
  static const struct {
    const char *what;
    struct {
      phase_t phase;
      int ms;
    } part[4];
    guard_action_t want;
  } row[] = {
      {"turned over in hover", {{HOVERS, 2000}, {FALLS_TURNED, 200}}, GUARD_HAND_OVER},
      // It used to count as landed as soon as it gave little thrust.
      {"turned over while it falls", {{HOVERS, 2000}, {FALLS, 2000}, {FALLS_TURNED, 200}}, GUARD_HAND_OVER},
      {"a bump on the way",
       {{HOVERS, 2000}, {FALLS, 500}, {STANDS, 60}, {FALLS_TURNED, 200}},
       GUARD_HAND_OVER},
      {"landed, then turned by hand", {{HOVERS, 2000}, {STANDS, 1000}, {TURNED_BY_HAND, 2000}}, GUARD_FLY},
      {"never flown, turned by hand", {{STANDS, 2000}, {TURNED_BY_HAND, 2000}}, GUARD_FLY},
      {"landed, and up again",
       {{HOVERS, 2000}, {STANDS, 1000}, {HOVERS, 500}, {FALLS_TURNED, 400}},
       GUARD_HAND_OVER},
  };
  flight_param_t p;
  params_default(&p);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_t f = started(&p);
    uint32_t ms = 0;
    for (int part = 0; part < 4; part++)
      for (const uint32_t end = ms + (uint32_t)row[i].part[part].ms; ms < end; ms++) {
        const flight_in_t in = in_phase(row[i].part[part].phase, ms);
        flight_step(&f, &in);
      }
    CHECK(f.guard.action == row[i].want);
  }
}

TEST(flight_that_sees_nothing_keeps_to_the_motors_limit) {
  flight_param_t p;
  params_default(&p);
  p.mixer.force_max_N = 0.05f;
  flight_t f = started(&p);
  for (uint32_t ms = 0; ms < 3000; ms++) {
    flight_in_t in = hovering(ms);
    if (ms >= 2500) in.rate_b_radps.x = NAN;
    flight_step(&f, &in);
    for (int m = 0; m < MOTORS; m++)
      if (!CHECK(f.out.motors.force_N[m] >= 0.0f && f.out.motors.force_N[m] <= 0.05f)) return;
  }
  CHECK(f.guard.action == GUARD_HAND_OVER);
  CHECK(f.out.motors.force_N[0] == 0.05f && f.out.motors.thrust_N == 0.2f);
}

TEST(flight_counts_to_the_end_and_stops) {
  flight_param_t p;
  params_default(&p);
  flight_t f = started(&p);
  uint32_t ms = 0;
  for (; ms < 2000; ms++) {
    const flight_in_t in = hovering(ms);
    flight_step(&f, &in);
  }
  f.faults[ST_BAD_INPUT] = f.outer.faults[ST_BAD_INPUT] = UINT_MAX - 1;
  for (int k = 0; k < 3000; k++) { // pauses of 33 ms, and nothing to fly with after them
    ms += 33;
    flight_in_t in = hovering(ms);
    in.rate_b_radps.x = NAN;
    in.force_N[1] = k % 2 ? 0.1f : NAN;
    flight_step(&f, &in);
  }
  CHECK(f.faults[ST_BAD_INPUT] == UINT_MAX);
  CHECK(f.outer.missed == OUTER_MISSED_MAX);
  CHECK(f.inner_ms >= 1000 && f.inner_ms < 1100);
  flight_in_t let_go = hovering(++ms);
  let_go.setpoint = (flight_setpoint_t){.yaw = YAW_RATE};
  flight_step(&f, &let_go);
  f.outer.missed = UINT_MAX - 3; // flipped bits
  f.inner_ms = INT_MAX;
  f.waited = UINT_MAX;
  for (int k = 0; k < 100; k++) {
    ms += 33;
    const flight_in_t in = hovering(ms);
    flight_step(&f, &in);
  }
  CHECK(f.outer.missed <= 3 && f.inner_ms <= 33 && f.waited <= 4);
  CHECK(f_finite(f.out.outer.thrust_N) && v3_within(f.outer.bias.bias_mps2, 0.5f));
}
