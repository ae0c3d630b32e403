// judge_motion.c - what is wrong with the inertial sensors and the estimated velocity.
#include "flight/bounds.h"
#include "flight/judge.h"

// Constants: the name ends in the unit, if there is one. The comment behind gives the reason for the value,
// and the line above each group names the test that pins it.

// test: guard_raises_each_reason_at_its_threshold
#define VEL_STEP_MPS  0.5f   // in one period of the estimator: 5 g
#define ACC_CLIP_MPS2 196.2f // 20 g; the sensor ends at 24
// test: guard_believes_a_velocity_that_jumps_within_300_ms_of_an_impact
#define IMPACT_MPS2 25.0f // along an axis; the rotors give 15
#define IMPACT_MS   300   // for so long the estimate may jump
// test: guard_takes_a_sensor_for_frozen_that_was_alive
#define RATE_LIFE  5e-4f // rad/s per millisecond; a tenth of a real gyro's noise
#define ACC_LIFE   2e-3f // m/s2 per millisecond
#define LIFE_SHARE 0.01f // of a call in the mean: 0.1 s
// test: guard_measures_a_sensors_life_by_its_change_in_a_millisecond
#define KNOCK_MPS2 1.0f // a larger change in one call counts as this
// test: guard_remembers_a_clipped_acceleration_for_200_ms
#define CLIP_MEMORY_MS 200 // by then even the thesis's 8 Hz filter has forgotten it
// test: guard_allows_a_lean_of_60_degrees_to_the_bit
#define TILT_UP 0.5f // cosine of the tilt
// test: guard_holds_a_settled_bias_against_its_bounds
#define BIAS_MPS2 0.5f // a larger one is a fault
#define BIAS_KEPT 0.5f // of BIAS_MPS2: a fault until the bias is below this
// test: guard_finds_a_step_of_the_accelerometers_bias_as_the_mean_since_then
#define BIAS_MAX_MPS2  3.0f  // a third of g: more is no bias
#define BIAS_STEP_MPS2 0.3f  // nearly seven times the noise of the mean over BIAS_FAST_S
#define BIAS_FAST_S    0.15f // a fast mean; over 0.1 s its noise alone made a step once in 40 min
#define BIAS_SLOW_S    1.0f  // what remains then is the outer loop's
#define BIAS_MS        10    // the estimator's period
// test: guard_finds_a_step_of_the_bias_after_a_bit_of_what_it_remembers_flipped
#define REST_MAX_MPS2 (4.0f * BIAS_MAX_MPS2) // more than an error and two biases, each within the largest

static float change(v3_t a, v3_t b) {
  return fabsf(a.x - b.x) + fabsf(a.y - b.y) + fabsf(a.z - b.z);
}

// True if the estimated velocity is lost: it jumped by 5 g. The last good one is then integrated on with the
// accelerometer, until the estimate no longer jumps. After an impact that the accelerometer has felt, a jump
// is true.
static bool velocity(guard_t *g, const guard_in_t *in, quat_t q_wb) {
  const bool calm = v3_within(v3_sub(in->vel_w_mps, g->vel_raw), VEL_STEP_MPS);
  // Unless lost, the believed velocity is the last one. A flipped bit in one of them alone is no loss.
  const bool odd = !v3_within(v3_sub(in->vel_w_mps, g->vel_w_mps), VEL_STEP_MPS);
  g->vel_raw = in->vel_w_mps;
  g->vel_calm_ms = judge_longer(g->vel_calm_ms, calm, in->ms);
  g->impact_ms = EITHER(v3_within(in->acc_b_mps2, IMPACT_MPS2), g->impact_ms - in->ms, IMPACT_MS);
  g->impact_ms = EITHER(g->impact_ms < 0, 0, g->impact_ms);
  g->vel_lost = (odd || g->vel_lost) && g->vel_calm_ms < GUARD_VELOCITY_GONE_MS && g->impact_ms == 0;
  g->vel_odd_ms = judge_longer(g->vel_odd_ms, g->vel_lost, in->ms);
  FOR_WHOM(!g->vel_lost, &g->vel_w_mps) g->vel_w_mps = in->vel_w_mps;
  FOR_WHOM(g->vel_lost, &g->vel_w_mps) {
    const v3_t force = quat_to_world(q_wb, in->acc_b_mps2);
    const float bias_mps2 = g->acc_bias_mps2 + in->bias_known_mps2;
    g->vel_w_mps.z += 1e-3f * (float)in->ms * (force.z - GRAVITY_MPS2 - bias_mps2);
  }
  return g->vel_lost;
}

// True if a sensor that was alive now gives the same bits. One that was never alive (a perfect one) is not
// frozen.
static bool frozen(int *same_ms, float *life, float changed, float least, int lasts_ms, int ms) {
  *same_ms = judge_longer(*same_ms, changed == 0.0f, ms);
  const bool lasts = *same_ms >= lasts_ms;
  *life = EITHER(lasts, *life, *life + LIFE_SHARE * (changed - *life));
  return lasts && *life > least;
}

static bool gyro_frozen(guard_t *g, const guard_in_t *in) {
  const float changed = change(in->rate_b_radps, g->rate_last);
  g->rate_last = in->rate_b_radps;
  return frozen(&g->rate_same_ms, &g->rate_life, changed, RATE_LIFE, GUARD_GYRO_FROZEN_LASTS_MS, in->ms);
}

static bool acc_frozen(guard_t *g, const guard_in_t *in) {
  const float changed = f_clamp(change(in->acc_b_mps2, g->acc_last), 0.0f, KNOCK_MPS2);
  g->acc_last = in->acc_b_mps2;
  return frozen(&g->acc_same_ms, &g->acc_life, changed, ACC_LIFE, GUARD_ACC_FROZEN_LASTS_MS, in->ms);
}

