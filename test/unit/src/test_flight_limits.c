// test_flight_limits.c - the whole controller where thrust, tilt or heading end, and where calls are missed.
#include "flight/watch.h"
#include "rig/hover6.h"
#include "rig/test.h"

#define HOVER_N 0.32f

static double sum(const double motor_N[PILOT_MOTORS]) {
  return motor_N[0] + motor_N[1] + motor_N[2] + motor_N[3];
}

TEST(flight_stays_upright_where_it_wants_no_thrust) {
  // The motors give nothing for a while but what keeps the vehicle level.
  static const struct {
    const char *what;
    pilot_mode_t mode;
    double z_m, climb_mps;
  } row[] = {{"2.5 m down, wanted at 5 m/s", PILOT_POSITION, 3.5, 0.0},
             {"down at 4 m/s", PILOT_VELOCITY, 0.0, -4.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    r.body.y[RIGID_POS_M + 2] = r.in.set.pos_w_m.z = 6.0;
    hover6_fly(&r, 0.5);
    r.in.set.mode[2] = row[i].mode;
    r.in.set.pos_w_m.z = row[i].z_m;
    r.in.set.vel_mps.z = row[i].climb_mps;
    double tilt_rad = 0.0;
    bool struck = false;
    for (int k = 0; k < 500; k++) {
      hover6_fly(&r, 0.002);
      if (!struck && sum(r.in.applied_N) < 0.01) {
        r.body.y[RIGID_RATE_RADPS] += 2.0;
        struck = true;
      }
      tilt_rad = fmax(tilt_rad, hover6_tilt_rad(&r));
    }
    CHECK(struck);
    CHECK(tilt_rad < 10.0 / 57.3);
    body_close(&r.body);
  }
}

TEST(flight_does_not_start_its_motors_on_a_floor_that_is_not_level) {
  hover6_t r = {.in = {.step = 0}};
  hover6_start(&r, 0.0);
  hover6_sense(&r);
  r.in.q_wb = (dq_t){cos(0.03), sin(0.03), 0.0, 0.0};
  r.in.acc_b_mps2 = (d3_t){0.0, 9.81 * sin(0.06), 9.81 * cos(0.06)};
  r.in.set.pos_w_m.z = 0.2;
  for (int i = 0; i < PILOT_MOTORS; i++) r.in.applied_N[i] = 0.0;
  double most_N = 0.0;
  for (int ms = 0; ms < 3000; ms++) {
    double motor_N[PILOT_MOTORS];
    hover6_think(&r, 1, motor_N);
    for (int i = 0; i < PILOT_MOTORS; i++) r.in.applied_N[i] = motor_N[i];
    most_N = fmax(most_N, sum(motor_N));
  }
  CHECK(most_N == 0.0);
  body_close(&r.body);
}

TEST(flight_takes_the_height_over_in_the_air_without_a_gap_in_the_thrust) {
  for (int phase = 0; phase < 10; phase++) {
    ROW("taken over in millisecond %d of ten", phase);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    r.in.set.mode[2] = PILOT_OFF;
    r.in.set.thrust_N = r.model.mass_kg * 9.81;
    double motor_N[PILOT_MOTORS];
    hover6_sense(&r);
    hover6_think(&r, 50 + phase, motor_N);
    r.in.set.mode[2] = PILOT_POSITION;
    for (int ms = 0; ms < 12; ms++) {
      hover6_think(&r, 1, motor_N);
      CHECK_NEAR(sum(motor_N), r.model.mass_kg * 9.81, 0.01);
    }
    body_close(&r.body);
  }
}

// In hover by hand, open loop; the first call is due for the inner loop.
static flight_t by_hand(flight_param_t *p, flight_in_t *in) {
  params_default(p);
  p->att_cutoff_Hz = 0.0f;
  *in = (flight_in_t){.q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}};
  for (int i = 0; i < MOTORS; i++) in->force_N[i] = 0.25f * HOVER_N;
  in->setpoint = (flight_setpoint_t){.thrust_N = HOVER_N};
  flight_t f;
  CHECK_OK(flight_init(&f, p));
  return f;
}

TEST(flight_by_hand_goes_no_further_than_the_largest_tilt) {
  static const struct {
    float roll_rad, pitch_rad;
  } row[] = {{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("roll %g, pitch %g", (double)row[i].roll_rad, (double)row[i].pitch_rad);
    flight_param_t p;
    flight_in_t in;
    flight_t f = by_hand(&p, &in);
    in.setpoint.roll_rad = row[i].roll_rad;
    in.setpoint.pitch_rad = row[i].pitch_rad;
    const v3_t up = quat_up(flight_step(&f, &in)->q_ref);
    CHECK_NEAR(up.x, row[i].pitch_rad * sinf(p.pos.tilt_max_rad), 1e-5);
    CHECK_NEAR(up.y, -row[i].roll_rad * sinf(p.pos.tilt_max_rad), 1e-5);
  }
}

TEST(flight_heading_runs_no_further_ahead_than_half_a_radian) {
  for (int side = -1; side <= 1; side += 2) {
    ROW("side %d", side);
    flight_param_t p;
    flight_in_t in;
    flight_t f = by_hand(&p, &in);
    in.setpoint.yaw = YAW_RATE;
    in.setpoint.yaw_rate_radps = 3.0f * (float)side;
    for (; in.step < 2000; in.step++) (void)flight_step(&f, &in); // something holds the vehicle
    CHECK_NEAR(atan2((double)f.heading_ref.sin, (double)f.heading_ref.cos), 0.495 * side, 0.007);
  }
}

TEST(flight_divides_a_change_of_rate_by_the_time_that_it_took) {
  for (uint32_t ms = 2; ms <= 50; ms += ms < 5 ? 1 : 9) {
    ROW("%u ms", (unsigned)ms);
    flight_param_t p;
    flight_in_t in;
    flight_t f = by_hand(&p, &in);
    in.step = 1;
    (void)flight_step(&f, &in);
    if (ms == 2) {
      in.step = 2;
      (void)flight_step(&f, &in);
    }
    in.step = 1 + ms;
    in.rate_b_radps.x = 0.02f;
    const float acc = 0.02f / (0.001f * (float)ms), nu = p.att.kd_per_s * -0.02f;
    const float want_Nm = p.att.quick * p.att.inertia_xx_kgm2 * (nu - acc);
    CHECK_NEAR(flight_step(&f, &in)->motors.torque_b_Nm.x, want_Nm, 1e-7);
  }
}

TEST(flight_runs_its_loops_in_milliseconds_of_their_own) {
  for (uint32_t first = 0; first < 10; first++) {
    flight_param_t p;
    flight_in_t in;
    flight_t f = by_hand(&p, &in);
    for (uint32_t step = first; step < first + 30; step++) {
      ROW("first %u, step %u", (unsigned)first, (unsigned)step);
      CHECK(watch_time(&f, step));
      const unsigned due = (step % 10 == 0 && step > first ? (unsigned)FLIGHT_OUTER : 0u) |
                           (step % 10 == 4 && step > first ? (unsigned)FLIGHT_LEARN : 0u) |
                           (step % 10 == 2 && step > first ? (unsigned)FLIGHT_HEIGHT : 0u) |
                           (step % 10 == 8 && step > first ? (unsigned)FLIGHT_SCRUB : 0u) |
                           (step % 10 == 6 && step > first ? (unsigned)FLIGHT_GROUND : 0u) |
                           (step % 2 == 1 || step == first ? (unsigned)FLIGHT_INNER : 0u);
      CHECK(f.due == due);
      f.step_last = step; // as the guard does when it has read the time
    }
  }
}
