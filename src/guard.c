// guard.c - what is wrong with the inputs, and what to do about it.
#include "flight/guard.h"

#include "flight/bounds.h"

#define ACC_CLIP_MPS2  196.2f // 20 g
#define CLIP_MEMORY_MS 200    // the 8 Hz filter has forgotten
#define VEL_STEP_MPS   0.5f   // in one period of the estimator: 5 g
#define FROZEN_MS      25
#define GYRO_CUT_MS    100
#define NAN_CUT_MS     50.0f
#define TILT_CUT_MS    100
#define RATE_LIFE      5e-4f // rad/s a millisecond; a tenth of a real gyro's noise
#define ACC_LIFE       2e-3f // m/s2 a millisecond
#define RANGE_MS       250
#define RANGE_SAME     3
#define NEAR_M         0.2f
#define MOVED_M        0.02f
#define ODD_M          0.05f
#define FULL_MS        200
#define SETPOINT_MS    250
#define OTHER_M        0.01f // another set point
#define BIAS_MPS2      0.5f
#define QUIET_MS       1000
#define MS_MAX         1000000
#define TOO_NEAR_M     0.015f
#define VERY_NEAR_M    0.055f
#define TOO_NEAR_COUNT 5 // samples

#define SENDS_DOWN                                                                                           \
  (GUARD_ACC_FROZEN | GUARD_RANGE_LOST | GUARD_RANGE_FROZEN | GUARD_BLIND | GUARD_SATURATED | GUARD_TOO_NEAR)

void guard_init(guard_t *g) {
  *g = (guard_t){.action = GUARD_FLY};
}

void guard_rest(guard_t *g) {
  const unsigned latched = g->latched;
  const float range_m = g->range_last_m;
  guard_init(g);
  g->latched = latched;
  g->range_last_m = range_m;
}

bool guard_plausible(const guard_in_t *in) {
  return v3_within(in->rate_b_radps, BOUND_RATE_RADPS) && v3_within(in->acc_b_mps2, BOUND_ACC_MPS2) &&
         v3_within(in->pos_w_m, BOUND_POS_M) && v3_within(in->vel_w_mps, BOUND_VEL_MPS) &&
         quat_plausible(in->q_wb);
}

static int longer(int total_ms, bool lasts, int ms) {
  if (!lasts) return 0;
  return total_ms < MS_MAX ? total_ms + ms : total_ms;
}

static float change(v3_t a, v3_t b) {
  return fabsf(a.x - b.x) + fabsf(a.y - b.y) + fabsf(a.z - b.z);
}

// A sensor that was alive and now gives the same bits is frozen. One that never was (a perfect one) is not.
static bool frozen(int *same_ms, float *life, float changed, float least, int ms) {
  *same_ms = longer(*same_ms, changed == 0.0f, ms);
  if (*same_ms >= FROZEN_MS && *life > least) return true;
  if (*same_ms < FROZEN_MS) *life += 0.01f * (changed - *life);
  return false;
}

// Inertial sensors; in->ms is 1 but for missed calls.
static unsigned judge_inertial(guard_t *g, const guard_in_t *in) {
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
  const float up = quat_up(quat_unit(in->q_wb)).z;
  g->tilt_ms = longer(g->tilt_ms, up < 0.5f, in->ms);
  if (up < 0.5f) now |= GUARD_TILT;
  return now;
}

