// judge_motion.c - what is wrong with the inertial sensors and the estimated velocity.
#include "flight/bounds.h"
#include "flight/judge.h"

#define ACC_CLIP_MPS2  196.2f // 20 g
#define CLIP_MEMORY_MS 200    // the 8 Hz filter has forgotten
#define FROZEN_MS      25
#define RATE_LIFE      5e-4f // rad/s a millisecond; a tenth of a real gyro's noise
#define ACC_LIFE       2e-3f // m/s2 a millisecond
#define BIAS_MPS2      0.5f  // from here on it is a fault
#define BIAS_MAX_MPS2  3.0f
#define BIAS_STEP_MPS2 0.3f // five times the noise of the mean over BIAS_FAST_S
#define BIAS_FAST_S    0.1f
#define BIAS_SLOW_S    1.0f // what is left by then is the outer loop's
#define BIAS_MS        10   // the estimator's period
#define VEL_STEP_MPS   0.5f // in one period of the estimator: 5 g
#define VEL_CALM_MS    50
#define IMPACT_MPS2    25.0f // along an axis
#define IMPACT_MS      300
#define OFF_MS         250 // garbage that goes as it came is shorter

static float change(v3_t a, v3_t b) {
  return fabsf(a.x - b.x) + fabsf(a.y - b.y) + fabsf(a.z - b.z);
}

// A sensor that was alive and now gives the same bits is frozen. One that never was (a perfect one) is not.
static bool frozen(int *same_ms, float *life, float changed, float least, int ms) {
  *same_ms = judge_longer(*same_ms, changed == 0.0f, ms);
  if (*same_ms >= FROZEN_MS && *life > least) return true;
  if (*same_ms < FROZEN_MS) *life += 0.01f * (changed - *life);
  return false;
}

// Inertial sensors; in->ms is 1 but for missed calls.
static unsigned judge_inertial(guard_t *g, const guard_in_t *in, quat_t q_wb) {
  unsigned now = 0;
  const float rate = change(in->rate_b_radps, g->rate_last), acc = change(in->acc_b_mps2, g->acc_last);
  if (frozen(&g->rate_same_ms, &g->rate_life, rate, RATE_LIFE, in->ms)) now |= GUARD_GYRO_FROZEN;
  if (frozen(&g->acc_same_ms, &g->acc_life, f_clamp(acc, 0.0f, 1.0f), ACC_LIFE, in->ms))
    now |= GUARD_ACC_FROZEN;
  g->rate_last = in->rate_b_radps;
  g->acc_last = in->acc_b_mps2;
  if (!v3_within(in->acc_b_mps2, ACC_CLIP_MPS2)) {
    now |= GUARD_ACC_CLIPPED;
    g->acc_clip_ms = CLIP_MEMORY_MS;
  } else if (g->acc_clip_ms > 0) {
    g->acc_clip_ms -= in->ms < g->acc_clip_ms ? in->ms : g->acc_clip_ms;
  }
  const float up = quat_up(q_wb).z;
  g->tilt_ms = judge_longer(g->tilt_ms, up < 0.5f, in->ms);
  if (up < 0.5f) now |= GUARD_TILT;
  return now;
}

// What the vertical acceleration says against the change of the estimated climb is the accelerometer's error.
// Only steps of it are found here, as the mean since the step; what is left is the outer loop's.
static void find_bias(guard_t *g, const guard_in_t *in, float error_mps2, float dt) {
  const float rest = error_mps2 - g->bias_mps2 - in->bias_known_mps2;
  g->bias_fast_mps2 += f_clamp(dt / BIAS_FAST_S, 0.0f, 1.0f) * (rest - g->bias_fast_mps2);
  if (fabsf(g->bias_fast_mps2) > BIAS_STEP_MPS2) {
    g->bias_mps2 += g->bias_fast_mps2;
    g->bias_fast_mps2 = 0.0f;
    g->bias_s = BIAS_FAST_S;
  }
  if (g->bias_s < BIAS_SLOW_S) g->bias_mps2 += f_clamp(dt / f_max(g->bias_s, BIAS_FAST_S), 0.0f, 1.0f) * rest;
  if (g->bias_s < JUDGE_SETTLED_S) g->bias_s += dt;
  g->bias_mps2 = f_bound(g->bias_mps2, BIAS_MAX_MPS2);
}

