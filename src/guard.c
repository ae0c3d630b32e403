// guard.c - what is wrong with the inputs, and what to do about it.
#include "flight/guard.h"

#include "flight/bounds.h"
#include "flight/judge.h"

// Constants: the name ends in the unit, if there is one. The comment behind gives the reason for the value,
// and the line above each group names the test that pins it.

// test: guard_counts_a_bad_sample_four_times_a_good_one_and_150_at_most
#define BAD_LESS    0.25f // of the time of good samples is subtracted from that of bad ones
#define BAD_MOST_MS (3.0f * (float)GUARD_NOT_A_NUMBER_ENDS_MS)
// test: guard_takes_more_than_a_centimetre_for_another_height
#define OTHER_M 0.01f // more than a stick's noise
// test: guard_flies_on_after_a_retreat_when_all_is_well_and_another_height_is_asked_for
#define QUIET_MS 1000 // ten range samples
// test: guard_goes_down_to_its_safe_gap_at_its_speed
#define RETREAT_MS                                                                                           \
  300.0f // until a retreat has its full speed: three times the law's own time, as a step would show
// test: guard_has_landed_when_a_floor_carries_for_a_tenth_of_a_second
#define LANDED_MS 100 // a bump in flight is shorter
// test: guard_learns_hover_thrust_as_a_mean_over_half_a_second
#define HOVER_PER_MS 0.002f // slower than a climb begins or ends
// test: guard_gives_less_than_hover_thrust_in_a_hand_over_and_then_none
#define HOVER_LEAST 0.5f // of the weight, whatever was learned
#define HOVER_MOST  1.3f // likewise

// The reasons that lead to a retreat at once.
#define GOES_DOWN(bit, reason, lasts, down, ...) ((down) == 0 ? 1u << (bit) : 0u) |
static const unsigned SENDS_DOWN = GUARD_REASONS(GOES_DOWN) 0u;

void guard_init(guard_t *g) {
  *g = (guard_t){.action = GUARD_FLY, .ratio_now = 1.0f, .ratio_usual = 1.0f};
}

void guard_rest(guard_t *g) {
  const unsigned latched = g->latched;
  const float range_m = g->range_last_m;
  guard_init(g);
  g->latched = latched;
  g->range_last_m = range_m;
}

// --- reasons of the call as a whole -----------------------------------------------------------------------

// True if a sensor or the estimate is not finite, or beyond its bound.
static bool not_a_number(guard_t *g, const guard_in_t *in) {
  const bool good = v3_within(in->rate_b_radps, BOUND_RATE_RADPS) &&
                    v3_within(in->acc_b_mps2, BOUND_ACC_MPS2) && v3_within(in->pos_w_m, BOUND_POS_M) &&
                    v3_within(in->vel_w_mps, BOUND_VEL_MPS) && quat_plausible(in->q_wb);
  g->bad_ms = f_clamp(g->bad_ms + (good ? -BAD_LESS : 1.0f) * (float)in->ms, 0.0f, BAD_MOST_MS);
  return !good;
}

static bool setpoint(guard_t *g, const guard_in_t *in) {
  g->setpoint_ms = judge_longer(g->setpoint_ms, !in->setpoint_good, in->ms);
  return !in->setpoint_good;
}

// True on the floor under a near ceiling: there is no room to find out how much thrust lifts off.
static bool no_room(const guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  return in->wanted && !g->flown && in->thrust_N < CARRYING_SHARE * in->weight_N && g->range_last_m > 0.0f &&
         g->range_last_m < p->take_off_m;
}

// --- what is done about them ------------------------------------------------------------------------------

// Updates the slow mean of the thrust that carries, for when nothing better is known.
static void learn_hover(guard_t *g, const guard_in_t *in) {
  const float least = CARRYING_SHARE * in->weight_N;
  FOR_WHOM(g->now == 0 && in->carries, &g->hover_N) {
    const float N = EITHER(g->hover_N > least, g->hover_N, in->weight_N);
    g->hover_N = N + HOVER_PER_MS * (float)in->ms * (f_clamp(in->thrust_N, least, in->thrust_max_N) - N);
  }
}

// A vehicle that has flown is in the air until a floor carries it, even without thrust: it may be falling.
static void find_airborne(guard_t *g, const guard_in_t *in) {
  g->flown = g->flown || in->carries;
  g->floor_ms = judge_longer(g->floor_ms, in->on_floor && !in->carries, in->ms);
  g->airborne = in->carries || (g->airborne && g->floor_ms < LANDED_MS);
}

// True if the pilot asks for another height than at the begin of the retreat, which ends it. If a velocity
// was asked for then (NaN), any height is another one. Below an unseen ceiling only a height without a climb
// counts: a pilot who is told of more room than there is goes on asking for more.
static bool asks_for_another(const guard_t *g, const guard_in_t *in) {
  return in->setpoint_good && f_finite(in->asked_z_m) && !(g->unseen && in->asked_z_m > in->pos_w_m.z) &&
         !(fabsf(in->asked_z_m - g->asked_at_m) <= OTHER_M);
}

