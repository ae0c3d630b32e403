// test_flight.c - the whole controller in six degrees of freedom: set points of every kind, bad inputs, and
// none of the eight faults of the firmware's own INDI (spec "the peer").
#include "pilot_flight.h"
#include "setup6.h"
#include "test.h"

#include <string.h>

// A quiet flight in free air that starts in hover at 0.5 m.
typedef struct {
  body_t body;
  model_t model;
  pilot_flight_t flight;
  pilot6_t pilot;
  pilot6_in_t in;
  d3_t acc_bias_b_mps2;
} rig_t;

static void start(rig_t *r, double yaw_rad) {
  setup6_t setup;
  why_t why;
  CHECK_OK(setup6_thesis(&setup, FLY_INDI, &why));
  r->model = setup.model;
  r->model.ceiling_m = HUGE_VAL;
  setup.flight.curve.mode = CURVE_OFF;
  body_start_t at = {.pos_w_m = {0.0, 0.0, 0.5}, .q_wb = {cos(0.5 * yaw_rad), 0.0, 0.0, sin(0.5 * yaw_rad)}};
  for (int i = 0; i < ROTORS; i++) at.thrust_N[i] = r->in.applied_N[i] = r->model.mass_kg * 9.81 / 4.0;
  CHECK_OK(body_open(&r->body, &r->model, INTEGRATE_RK4, 0.002, &at));
  CHECK_OK(pilot_flight_init(&r->flight, &setup.flight, &r->model, &r->pilot));
  for (int i = 0; i < 3; i++) r->in.set.mode[i] = PILOT6_POSITION;
  r->in.set.pos_w_m = at.pos_w_m;
  r->in.vbat_V = r->body.vbat_V;
  r->in.set.yaw_rad = yaw_rad;
}

// What is true, with the bias on the accelerometer.
static void sense(rig_t *r) {
  const double *y = r->body.y;
  r->in.gyro_b_radps = d3_of(y + RIGID_RATE_RADPS);
  r->in.acc_b_mps2 = d3_add(body_specific_force_b_mps2(&r->body), r->acc_bias_b_mps2);
  r->in.pos_w_m = d3_of(y + RIGID_POS_M);
  r->in.vel_w_mps = d3_of(y + RIGID_VEL_MPS);
  r->in.q_wb = dq_of(y + RIGID_Q_WB);
}

// The same measurements for so long; motor_N is the last command.
static void think(rig_t *r, int span_ms, double motor_N[PILOT6_MOTORS]) {
  for (int ms = 0; ms < span_ms; ms++) {
    r->pilot.step(r->pilot.state, &r->in, motor_N);
    r->in.step++;
  }
}

static void fly(rig_t *r, double span_s) {
  for (long tick = 0; tick < lround(span_s / 0.002); tick++) {
    double motor_N[PILOT6_MOTORS];
    sense(r);
    think(r, 2, motor_N);
    body_tick(&r->body, motor_N, 0.002);
    for (int i = 0; i < ROTORS; i++) r->in.applied_N[i] = r->body.command_N[i];
  }
}

