// guard.c - what is wrong with the inputs, and what to do about it.
#include "flight/guard.h"

#include "flight/bounds.h"
#include "flight/judge.h"

#define GYRO_CUT_MS    100
#define NAN_CUT_MS     50.0f
#define TILT_CUT_MS    100
#define SETPOINT_MS    250
#define OTHER_M        0.01f // another set point
#define BIAS_SETTLED_S 2.0f
#define QUIET_MS       1000
#define RETREAT_MS     100.0f // until a retreat has its full speed
#define VEL_CUT_MS     2000
#define LANDED_MS      100 // a bump in flight is shorter

#define SENDS_DOWN                                                                                           \
  (GUARD_ACC_FROZEN | GUARD_RANGE_LOST | GUARD_RANGE_FROZEN | GUARD_BLIND | GUARD_SATURATED |                \
   GUARD_TOO_NEAR | GUARD_VELOCITY | GUARD_RATIO | GUARD_HEIGHT_LOST)

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

// Slow mean of the thrust that carries, for when nothing better is known.
static void learn_hover(guard_t *g, const guard_in_t *in) {
  if (g->now != 0 || !in->carries) return;
  const float least = 0.3f * in->weight_N;
  if (!(g->hover_N > least)) g->hover_N = in->weight_N;
  g->hover_N += 0.002f * (float)in->ms * (f_clamp(in->thrust_N, least, in->thrust_max_N) - g->hover_N);
}

// On the floor under a ceiling there is no room to find out how much thrust lifts off.
static bool refused(const guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  return in->wanted && !g->flown && in->thrust_N < 0.3f * in->weight_N && g->range_last_m > 0.0f &&
         g->range_last_m < p->take_off_m;
}

// What has flown is in the air until a floor carries it, however little thrust it gives: it may be falling.
static void find_airborne(guard_t *g, const guard_in_t *in) {
  g->flown = g->flown || in->carries;
  g->floor_ms = judge_longer(g->floor_ms, in->on_floor && !in->carries, in->ms);
  g->airborne = in->carries || (g->airborne && g->floor_ms < LANDED_MS);
}

static void decide(guard_t *g, const guard_in_t *in) {
  const bool ends = ((g->now & GUARD_NOT_A_NUMBER) != 0 && g->bad_ms > NAN_CUT_MS) ||
                    ((g->now & GUARD_GYRO_FROZEN) != 0 && g->rate_same_ms >= GYRO_CUT_MS) ||
                    g->tilt_ms > TILT_CUT_MS || g->vel_odd_ms > VEL_CUT_MS;
  if (ends && g->airborne) g->action = GUARD_HAND_OVER;
  if (g->action == GUARD_HAND_OVER) {
    g->handed_ms = judge_longer(g->handed_ms, true, in->ms);
    return;
  }
  const bool down = (g->now & SENDS_DOWN) != 0 || g->setpoint_ms > SETPOINT_MS;
  g->quiet_ms = judge_longer(g->quiet_ms, !down, in->ms);
  if (g->action == GUARD_RETREAT) {
    g->retreat_ms = judge_longer(g->retreat_ms, true, in->ms);
    // Where it began while a velocity was asked for (NaN), any height is another one.
    const bool other =
        in->setpoint_good && f_finite(in->asked_z_m) && !(fabsf(in->asked_z_m - g->asked_at_m) <= OTHER_M);
    if (g->quiet_ms > QUIET_MS && other) g->action = GUARD_FLY;
    return;
  }
  if (down && g->airborne) {
    g->action = GUARD_RETREAT;
    g->retreat_ms = 0;
    g->hold_w_m = in->pos_w_m;
    g->hold_z_m = in->pos_w_m.z;
    g->asked_at_m = in->asked_z_m;
  } else {
    g->action = in->setpoint_good ? GUARD_FLY : GUARD_HOLD;
  }
}

void guard_step(guard_t *g, const guard_param_t *p, guard_in_t *in) {
  find_airborne(g, in);
  const unsigned kept = g->now;
  const bool good = guard_plausible(in);
  g->bad_ms = f_clamp(g->bad_ms + (good ? -0.25f : 1.0f) * (float)in->ms, 0.0f, 3.0f * NAN_CUT_MS);
  unsigned now = good ? 0u : kept | GUARD_NOT_A_NUMBER;
  if (good) {
    if (!g->started) judge_begin(g, in);
    g->started = true;
    now |= judge_motion(g, in);
    now |= judge_ceiling(g, p, in);
  }
  now &= ~(unsigned)GUARD_SETPOINT;
  g->setpoint_ms = judge_longer(g->setpoint_ms, !in->setpoint_good, in->ms);
  if (!in->setpoint_good) now |= GUARD_SETPOINT;
  if (refused(g, p, in)) {
    now |= GUARD_NO_ROOM;
    g->action = GUARD_HAND_OVER;
    g->handed_ms = JUDGE_MS_MAX;
  }
  g->now = now;
  g->latched |= now;
  g->acc_lost = (now & GUARD_ACC_FROZEN) != 0 || g->acc_clip_ms > 0;
  g->acc_bias_mps2 = in->find_bias || (now & GUARD_ACC_BIAS) ? g->bias_mps2 : 0.0f;
  learn_hover(g, in);
  decide(g, in);
}

float guard_retreat_z_m(const guard_t *g, const guard_param_t *p, float z_m, float ceiling_z_m) {
  // Not all at once: the thrust is not to drop by more than it has to.
  const float lowest_m = z_m - p->sink_mps * f_clamp((float)g->retreat_ms / RETREAT_MS, 0.0f, 1.0f);
  const float safe_m = f_finite(ceiling_z_m) ? ceiling_z_m - p->safe_gap_m : lowest_m;
  const float top_m = safe_m < g->hold_z_m ? safe_m : g->hold_z_m;
  return f_max(top_m, lowest_m);
}

float guard_thrust_N(const guard_t *g, const guard_param_t *p, float weight_N) {
  if ((float)g->handed_ms > 1000.0f * p->cut_after_s) return 0.0f;
  if ((g->now & (GUARD_TILT | GUARD_GYRO_FROZEN)) != 0) return 0.0f;
  return p->share * f_clamp(g->hover_N, 0.5f * weight_N, 1.3f * weight_N);
}

float guard_settled_bias_mps2(const guard_t *g) {
  return g->bias_s < JUDGE_SETTLED_S ? 0.0f : g->bias_mps2;
}

void guard_give_bias(guard_t *g, float given_mps2) {
  g->bias_mps2 -= given_mps2;
  g->acc_bias_mps2 -= given_mps2;
}
