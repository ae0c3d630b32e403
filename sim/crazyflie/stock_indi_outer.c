// stock_indi_outer.c - the position loop of the Crazyflie firmware's INDI.
#include "crazyflie/stock_indi_outer.h"

#include "base/clip.h"
#include "base/constants.h"

stock_indi_outer_param_t stock_indi_outer_default(void) {
  return (stock_indi_outer_param_t){
      .kp_per_s = 1.0,
      .kd_per_s = 5.0,
      .thrust_mps2 = 0.00024730,
      .tilt_max_deg = 10.0,
      .lag_gain = 0.03149,
      .cutoff_Hz = 8.0,
      .thrust_max = 60000.0,
  };
}

void stock_indi_outer_select(stock_indi_outer_t *s, const stock_indi_outer_param_t *p) {
  for (int i = 0; i < 3; i++) {
    lowpass_init(&s->acc[i], p->cutoff_Hz, STOCK_ATTITUDE_HZ, 0.0);
    lowpass_init(&s->angle[i], p->cutoff_Hz, STOCK_ATTITUDE_HZ, 0.0);
  }
  lowpass_init(&s->thrust_filter, p->cutoff_Hz, STOCK_ATTITUDE_HZ, 0.0);
}

// From axes with y left and z up to axes with y right and z down.
static d3_t down(d3_t v) {
  return (d3_t){v.x, -v.y, -v.z};
}

// The velocity set point is always taken for one along the world's axes (fault 3); velocity and acceleration
// of a trajectory are dropped (fault 7).
static d3_t wanted_acceleration(const stock_indi_outer_param_t *p, const pilot_in_t *in) {
  const d3_t off = d3_sub(in->set.pos_w_m, in->pos_w_m);
  d3_t v = in->set.vel_mps;
  if (in->set.mode[0] == PILOT_POSITION) v.x = p->kp_per_s * off.x;
  if (in->set.mode[1] == PILOT_POSITION) v.y = p->kp_per_s * off.y;
  if (in->set.mode[2] == PILOT_POSITION) v.z = p->kp_per_s * off.z;
  return down(d3_scale(p->kd_per_s, d3_sub(v, in->vel_w_mps)));
}

static d3_t filtered(lowpass_t f[3], d3_t v) {
  return (d3_t){lowpass_step(&f[0], v.x), lowpass_step(&f[1], v.y), lowpass_step(&f[2], v.z)};
}

// The quaternion that turns by yaw, then pitch, then roll.
static dq_t turned(d3_t angle_rad) {
  const dq_t roll = {cos(0.5 * angle_rad.x), sin(0.5 * angle_rad.x), 0.0, 0.0};
  const dq_t pitch = {cos(0.5 * angle_rad.y), 0.0, sin(0.5 * angle_rad.y), 0.0};
  const dq_t yaw = {cos(0.5 * angle_rad.z), 0.0, 0.0, sin(0.5 * angle_rad.z)};
  return dq_mul(yaw, dq_mul(pitch, roll));
}

void stock_indi_outer_step(stock_indi_outer_t *s, const stock_indi_outer_param_t *p, const pilot_in_t *in,
                           const stock_view_t *view) {
  const d3_t wanted = wanted_acceleration(p, in);
  const d3_t acc_b = filtered(s->acc, d3_scale(G_MPS2, down(view->acc_g)));
  const d3_t raw = {view->roll_deg / STOCK_DEG, view->pitch_deg / STOCK_DEG, -view->yaw_deg / STOCK_DEG};
  const d3_t angle =
      filtered(s->angle, raw); // its yaw jumps at +-180 deg, and the filter runs through all headings
  const dq_t q = turned(angle);
  const d3_t acc = d3_add(dq_to_world(q, acc_b), (d3_t){0.0, 0.0, G_MPS2});
  const d3_t e_b = dq_to_body(q, d3_sub(wanted, acc));

  // The thrust is integrated even while the vehicle stands on the ground (fault 5).
  s->lagged_thrust += p->lag_gain * (lowpass_step(&s->thrust_filter, s->thrust) - s->lagged_thrust);
  s->thrust = clip(s->lagged_thrust - e_b.z / p->thrust_mps2, 0.0, p->thrust_max);
  const double tilt_max_rad = p->tilt_max_deg / STOCK_DEG;
  s->roll_rad = clip(angle.x + e_b.y / G_MPS2, -tilt_max_rad, tilt_max_rad);
  s->pitch_rad = clip(angle.y - e_b.x / (G_MPS2 * cos(angle.x)), -tilt_max_rad, tilt_max_rad);
}
