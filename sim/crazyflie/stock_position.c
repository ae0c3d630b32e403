// stock_position.c - the position and velocity cascade of the Crazyflie's PID controller.
#include "crazyflie/stock_position.h"

#include "base/clip.h"

#define VELOCITY_MAX_MPS (1.0 * 1.10) // the limit times its overhead
#define TILT_OVERHEAD    1.10
#define CUTOFF_HZ        20.0
#define THRUST_PID_MAX   32.767

stock_position_param_t stock_position_default(void) {
  const double i_max = PID_BLOCK_INTEGRAL_MAX, tilt_max_deg = 20.0;
  const pid_gain_t level = {2.0, 0.0, 0.0, i_max, VELOCITY_MAX_MPS, CUTOFF_HZ};
  const pid_gain_t height = {2.0, 0.5, 0.0, i_max, VELOCITY_MAX_MPS, CUTOFF_HZ};
  const pid_gain_t speed = {25.0, 1.0, 0.0, i_max, tilt_max_deg * TILT_OVERHEAD, CUTOFF_HZ};
  const pid_gain_t climb = {25.0, 15.0, 0.0, i_max, THRUST_PID_MAX, CUTOFF_HZ};
  return (stock_position_param_t){
      .pos = {level, level, height},
      .vel = {speed, speed, climb},
      .tilt_max_deg = tilt_max_deg,
      .thrust_scale = 1000.0,
      .thrust_base = 36000.0,
      .thrust_min = 20000.0,
  };
}

void stock_position_start(stock_position_t *s, const stock_position_param_t *p, d3_t pos_w_m) {
  const double pos[3] = {pos_w_m.x, pos_w_m.y, pos_w_m.z};
  for (int i = 0; i < 3; i++) {
    pid_block_start(&s->pos[i], &p->pos[i], STOCK_POSITION_HZ, pos[i]);
    pid_block_start(&s->vel[i], &p->vel[i], STOCK_POSITION_HZ, 0.0);
  }
}

// From world axes to those of the heading: a turn by -yaw about z.
static d3_t to_heading(d3_t v, double yaw_deg) {
  const double c = cos(yaw_deg / STOCK_DEG), s = sin(yaw_deg / STOCK_DEG);
  return (d3_t){v.x * c + v.y * s, v.y * c - v.x * s, v.z};
}

stock_position_out_t stock_position_step(stock_position_t *s, const stock_position_param_t *p,
                                         const pilot_in_t *in, double yaw_deg) {
  const d3_t to = to_heading(in->set.pos_w_m, yaw_deg), at = to_heading(in->pos_w_m, yaw_deg);
  const d3_t go = in->set.vel_in_body ? in->set.vel_mps : to_heading(in->set.vel_mps, yaw_deg);
  const d3_t goes = to_heading(in->vel_w_mps, yaw_deg);
  const double wanted_m[3] = {to.x, to.y, to.z}, m[3] = {at.x, at.y, at.z};
  const double wanted_mps[3] = {go.x, go.y, go.z}, mps[3] = {goes.x, goes.y, goes.z};
  double out[3];
  for (int i = 0; i < 3; i++) {
    const bool hold = in->set.mode[i] == PILOT_POSITION;
    const double v = hold
                         ? pid_block_step(&s->pos[i], &p->pos[i], STOCK_POSITION_HZ, wanted_m[i], m[i], false)
                         : wanted_mps[i];
    out[i] = pid_block_step(&s->vel[i], &p->vel[i], STOCK_POSITION_HZ, v, mps[i], false);
  }
  return (stock_position_out_t){
      .roll_deg = clip(-out[1], -p->tilt_max_deg, p->tilt_max_deg),
      .pitch_deg = clip(-out[0], -p->tilt_max_deg, p->tilt_max_deg),
      .thrust = clip(larger(out[2] * p->thrust_scale + p->thrust_base, p->thrust_min), 0.0, STOCK_FULL),
  };
}