static void begin_retreat(guard_t *g, const guard_in_t *in) {
  g->action = GUARD_RETREAT;
  g->retreat_ms = 0;
  g->hold_w_m = in->pos_w_m;
  g->hold_z_m = in->pos_w_m.z;
  g->asked_at_m = in->asked_z_m;
  g->unseen = (g->now & GUARD_RATIO) != 0;
}

static void retreat(guard_t *g, const guard_in_t *in) {
  g->retreat_ms = judge_longer(g->retreat_ms, true, in->ms);
  g->unseen = g->unseen || (g->now & GUARD_RATIO) != 0;
  FOR_WHOM(g->quiet_ms > QUIET_MS && asks_for_another(g, in), &g->action) g->action = GUARD_FLY;
}

static void stay_or_retreat(guard_t *g, const guard_in_t *in) {
  const bool down = (g->now & SENDS_DOWN) != 0 || g->setpoint_ms > GUARD_SETPOINT_DOWN_MS;
  const bool was = g->action == GUARD_RETREAT;
  g->quiet_ms = judge_longer(g->quiet_ms, !down, in->ms);
  FOR_WHOM(was, g) retreat(g, in);
  FOR_WHOM(!was, g) {
    g->action = EITHER(in->setpoint_good, GUARD_FLY, GUARD_HOLD);
    FOR_WHOM(down && g->airborne, g) begin_retreat(g, in);
  }
}

static void decide(guard_t *g, const guard_in_t *in) {
  const bool ends = ((g->now & GUARD_NOT_A_NUMBER) != 0 && g->bad_ms > (float)GUARD_NOT_A_NUMBER_ENDS_MS) ||
                    ((g->now & GUARD_GYRO_FROZEN) != 0 && g->rate_same_ms >= GUARD_GYRO_FROZEN_ENDS_MS) ||
                    g->tilt_ms > GUARD_TILT_ENDS_MS || g->vel_odd_ms > GUARD_VELOCITY_ENDS_MS;
  FOR_WHOM(ends && g->airborne, &g->action) g->action = GUARD_HAND_OVER;
  const bool handed = g->action == GUARD_HAND_OVER;
  FOR_WHOM(handed, &g->handed_ms) g->handed_ms = judge_longer(g->handed_ms, true, in->ms);
  FOR_WHOM(!handed, g) stay_or_retreat(g, in);
}

static unsigned judge(guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  FOR_WHOM(!g->started, g) judge_begin(g, in);
  g->started = true;
  const unsigned of_motion = judge_motion(g, in);
  return of_motion | judge_ceiling(g, p, in);
}

void guard_step(guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  find_airborne(g, in);
  const bool bad = not_a_number(g, in);
  unsigned judged = 0;
  FOR_WHOM(!bad, g) judged = judge(g, p, in);
  unsigned now = EITHER(bad, (g->now & ~(unsigned)GUARD_SETPOINT) | GUARD_NOT_A_NUMBER, judged);
  FOR_WHOM(setpoint(g, in), &now) now |= GUARD_SETPOINT;
  const bool crammed = no_room(g, p, in);
  FOR_WHOM(crammed, &now) now |= GUARD_NO_ROOM;
  FOR_WHOM(crammed, g) {
    g->action = GUARD_HAND_OVER;
    g->handed_ms = JUDGE_MS_MAX;
  }
  g->now = now;
  g->latched |= now;
  g->acc_lost = (now & GUARD_ACC_FROZEN) != 0 || g->acc_clip_ms > 0;
  g->acc_bias_mps2 = EITHER(in->find_bias || (now & GUARD_ACC_BIAS) != 0, g->bias_mps2, 0.0f);
  learn_hover(g, in);
  decide(g, in);
}

float guard_retreat_z_m(const guard_t *g, const guard_param_t *p, float z_m, float ceiling_z_m,
                        float kp_per_s) {
  // The speed builds up, so that the thrust drops no more than needed. From an unseen ceiling it must drop.
  const float speed = g->unseen ? 1.0f : f_clamp((float)g->retreat_ms / RETREAT_MS, 0.0f, 1.0f);
  const float lowest_m = z_m - p->sink_mps / kp_per_s * speed;
  const float under_m = g->unseen ? g->hold_z_m : ceiling_z_m; // the ceiling is not below where RATIO began
  const float safe_m = f_finite(under_m) ? under_m - p->safe_gap_m : lowest_m;
  const float top_m = safe_m < g->hold_z_m ? safe_m : g->hold_z_m;
  return f_max(top_m, lowest_m);
}

float guard_thrust_N(const guard_t *g, const guard_param_t *p, float weight_N) {
  const bool cut =
      (float)g->handed_ms > 1000.0f * p->cut_after_s || (g->now & (GUARD_TILT | GUARD_GYRO_FROZEN)) != 0;
  return EITHER(cut, 0.0f, p->share * f_clamp(g->hover_N, HOVER_LEAST * weight_N, HOVER_MOST * weight_N));
}

float guard_settled_bias_mps2(const guard_t *g) {
  return EITHER(g->bias_s < JUDGE_SETTLED_S, 0.0f, g->bias_mps2);
}

void guard_give_bias(guard_t *g, float given_mps2) {
  g->bias_mps2 -= given_mps2;
  g->acc_bias_mps2 -= given_mps2;
}
