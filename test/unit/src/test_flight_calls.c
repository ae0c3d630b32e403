// test_flight_calls.c - what flight_step hands on and keeps from one call to the next.
#include "flight/flight.h"
#include "rig/test.h"

#define HOVER_N 0.32f

static flight_t fresh(flight_in_t *in) {
  flight_param_t p;
  params_default(&p);
  *in = (flight_in_t){.q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}, .pos_w_m = {.z = 0.5f}};
  for (int i = 0; i < MOTORS; i++) in->force_N[i] = 0.25f * HOVER_N;
  in->setpoint = (flight_setpoint_t){.x = AXIS_POSITION,
                                     .y = AXIS_POSITION,
                                     .z = AXIS_POSITION,
                                     .pos_w_m = {.z = 0.5f},
                                     .thrust_N = HOVER_N};
  flight_t f;
  CHECK_OK(flight_init(&f, &p));
  return f;
}

static void fly(flight_t *f, flight_in_t *in, uint32_t ms) {
  for (; ms > 0; ms--, in->step++) (void)flight_step(f, in);
}

TEST(flight_hands_the_outer_loop_the_last_sample_with_its_age) {
  flight_in_t in;
  flight_t f = fresh(&in);
  fly(&f, &in, 23);
  in.range_new = true, in.range_m = 0.31f, in.range_age_s = 0.07f;
  fly(&f, &in, 1);
  in.range_new = false, in.range_m = 0.9f, in.range_age_s = 0.5f; // left over: no sample
  fly(&f, &in, 9);
  CHECK(f.outer_in.range_new && f.outer_in.range_m == 0.31f && f.outer_in.range_age_s == 0.07f);
  fly(&f, &in, 10);
  CHECK(!f.outer_in.range_new);
}

TEST(flight_tells_the_outer_loop_of_each_period_that_bad_inputs_cost) {
  flight_in_t in;
  flight_t f = fresh(&in);
  fly(&f, &in, 25);
  in.force_N[2] = NAN;
  fly(&f, &in, 20);
  CHECK(f.outer.missed == 2);
  in.force_N[2] = 0.25f * HOVER_N;
  fly(&f, &in, 10);
  CHECK(f.outer.missed == 0);
}

TEST(flight_stops_its_motors_where_no_thrust_is_wanted_by_hand_however_it_lies) {
  flight_in_t in;
  flight_t f = fresh(&in);
  in.setpoint = (flight_setpoint_t){.roll_rad = 0.3f, .yaw = YAW_RATE, .thrust_N = HOVER_N};
  fly(&f, &in, 20);
  CHECK(f.out.motors.thrust_N > 0.9f * HOVER_N && f.heading_known);
  in.setpoint.thrust_N = 0.0f;
  fly(&f, &in, 4);
  for (int i = 0; i < MOTORS; i++) CHECK(f.out.motors.force_N[i] == 0.0f);
  CHECK(!f.att.started && !f.heading_known);
}

TEST(flight_begins_level_and_shows_no_outer_loop_while_the_height_is_let_go) {
  flight_in_t in;
  flight_t f = fresh(&in);
  CHECK(f.out.q_ref.w == 1.0f && f.out.q_ref.x == 0.0f && f.out.outer.thrust_N == 0.0f);
  for (int ms = 0; ms < 40; ms++) {
    if (ms == 20) CHECK(f.out.outer.thrust_N > 0.2f);
    if (ms == 20) in.setpoint = (flight_setpoint_t){.yaw = YAW_RATE, .thrust_N = HOVER_N};
    in.step++;
    (void)flight_step(&f, &in);
  }
  CHECK(f.out.outer.thrust_N == 0.0f && f.out.outer.up_w.z == 1.0f);
}

TEST(flight_has_no_heading_with_its_nose_straight_up_and_takes_x_for_ahead) {
  flight_in_t in;
  flight_t f = fresh(&in);
  in.q_wb = (quat_t){.w = 0.70710678f, .y = -0.70710678f};
  in.setpoint.yaw = YAW_RATE;
  for (int ms = 0; ms < 3; ms++, in.step++) (void)flight_step(&f, &in);
  CHECK(f.heading_ref.cos == 1.0f && f.heading_ref.sin == 0.0f);
}