static bool acc_clipped(guard_t *g, const guard_in_t *in) {
  const bool clipped = !v3_within(in->acc_b_mps2, ACC_CLIP_MPS2);
  FOR_WHOM(clipped, &g->acc_clip_ms) g->acc_clip_ms = CLIP_MEMORY_MS;
  FOR_WHOM(!clipped && g->acc_clip_ms > 0, &g->acc_clip_ms) {
    g->acc_clip_ms -= EITHER(in->ms < g->acc_clip_ms, in->ms, g->acc_clip_ms);
  }
  return clipped;
}

static bool tilt(guard_t *g, const guard_in_t *in, quat_t q_wb) {
  const bool tilted = quat_up(q_wb).z < TILT_UP;
  g->tilt_ms = judge_longer(g->tilt_ms, tilted, in->ms);
  return tilted;
}

static void follow_bias(guard_t *g, float rest, float dt) {
  FOR_WHOM(!(fabsf(g->bias_fast_mps2) <= REST_MAX_MPS2), g) g->bias_fast_mps2 = 0.0f;
  g->bias_fast_mps2 += f_clamp(dt / BIAS_FAST_S, 0.0f, 1.0f) * (rest - g->bias_fast_mps2);
  FOR_WHOM(fabsf(g->bias_fast_mps2) > BIAS_STEP_MPS2, g) {
    g->bias_mps2 += g->bias_fast_mps2;
    g->bias_fast_mps2 = 0.0f;
    g->bias_s = BIAS_FAST_S;
  }
  FOR_WHOM(g->bias_s < BIAS_SLOW_S, g) {
    g->bias_mps2 += f_clamp(dt / f_max(g->bias_s, BIAS_FAST_S), 0.0f, 1.0f) * rest;
  }
  FOR_WHOM(g->bias_s < JUDGE_SETTLED_S, g) g->bias_s += dt;
}

// Finds steps of the accelerometer's error, which is the vertical acceleration minus the change of the
// estimated climb rate, as the mean since the step. The rest is left to the outer loop.
static void find_bias(guard_t *g, const guard_in_t *in, float error_mps2, float dt) {
  const float rest = error_mps2 - g->bias_mps2 - in->bias_known_mps2;
  FOR_WHOM(fabsf(rest) <= REST_MAX_MPS2, g) follow_bias(g, rest, dt); // else a bit in one of them flipped
  g->bias_mps2 = f_bound(g->bias_mps2, BIAS_MAX_MPS2);
}

static void begin_window(guard_t *g) {
  g->window_ms = 0;
  g->window_mps = 0.0f;
  g->window_vel_mps = g->vel_w_mps.z;
}

static bool acc_bias(guard_t *g, const guard_in_t *in, quat_t q_wb) {
  const bool kept = (g->now & GUARD_ACC_BIAS) != 0, lost = g->acc_lost || g->acc_clip_ms > 0;
  // Below 0 its sign bit flipped, and the window would not end for days.
  FOR_WHOM(lost || g->window_ms < 0, g) begin_window(g);
  FOR_WHOM(!lost, g) {
    const v3_t force = quat_to_world(q_wb, in->acc_b_mps2);
    g->window_mps += 1e-3f * (float)in->ms * (force.z - GRAVITY_MPS2);
    g->window_ms += in->ms;
  }
  const bool full = !lost && g->window_ms >= BIAS_MS;
  if (!ANY(full)) return kept;
  FOR_WHOM(full, g) {
    const float dt = 1e-3f * (float)g->window_ms;
    const float error = (g->window_mps - (g->vel_w_mps.z - g->window_vel_mps)) / dt;
    find_bias(g, in, f_clamp(error, -BIAS_MAX_MPS2, BIAS_MAX_MPS2), dt);
    begin_window(g);
  }
  const float bias_mps2 = fabsf(g->bias_mps2 + in->bias_known_mps2);
  return EITHER(full, bias_mps2 > EITHER(kept, BIAS_KEPT, 1.0f) * BIAS_MPS2, kept);
}

static bool height_lost(guard_t *g, const guard_in_t *in) {
  g->off_ms = judge_longer(g->off_ms, fabsf(in->height_off_m) > BOUND_HEIGHT_OFF_M, in->ms);
  return g->off_ms >= GUARD_HEIGHT_LOST_LASTS_MS;
}

void judge_begin(guard_t *g, const guard_in_t *in) {
  g->vel_w_mps = g->vel_raw = in->vel_w_mps;
  begin_window(g);
  g->bias_s = JUDGE_SETTLED_S;
  g->rate_last = in->rate_b_radps;
  g->acc_last = in->acc_b_mps2;
}

unsigned judge_motion(guard_t *g, const guard_in_t *in) {
  const quat_t q_wb = quat_unit(in->q_wb);
  unsigned now = 0;
  FOR_WHOM(velocity(g, in, q_wb), &now) now |= GUARD_VELOCITY;
  FOR_WHOM(gyro_frozen(g, in), &now) now |= GUARD_GYRO_FROZEN;
  FOR_WHOM(acc_frozen(g, in), &now) now |= GUARD_ACC_FROZEN;
  FOR_WHOM(acc_clipped(g, in), &now) now |= GUARD_ACC_CLIPPED;
  FOR_WHOM(tilt(g, in, q_wb), &now) now |= GUARD_TILT;
  FOR_WHOM(acc_bias(g, in, q_wb), &now) now |= GUARD_ACC_BIAS;
  FOR_WHOM(height_lost(g, in), &now) now |= GUARD_HEIGHT_LOST;
  return now;
}