static void begin_window(guard_t *g, const guard_in_t *in) {
  g->window_ms = 0;
  g->window_mps = 0.0f;
  g->window_vel_mps = in->vel_w_mps.z;
}

static unsigned judge_bias(guard_t *g, const guard_in_t *in, quat_t q_wb) {
  const unsigned kept = g->now & GUARD_ACC_BIAS;
  if (g->acc_lost || g->acc_clip_ms > 0) {
    begin_window(g, in);
    return kept;
  }
  const v3_t force = quat_to_world(q_wb, in->acc_b_mps2);
  g->window_mps += 1e-3f * (float)in->ms * (force.z - GRAVITY_MPS2);
  g->window_ms += in->ms;
  if (g->window_ms < BIAS_MS) return kept;
  const float dt = 1e-3f * (float)g->window_ms;
  const float error = (g->window_mps - (in->vel_w_mps.z - g->window_vel_mps)) / dt;
  find_bias(g, in, f_clamp(error, -BIAS_MAX_MPS2, BIAS_MAX_MPS2), dt);
  begin_window(g, in);
  const float all_mps2 = g->bias_mps2 + in->bias_known_mps2;
  return fabsf(all_mps2) > (kept ? 0.5f : 1.0f) * BIAS_MPS2 ? GUARD_ACC_BIAS : 0u;
}

// What jumps by 5 g in velocity is none: the last good one goes on with the accelerometer, until what comes
// no longer jumps. Unless the accelerometer has felt an impact: then it is true.
static unsigned judge_velocity(guard_t *g, guard_in_t *in) {
  const bool calm = v3_within(v3_sub(in->vel_w_mps, g->vel_raw), VEL_STEP_MPS);
  const bool odd = !v3_within(v3_sub(in->vel_w_mps, g->vel_last), VEL_STEP_MPS);
  g->vel_raw = in->vel_w_mps;
  g->vel_calm_ms = judge_longer(g->vel_calm_ms, calm, in->ms);
  g->impact_ms = v3_within(in->acc_b_mps2, IMPACT_MPS2) ? g->impact_ms - in->ms : IMPACT_MS;
  if (g->impact_ms < 0) g->impact_ms = 0;
  g->vel_lost = (odd || g->vel_lost) && g->vel_calm_ms < VEL_CALM_MS && g->impact_ms == 0;
  g->vel_odd_ms = judge_longer(g->vel_odd_ms, g->vel_lost, in->ms);
  if (!g->vel_lost) return 0u;
  const v3_t force = quat_to_world(quat_unit(in->q_wb), in->acc_b_mps2);
  in->vel_w_mps = g->vel_last;
  const float bias_mps2 = g->acc_bias_mps2 + in->bias_known_mps2;
  in->vel_w_mps.z += 1e-3f * (float)in->ms * (force.z - GRAVITY_MPS2 - bias_mps2);
  return GUARD_VELOCITY;
}

void judge_begin(guard_t *g, const guard_in_t *in) {
  g->vel_last = g->vel_raw = in->vel_w_mps;
  begin_window(g, in);
  g->bias_s = JUDGE_SETTLED_S;
  g->rate_last = in->rate_b_radps;
  g->acc_last = in->acc_b_mps2;
}

unsigned judge_motion(guard_t *g, guard_in_t *in) {
  // In this order: each uses what the one before found.
  unsigned now = judge_velocity(g, in);
  const quat_t q_wb = quat_unit(in->q_wb);
  now |= judge_inertial(g, in, q_wb);
  now |= judge_bias(g, in, q_wb);
  g->off_ms = judge_longer(g->off_ms, fabsf(in->height_off_m) > BOUND_HEIGHT_OFF_M, in->ms);
  if (g->off_ms >= OFF_MS) now |= GUARD_HEIGHT_LOST;
  g->vel_last = in->vel_w_mps;
  return now;
}
