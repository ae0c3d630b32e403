// test_flight_heading.c - the heading that is held while the yaw is commanded by its rate.
#include "rig/hover6.h"
#include "rig/test.h"

#define HOVER_N 0.32f

static double wrapped(double rad) {
  return atan2(sin(rad), cos(rad));
}

TEST(flight_forgets_its_heading_while_the_motors_are_off) {
  // Put down, carried about and taken off again, the nose went back to where it once was.
  static const bool rests[] = {true, false}; // the height is let go; or it is controlled, and a floor carries
  for (unsigned i = 0; i < sizeof rests / sizeof *rests; i++) {
    ROW("height %s", rests[i] ? "let go" : "controlled");
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    r.in.set.yaw_by_rate = true;
    hover6_fly(&r, 0.5);
    const double turned_rad = 2.0;
    body_start_t at = {.pos_w_m = {0.0, 0.0, 0.5},
                       .q_wb = {cos(0.5 * turned_rad), 0.0, 0.0, sin(0.5 * turned_rad)}};
    for (int k = 0; k < ROTORS; k++) at.thrust_N[k] = r.model.mass_kg * 9.81 / 4.0;
    body_close(&r.body);
    if (!CHECK_OK(body_open(&r.body, &r.model, INTEGRATE_RK4, 0.002, &at))) return;
    double motor_N[PILOT_MOTORS];
    hover6_sense(&r);
    r.in.set.mode[2] = rests[i] ? PILOT_OFF : PILOT_POSITION;
    r.in.set.pos_w_m.z = rests[i] ? 0.5 : -5.0; // below the floor: no thrust is wanted
    for (int k = 0; k < ROTORS; k++) r.in.applied_N[k] = 0.0;
    hover6_think(&r, 1000, motor_N);
    CHECK(motor_N[0] == 0.0 && motor_N[1] == 0.0 && motor_N[2] == 0.0 && motor_N[3] == 0.0);
    for (int k = 0; k < ROTORS; k++) r.in.applied_N[k] = at.thrust_N[k];
    r.in.set.mode[2] = PILOT_POSITION;
    r.in.set.pos_w_m.z = 0.5;
    double worst_rad = 0.0;
    for (int k = 0; k < 200; k++) {
      hover6_fly(&r, 0.002);
      worst_rad = fmax(worst_rad, fabs(wrapped(hover6_yaw_rad(&r) - turned_rad)));
    }
    CHECK_NEAR(worst_rad, 0.0, 0.02);
    body_close(&r.body);
  }
}

// The heading held, after so long with the nose at nose_rad and this rate; it was 0 before.
static double held_rad(float nose_rad, float rate_radps, double span_s) {
  flight_param_t p;
  params_default(&p);
  flight_in_t in = {.q_wb = {.w = 1.0f}, .acc_b_mps2 = {.z = GRAVITY_MPS2}};
  for (int i = 0; i < MOTORS; i++) in.force_N[i] = 0.25f * HOVER_N;
  in.setpoint = (flight_setpoint_t){.thrust_N = HOVER_N, .yaw = YAW_RATE};
  flight_t f;
  CHECK_OK(flight_init(&f, &p));
  for (; in.step < 10; in.step++) (void)flight_step(&f, &in);
  in.q_wb = (quat_t){.w = cosf(0.5f * nose_rad), .z = sinf(0.5f * nose_rad)};
  in.setpoint.yaw_rate_radps = rate_radps;
  for (const uint32_t end = in.step + (uint32_t)lround(1e3 * span_s); in.step < end; in.step++)
    (void)flight_step(&f, &in);
  return atan2((double)f.heading_ref.sin, (double)f.heading_ref.cos);
}

TEST(flight_heading_that_was_left_behind_can_be_turned_back_but_no_further_away) {
  static const struct {
    const char *what;
    float nose_rad, rate_radps;
    double want_rad;
  } row[] = {
      {"held", 1.0f, 0.0f, 0.0},          {"towards the nose", 1.0f, 1.0f, 0.9},
      {"away from it", 1.0f, -1.0f, 0.0}, {"towards it, right", -1.0f, -1.0f, -0.9},
      {"away, left", -1.0f, 1.0f, 0.0},   {"past it", 0.6f, 2.0f, 1.095},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_NEAR(held_rad(row[i].nose_rad, row[i].rate_radps, 0.9), row[i].want_rad, 0.007);
  }
}