static double yaw_of(const rig_t *r) {
  const dq_t q = dq_of(r->body.y + RIGID_Q_WB);
  return atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

static d3_t pos_of(const rig_t *r) {
  return d3_of(r->body.y + RIGID_POS_M);
}

TEST(flight_reaches_positions_and_stays) {
  static const d3_t to[] = {{0.5, 0.0, 0.5}, {0.0, -0.5, 0.7}, {-0.3, 0.3, 0.3}};
  for (unsigned i = 0; i < sizeof to / sizeof *to; i++) {
    ROW("to %g %g %g", to[i].x, to[i].y, to[i].z);
    rig_t r = {.in = {.step = 0}};
    start(&r, 0.7);
    r.in.set.pos_w_m = to[i];
    fly(&r, 12.0);
    const d3_t error = d3_sub(pos_of(&r), to[i]);
    CHECK_NEAR(d3_norm(error), 0.0, 0.01);
    CHECK_NEAR(yaw_of(&r), 0.7, 0.01);
    body_close(&r.body);
  }
}

TEST(flight_keeps_its_heading_while_it_turns_by_rate) {
  // Fault 1 of the peer: the target is converted from degrees every tick, and the nose driven to 0.
  rig_t r = {.in = {.step = 0}};
  start(&r, 1.0);
  r.in.set.yaw_by_rate = true;
  fly(&r, 3.0);
  CHECK_NEAR(yaw_of(&r), 1.0, 0.02);
  r.in.set.yaw_rate_radps = 0.5;
  fly(&r, 2.0);
  CHECK_NEAR(yaw_of(&r), 2.0, 0.15);
  r.in.set.yaw_rate_radps = 0.0;
  fly(&r, 3.0);
  CHECK_NEAR(yaw_of(&r), 2.0, 0.05);
  body_close(&r.body);
}

TEST(flight_turns_the_shorter_way_round) {
  // Fault 2: the error is not wrapped.
  rig_t r = {.in = {.step = 0}};
  start(&r, 3.05);
  r.in.set.yaw_rad = -3.05; // 10.5 degrees to the left across the seam
  double away = 0.0;
  for (int k = 0; k < 100; k++) {
    fly(&r, 0.02);
    away = fmax(away, fabs(fabs(yaw_of(&r)) - 3.14159265));
  }
  CHECK(away < 0.2);
  CHECK_NEAR(yaw_of(&r), -3.05, 0.02);
  r.in.set.yaw_rad = -3.05 + 40.0 * 3.14159265358979; // any number of turns
  fly(&r, 2.0);
  CHECK_NEAR(yaw_of(&r), -3.05, 0.02);
  body_close(&r.body);
}

TEST(flight_takes_a_velocity_of_the_body_along_its_heading) {
  // Fault 3: taken for one of the world. Heading +y: forward is +y.
  rig_t r = {.in = {.step = 0}};
  start(&r, 1.5707963);
  r.in.set.mode[0] = r.in.set.mode[1] = PILOT6_VELOCITY;
  r.in.set.vel_in_body = true;
  r.in.set.vel_mps = (d3_t){0.3, 0.0, 0.0};
  fly(&r, 4.0);
  CHECK_NEAR(r.body.y[RIGID_VEL_MPS], 0.0, 0.02);
  CHECK_NEAR(r.body.y[RIGID_VEL_MPS + 1], 0.3, 0.02);
  body_close(&r.body);
}

TEST(flight_by_hand_takes_tilts_for_radians) {
  // Fault 4: with the outer loop off, degrees were used as radians. Here all is SI; a tilt is what it says.
  rig_t r = {.in = {.step = 0}};
  start(&r, 0.0);
  flight_in_t in = {.q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}};
  for (int i = 0; i < MOTORS; i++) in.force_N[i] = 0.08f;
  in.setpoint = (flight_setpoint_t){.roll_rad = 0.1f, .pitch_rad = -0.2f, .thrust_N = 0.32f};
  const flight_out_t out = flight_step(r.flight.flight, &r.flight.param, &in);
  const v3_t up = quat_up(out.q_ref);
  CHECK_NEAR(up.x, sin(-0.2) * cos(0.1), 1e-5);
  CHECK_NEAR(up.y, -sin(0.1), 1e-5);
  CHECK_NEAR(out.motors.thrust_N, 0.32, 1e-6);
  body_close(&r.body);
}

TEST(flight_learns_nothing_wrong_on_the_ground) {
  // Fault 5: 30 s on the ground with -0.01 g wound the thrust up to full. Here the first command is a small
  // step.
  rig_t r = {.in = {.step = 0}};
  start(&r, 0.0);
  r.in.set.mode[0] = r.in.set.mode[1] = r.in.set.mode[2] = PILOT6_OFF;
  double motor_N[PILOT6_MOTORS], sum = 0.0;
  for (int i = 0; i < PILOT6_MOTORS; i++) r.in.applied_N[i] = 0.0;
  sense(&r);
  r.in.acc_b_mps2 = (d3_t){0.0, 0.0, 9.81 - 0.0981};
  think(&r, 30000, motor_N);
  CHECK(motor_N[0] == 0.0 && motor_N[1] == 0.0 && motor_N[2] == 0.0 && motor_N[3] == 0.0);
  for (int i = 0; i < 3; i++) r.in.set.mode[i] = PILOT6_POSITION;
  think(&r, 11, motor_N);
  for (int i = 0; i < PILOT6_MOTORS; i++) sum += motor_N[i];
  CHECK(sum <= (double)r.flight.param.step_max_N + 1e-6);
  body_close(&r.body);
}

TEST(flight_finds_the_bias_of_its_accelerometer) {
  // Fault 6: 0.01 g was a standing error of 2 cm, for ever.
  for (int on = 0; on < 2; on++) {
    ROW("bias %s", on ? "found" : "not looked for");
    rig_t r = {.in = {.step = 0}};
    start(&r, 0.0);
    r.flight.param.bias.pole_radps = on ? 1.0f : 0.0f;
    r.flight.param.bias.vel_s = 0.0f; // the velocity is exact here
    r.acc_bias_b_mps2 = (d3_t){0.0, 0.0, 0.0981};
    fly(&r, 20.0);
    CHECK_NEAR(pos_of(&r).z - 0.5, on ? 0.0 : -0.0981 / 5.0, on ? 1e-3 : 5e-4);
    body_close(&r.body);
  }
}

