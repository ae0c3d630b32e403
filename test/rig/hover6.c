// hover6.c - the flight code in the plant.
#include "rig/hover6.h"

#include "flight/setup.h"
#include "rig/test.h"

void hover6_start(hover6_t *r, double yaw_rad) {
  setup_t setup;
  why_t why;
  CHECK_OK(setup_thesis(&setup, FLY_INDI, &why));
  r->model = setup.model;
  r->model.ceiling_m = HUGE_VAL;
  setup.flight.curve.mode = CURVE_OFF;
  body_start_t at = {.pos_w_m = {0.0, 0.0, 0.5}, .q_wb = {cos(0.5 * yaw_rad), 0.0, 0.0, sin(0.5 * yaw_rad)}};
  for (int i = 0; i < ROTORS; i++) at.thrust_N[i] = r->in.applied_N[i] = r->model.mass_kg * 9.81 / 4.0;
  CHECK_OK(body_open(&r->body, &r->model, INTEGRATE_RK4, 0.002, &at));
  CHECK_OK(pilot_flight_init(&r->flight, &setup.flight, &r->model, &r->pilot));
  for (int i = 0; i < 3; i++) r->in.set.mode[i] = PILOT_POSITION;
  r->in.set.pos_w_m = at.pos_w_m;
  r->in.vbat_V = r->body.vbat_V;
  r->in.set.yaw_rad = yaw_rad;
}

void hover6_sense(hover6_t *r) {
  const double *y = r->body.y;
  r->in.gyro_b_radps = d3_of(y + RIGID_RATE_RADPS);
  r->in.acc_b_mps2 = d3_add(body_specific_force_b_mps2(&r->body), r->acc_bias_b_mps2);
  r->in.pos_w_m = d3_of(y + RIGID_POS_M);
  r->in.pos_w_m.z += r->height_off_m;
  r->in.vel_w_mps = d3_of(y + RIGID_VEL_MPS);
  r->in.q_wb = dq_of(y + RIGID_Q_WB);
}

void hover6_think(hover6_t *r, int span_ms, double motor_N[PILOT_MOTORS]) {
  for (int ms = 0; ms < span_ms; ms++) {
    r->pilot.step(r->pilot.state, &r->in, motor_N);
    r->in.step++;
  }
}

void hover6_fly(hover6_t *r, double span_s) {
  for (long tick = 0; tick < lround(span_s / 0.002); tick++) {
    double motor_N[PILOT_MOTORS];
    hover6_sense(r);
    hover6_think(r, 2, motor_N);
    body_tick(&r->body, motor_N, 0.002);
    for (int i = 0; i < ROTORS; i++) r->in.applied_N[i] = r->body.command_N[i];
  }
}

double hover6_yaw_rad(const hover6_t *r) {
  const dq_t q = dq_of(r->body.y + RIGID_Q_WB);
  return atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

double hover6_tilt_rad(const hover6_t *r) {
  return acos(fmin(dq_to_world(dq_of(r->body.y + RIGID_Q_WB), (d3_t){0.0, 0.0, 1.0}).z, 1.0));
}

d3_t hover6_pos_m(const hover6_t *r) {
  return d3_of(r->body.y + RIGID_POS_M);
}
