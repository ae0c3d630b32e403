// pilot_flight.c - the whole flight code as a pilot.
#include "pilot_flight.h"

#include <math.h>

_Static_assert(MOTORS == PILOT6_MOTORS, "the same vehicle on both sides");

static v3_t v3_from(d3_t a) {
  return (v3_t){(float)a.x, (float)a.y, (float)a.z};
}

static axis_mode_t axis_from(pilot6_mode_t mode) {
  return mode == PILOT6_POSITION ? AXIS_POSITION : mode == PILOT6_VELOCITY ? AXIS_VELOCITY : AXIS_OFF;
}

static flight_setpoint_t setpoint_from(const pilot6_setpoint_t *set) {
  return (flight_setpoint_t){
      .x = axis_from(set->mode[0]),
      .y = axis_from(set->mode[1]),
      .z = axis_from(set->mode[2]),
      .pos_w_m = v3_from(set->pos_w_m),
      .vel_mps = v3_from(set->vel_mps),
      .vel_in_body = set->vel_in_body,
      .acc_w_mps2 = v3_from(set->acc_w_mps2),
      .thrust_N = (float)set->thrust_N,
      .yaw = set->yaw_by_rate ? YAW_RATE : YAW_ANGLE,
      .yaw_rad = (float)set->yaw_rad,
      .yaw_rate_radps = set->yaw_by_rate ? (float)set->yaw_rate_radps : 0.0f,
  };
}

static void step(void *state, const pilot6_in_t *in, double motor_N[PILOT6_MOTORS]) {
  pilot_flight_t *const p = state;
  flight_in_t f = {
      .step = in->step,
      .rate_b_radps = v3_from(in->gyro_b_radps),
      .acc_b_mps2 = v3_from(in->acc_b_mps2),
      .pos_w_m = v3_from(in->pos_w_m),
      .vel_w_mps = v3_from(in->vel_w_mps),
      .q_wb = {(float)in->q_wb.w, (float)in->q_wb.x, (float)in->q_wb.y, (float)in->q_wb.z},
      .range_new = in->range_new,
      .range_m = (float)in->range_m,
      .range_age_s = (float)in->range_age_s,
      .setpoint = setpoint_from(&in->set),
  };
  for (int i = 0; i < MOTORS; i++) f.force_N[i] = (float)in->applied_N[i];
  const flight_out_t out = flight_step(&p->flight, &p->param, &f);
  for (int i = 0; i < MOTORS; i++) motor_N[i] = (double)out.motors.force_N[i];
}

static void reset(void *state) {
  pilot_flight_t *const p = state;
  // The parameters passed when the pilot was made.
  (void)!flight_init(&p->flight, &p->param);
}

status_t pilot_flight_init(pilot_flight_t *p, const flight_param_t *param, pilot6_t *pilot) {
  p->param = *param;
  TRY(flight_init(&p->flight, param));
  *pilot = (pilot6_t){.state = p, .step = step, .reset = reset};
  return ST_OK;
}
