// flight_state.c - checks that the controller's whole state is finite.
#include "rig/flight_state.h"

#include <stddef.h>
#include <string.h>

// The parts of the state that must always be finite, as floats. Left out is what may be NaN by its meaning
// (no ceiling, no heading).
#define STATE(field)                                                                                         \
  { #field, offsetof(flight_t, field), sizeof(((flight_t *)0)->field) / (sizeof(float)) }
static const struct {
  const char *name;
  size_t offset, n;
} state[] = {
    STATE(att.acc),
    STATE(att.torque),
    STATE(att.torque_model_Nm),
    STATE(att.rate_last_radps),
    STATE(att.yaw_now_Nm),
    STATE(att_filter),
    STATE(att_lag_share),
    STATE(heading_ref),
    STATE(height_m),
    STATE(height_off_m),
    STATE(outer.coef),
    STATE(outer.sync.acc_w),
    STATE(outer.sync.att),
    STATE(outer.sync.distance),
    STATE(outer.sync.att_last),
    STATE(outer.sync.thrust),
    STATE(outer.signals),
    STATE(outer.bias),
    STATE(outer.bias_coef),
    STATE(outer.ceiling.zc_m),
    STATE(outer.ceiling.blind_s),
    STATE(outer.ceiling.climbs_m),
    STATE(outer.learn.rls.theta),
    STATE(outer.learn.rls.P),
    STATE(outer.ground),
    STATE(ground.learn.rls.theta),
    STATE(ground.learn.rls.P),
    STATE(ground.filter),
    STATE(outer.learn.y),
    STATE(outer.height_last_m),
    STATE(outer.carrying_s),
    STATE(outer.out.up_w),
    STATE(height.x),
    STATE(height.P),
    STATE(height.off_m),
    STATE(height.thrust_N),
    STATE(height.share),
    STATE(height.more_m),
    STATE(height.more_mps),
    STATE(outer.out.thrust_N),
    STATE(outer.out.zc_m),
    STATE(outer.out.at),
    STATE(guard.hover_N),
    STATE(guard.acc_bias_mps2),
    STATE(guard.bias_mps2),
    STATE(guard.bias_fast_mps2),
    STATE(guard.bias_s),
    STATE(guard.window_mps),
    STATE(guard.window_vel_mps),
    STATE(guard.carried_s),
    STATE(by_hand.gap_m),
    STATE(by_hand.since_s),
    STATE(guard.rate_life),
    STATE(guard.acc_life),
    STATE(guard.rate_last),
    STATE(guard.acc_last),
    STATE(guard.vel_w_mps),
    STATE(guard.ratio_usual),
    STATE(guard.bad_ms),
    STATE(out.motors.force_N),
    STATE(out.motors.torque_b_Nm),
    STATE(out.motors.thrust_N),
    STATE(out.q_ref),
};

const char *flight_not_finite(const flight_t *f) {
  for (unsigned i = 0; i < sizeof state / sizeof *state; i++)
    for (size_t k = 0; k < state[i].n; k++) {
      float x;
      memcpy(&x, (const char *)f + state[i].offset + k * sizeof x, sizeof x);
      if (!f_finite(x)) return state[i].name;
    }
  return NULL;
}