// The mean of (vertical acceleration - change of the estimated climb) is the accelerometer's error.
static unsigned judge_bias(guard_t *g, const guard_in_t *in) {
  if (g->acc_lost || g->acc_clip_ms > 0) return g->now & GUARD_ACC_BIAS;
  const v3_t force = quat_to_world(quat_unit(in->q_wb), in->acc_b_mps2);
  const float climbed = in->vel_w_mps.z - g->vel_last.z;
  const float dt = 1e-3f * (float)in->ms, error = force.z - GRAVITY_MPS2 - climbed / dt;
  g->bias_fast_mps2 += f_clamp(dt / 0.1f, 0.0f, 1.0f) * (error - g->bias_fast_mps2);
  // Once seen, the mean since then: quick at first, and steady later.
  g->bias_s = g->now & GUARD_ACC_BIAS ? f_clamp(g->bias_s + dt, 0.1f, 0.7f) : 0.1f;
  g->bias_slow_mps2 += f_clamp(dt / g->bias_s, 0.0f, 1.0f) * (error - g->bias_slow_mps2);
  if (g->now & GUARD_ACC_BIAS) return fabsf(g->bias_slow_mps2) > 0.5f * BIAS_MPS2 ? GUARD_ACC_BIAS : 0u;
  if (!(fabsf(g->bias_fast_mps2) > BIAS_MPS2)) return 0u;
  g->bias_slow_mps2 = g->bias_fast_mps2;
  return GUARD_ACC_BIAS;
}

static unsigned judge_range(guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  unsigned now = g->now & GUARD_RANGE_FROZEN;
  const bool valid = in->range_m >= GUARD_RANGE_MIN_M && in->range_m <= 4.0f;
  if (in->zc_known) g->near_seen = in->zc_m < NEAR_M && in->zc_m >= in->range_near_m;
  g->range_ms = longer(g->range_ms, !(in->range_new && valid), in->ms);
  if (g->near_seen && g->range_ms > RANGE_MS) now |= GUARD_RANGE_LOST;
  if (in->zc_known && in->zc_m < in->range_near_m && in->blind_s > p->blind_max_s) now |= GUARD_BLIND;
  if (!in->range_new) return now | (g->now & GUARD_RANGE_ODD);
  if (!valid || (in->zc_known && in->range_m >= in->range_floor_m && fabsf(in->range_m - in->zc_m) > ODD_M))
    now |= GUARD_RANGE_ODD;
  if (valid && in->range_m == g->range_last_m && in->range_m >= in->range_floor_m) {
    g->range_same++;
    const float moved_m = fabsf(in->pos_w_m.z - g->range_z_m);
    return g->range_same >= RANGE_SAME && moved_m > MOVED_M ? now | GUARD_RANGE_FROZEN : now;
  }
  g->range_last_m = in->range_m;
  g->range_z_m = in->pos_w_m.z;
  g->range_same = 0;
  return now & ~(unsigned)GUARD_RANGE_FROZEN;
}

static unsigned judge_flight(guard_t *g, const guard_in_t *in) {
  unsigned now = 0;
  const bool near = in->zc_known && in->zc_m < NEAR_M;
  g->full_ms = longer(g->full_ms, in->thrust_N > 0.98f * in->thrust_max_N, in->ms);
  if (near && g->full_ms > FULL_MS) now |= GUARD_SATURATED;
  if (in->range_new) {
    const float gap_wanted_m = in->ceiling_z_m - in->setpoint_z_m; // NaN: neither is known
    const bool nearer =
        in->range_m > 0.0f && in->range_m < gap_wanted_m - TOO_NEAR_M && in->range_m < VERY_NEAR_M;
    g->nearer = nearer ? g->nearer + 1 : 0;
  }
  if (g->nearer >= TOO_NEAR_COUNT) now |= GUARD_TOO_NEAR;
  return now;
}

// Slow mean of the thrust that carries, for when nothing better is known.
static void learn_hover(guard_t *g, const guard_in_t *in) {
  if (g->now != 0 || !in->airborne) return;
  const float least = 0.3f * in->weight_N;
  if (!(g->hover_N > least)) g->hover_N = in->weight_N;
  g->hover_N += 0.002f * (float)in->ms * (f_clamp(in->thrust_N, least, in->thrust_max_N) - g->hover_N);
}

// On the floor under a ceiling there is no room to find out how much thrust lifts off.
static bool refused(const guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  return in->wanted && !g->flown && in->thrust_N < 0.3f * in->weight_N && g->range_last_m > 0.0f &&
         g->range_last_m < p->take_off_m;
}

