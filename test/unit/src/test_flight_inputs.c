// test_flight_inputs.c - the whole controller with bad inputs, missed calls, and a floor under it.
#include "rig/hover6.h"
#include "rig/test.h"

#include <string.h>

TEST(flight_gives_its_last_command_on_an_input_that_is_not_a_number) {
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  hover6_fly(&r, 1.0);
  hover6_sense(&r);
  double before[PILOT_MOTORS], after[PILOT_MOTORS];
  r.pilot.step(r.pilot.state, &r.in, before);
  const flight_t state = *r.flight.flight;
  static const double odd[] = {(double)NAN, 1e38};
  for (unsigned k = 0; k < sizeof odd / sizeof *odd; k++) {
    for (int field = 0; field < 3; field++) {
      ROW("field %d, %g", field, odd[k]);
      *r.flight.flight = state;
      pilot_in_t bad = r.in;
      bad.step++;
      double *const place[] = {&bad.gyro_b_radps.y, &bad.q_wb.x, &bad.q_wb.w};
      *place[field] = odd[k];
      r.pilot.step(r.pilot.state, &bad, after);
      for (int i = 0; i < PILOT_MOTORS; i++) CHECK_NEAR(after[i], before[i], 0.0);
      CHECK(r.flight.flight->faults[ST_BAD_INPUT] > state.faults[ST_BAD_INPUT]);
      CHECK(memcmp(&state.att, &r.flight.flight->att, sizeof state.att) == 0);
    }
  }
  body_close(&r.body);
}

TEST(flight_counts_an_applied_force_that_is_not_a_number) {
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  hover6_fly(&r, 1.0);
  const flight_t before = *r.flight.flight;
  flight_in_t bad = r.flight.vehicle.app.in;
  bad.step++;
  bad.force_N[2] = NAN;
  const flight_out_t out = *flight_step(r.flight.flight, &bad);
  CHECK(memcmp(&out.motors, &before.out.motors, sizeof out.motors) == 0);
  CHECK(r.flight.flight->faults[ST_BAD_INPUT] == before.faults[ST_BAD_INPUT] + 1);
  CHECK(memcmp(&before.att, &r.flight.flight->att, sizeof before.att) == 0);
  body_close(&r.body);
}

TEST(flight_does_not_take_up_a_range_sample_from_before_it_flew) {
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  double motor_N[PILOT_MOTORS];
  r.in.set.mode[2] = PILOT_OFF;
  for (int ms = 0; ms < 40; ms++) {
    hover6_sense(&r);
    r.in.range_new = ms == 25;
    r.in.range_m = 0.3;
    hover6_think(&r, 1, motor_N);
  }
  r.in.set.mode[2] = PILOT_POSITION;
  hover6_think(&r, 20, motor_N);
  CHECK(!r.flight.flight->outer.ceiling.known);
  body_close(&r.body);
}

TEST(flight_counts_a_set_point_that_is_not_a_number_and_no_other) {
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  hover6_fly(&r, 1.0);
  flight_t *const f = r.flight.flight;
  for (int i = ST_OK + 1; i < ST_COUNT; i++) CHECK(f->faults[i] == 0u);
  flight_in_t in = r.flight.vehicle.app.in;
  for (unsigned k = 1; k <= 3; k++) {
    in.step++;
    in.setpoint.yaw_rad = NAN;
    (void)flight_step(f, &in);
    CHECK(f->faults[ST_BAD_SETPOINT] == k);
  }
  in.step++;
  in.setpoint.yaw_rad = 0.0f;
  (void)flight_step(f, &in);
  CHECK(f->faults[ST_BAD_SETPOINT] == 3u);
  body_close(&r.body);
}