TEST(flight_uses_velocity_and_acceleration_of_a_trajectory) {
  // Fault 7: they were dropped. A circle of 0.2 m at 1.5 rad/s is followed closely with them, badly without.
  double error_m[2] = {0.0, 0.0};
  for (int with = 0; with < 2; with++) {
    rig_t r = {.in = {.step = 0}};
    start(&r, 0.0);
    for (int k = 0; k < 4000; k++) {
      const double ramp = fmin(1.0, 0.002 * k / 3.0), w = 1.5, a = w * 0.002 * k, s = sin(a), c = cos(a);
      r.in.set.pos_w_m = (d3_t){0.2 * ramp * c, 0.2 * ramp * s, 0.5};
      r.in.set.vel_mps = with ? (d3_t){-0.2 * w * s * ramp, 0.2 * w * c * ramp, 0.0} : (d3_t){0, 0, 0};
      r.in.set.acc_w_mps2 =
          with ? (d3_t){-0.2 * w * w * c * ramp, -0.2 * w * w * s * ramp, 0.0} : (d3_t){0, 0, 0};
      fly(&r, 0.002);
      if (k > 2500) error_m[with] = fmax(error_m[with], d3_norm(d3_sub(pos_of(&r), r.in.set.pos_w_m)));
    }
    body_close(&r.body);
  }
  CHECK(error_m[1] < 0.5 * error_m[0]);
}

TEST(flight_takes_a_changed_cut_off_over_at_once) {
  // Fault 8: cut-offs acted only after the controller had been selected again.
  rig_t r = {.in = {.step = 0}};
  start(&r, 0.0);
  fly(&r, 0.5);
  const lpf2_coef_t inner = r.flight.flight->att_filter, outer = r.flight.flight->outer.coef.filter;
  r.flight.param.cutoff_Hz = 15.0f;
  r.flight.param.att_cutoff_Hz = 30.0f;
  fly(&r, 0.02);
  CHECK(memcmp(&inner, &r.flight.flight->att_filter, sizeof inner) != 0);
  CHECK(memcmp(&outer, &r.flight.flight->outer.coef.filter, sizeof outer) != 0);
  fly(&r, 2.0);
  CHECK_NEAR(pos_of(&r).z, 0.5, 0.01); // without a bump
  body_close(&r.body);
}

TEST(flight_counts_an_applied_force_that_is_not_a_number) {
  rig_t r = {.in = {.step = 0}};
  start(&r, 0.0);
  fly(&r, 1.0);
  const flight_t before = *r.flight.flight;
  flight_in_t bad = r.flight.vehicle.app.in;
  bad.step++;
  bad.force_N[2] = NAN;
  const flight_out_t out = flight_step(r.flight.flight, &r.flight.param, &bad);
  CHECK(memcmp(&out.motors, &before.out.motors, sizeof out.motors) == 0);
  CHECK(r.flight.flight->faults[ST_BAD_INPUT] == before.faults[ST_BAD_INPUT] + 1);
  CHECK(memcmp(&before.att, &r.flight.flight->att, sizeof before.att) == 0);
  body_close(&r.body);
}

TEST(flight_gives_its_last_command_on_an_input_that_is_not_a_number) {
  rig_t r = {.in = {.step = 0}};
  start(&r, 0.0);
  fly(&r, 1.0);
  sense(&r);
  double before[PILOT6_MOTORS], after[PILOT6_MOTORS];
  r.pilot.step(r.pilot.state, &r.in, before);
  const flight_t state = *r.flight.flight;
  static const double odd[] = {(double)NAN, 1e38};
  for (unsigned k = 0; k < sizeof odd / sizeof *odd; k++) {
    for (int field = 0; field < 3; field++) {
      ROW("field %d, %g", field, odd[k]);
      *r.flight.flight = state;
      pilot6_in_t bad = r.in;
      bad.step++;
      double *const place[] = {&bad.gyro_b_radps.y, &bad.q_wb.x, &bad.q_wb.w};
      *place[field] = odd[k];
      r.pilot.step(r.pilot.state, &bad, after);
      for (int i = 0; i < PILOT6_MOTORS; i++) CHECK_NEAR(after[i], before[i], 0.0);
      CHECK(r.flight.flight->faults[ST_BAD_INPUT] > state.faults[ST_BAD_INPUT]);
      CHECK(memcmp(&state.att, &r.flight.flight->att, sizeof state.att) == 0);
    }
  }
  body_close(&r.body);
}

TEST(flight_does_not_take_up_a_range_sample_from_before_it_flew) {
  rig_t r = {.in = {.step = 0}};
  start(&r, 0.0);
  double motor_N[PILOT6_MOTORS];
  r.in.set.mode[2] = PILOT6_OFF;
  for (int ms = 0; ms < 40; ms++) {
    sense(&r);
    r.in.range_new = ms == 25;
    r.in.range_m = 0.3;
    think(&r, 1, motor_N);
  }
  r.in.set.mode[2] = PILOT6_POSITION;
  think(&r, 20, motor_N);
  CHECK(!r.flight.flight->outer.ceiling.known);
  body_close(&r.body);
}