static void decide(guard_t *g, const guard_in_t *in) {
  const bool ends = ((g->now & GUARD_NOT_A_NUMBER) != 0 && g->bad_ms > NAN_CUT_MS) ||
                    ((g->now & GUARD_GYRO_FROZEN) != 0 && g->rate_same_ms >= GYRO_CUT_MS) ||
                    g->tilt_ms > TILT_CUT_MS;
  if (ends && in->airborne) g->action = GUARD_HAND_OVER;
  if (g->action == GUARD_HAND_OVER) {
    g->handed_ms = longer(g->handed_ms, true, in->ms);
    return;
  }
  const bool down = (g->now & SENDS_DOWN) != 0 || g->setpoint_ms > SETPOINT_MS;
  g->quiet_ms = longer(g->quiet_ms, !down, in->ms);
  if (g->action == GUARD_RETREAT) {
    const bool other = in->setpoint_good && fabsf(in->asked_z_m - g->asked_at_m) > OTHER_M;
    if (g->quiet_ms > QUIET_MS && other) g->action = GUARD_FLY;
    return;
  }
  if (down && in->airborne) {
    g->action = GUARD_RETREAT;
    g->hold_w_m = in->pos_w_m;
    g->hold_z_m = in->pos_w_m.z;
    g->asked_at_m = in->asked_z_m;
  } else {
    g->action = in->setpoint_good ? GUARD_FLY : GUARD_HOLD;
  }
}

void guard_step(guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  g->flown = g->flown || in->airborne;
  const unsigned kept = g->now;
  bool good = guard_plausible(in);
  // What jumps by 5 g in velocity is no velocity; after a while it is one that is to be believed.
  if (good && g->started && g->bad_ms <= 2.0f * NAN_CUT_MS)
    good = v3_within(v3_sub(in->vel_w_mps, g->vel_last), VEL_STEP_MPS);
  g->bad_ms = f_clamp(g->bad_ms + (good ? -0.25f : 1.0f) * (float)in->ms, 0.0f, 3.0f * NAN_CUT_MS);
  unsigned now = good ? 0u : kept | GUARD_NOT_A_NUMBER;
  if (good) {
    if (!g->started) {
      g->vel_last = in->vel_w_mps;
      g->rate_last = in->rate_b_radps;
      g->acc_last = in->acc_b_mps2;
    }
    g->started = true;
    now |= judge_inertial(g, in) | judge_bias(g, in) | judge_range(g, p, in) | judge_flight(g, in);
    g->vel_last = in->vel_w_mps;
  }
  now &= ~(unsigned)GUARD_SETPOINT;
  g->setpoint_ms = longer(g->setpoint_ms, !in->setpoint_good, in->ms);
  if (!in->setpoint_good) now |= GUARD_SETPOINT;
  if (refused(g, p, in)) {
    now |= GUARD_NO_ROOM;
    g->action = GUARD_HAND_OVER;
    g->handed_ms = MS_MAX;
  }
  g->now = now;
  g->latched |= now;
  g->acc_lost = (now & GUARD_ACC_FROZEN) != 0 || g->acc_clip_ms > 0;
  if (now & GUARD_ACC_BIAS)
    g->acc_bias_mps2 = g->bias_slow_mps2;
  else
    g->acc_bias_mps2 = 0.0f;
  learn_hover(g, in);
  decide(g, in);
}

float guard_retreat_z_m(const guard_t *g, const guard_param_t *p, float z_m, float ceiling_z_m) {
  const float lowest_m = z_m - p->sink_mps;
  const float safe_m = f_finite(ceiling_z_m) ? ceiling_z_m - p->safe_gap_m : lowest_m;
  const float top_m = safe_m < g->hold_z_m ? safe_m : g->hold_z_m;
  return f_max(top_m, lowest_m);
}

float guard_thrust_N(const guard_t *g, const guard_param_t *p, float weight_N) {
  if ((float)g->handed_ms > 1000.0f * p->cut_after_s) return 0.0f;
  if ((g->now & (GUARD_TILT | GUARD_GYRO_FROZEN)) != 0) return 0.0f;
  return p->share * f_clamp(g->hover_N, 0.5f * weight_N, 1.3f * weight_N);
}
