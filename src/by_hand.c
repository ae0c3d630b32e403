// by_hand.c - the keep-out below a ceiling while the height is flown by hand.
#include "flight/by_hand.h"

#include "flight/bounds.h"
#include "flight/ceiling.h"

// test: by_hand_leaves_the_ceiling_farther_away_than_it_met_it_and_minds_tilt_and_offset
#define UPRIGHT 0.7f // cosine of the tilt: beyond 45 degrees the sensor looks at a wall
// test: by_hand_believes_no_gap_of_an_age_that_is_none
#define GAP_MAX_M (2.0f * CEILING_RANGE_MAX_M) // beyond, the age is invalid, and so the climb over it

void by_hand_init(by_hand_t *s) {
  *s = (by_hand_t){.since_s = BY_HAND_BELIEVE_S};
}

static void look(by_hand_t *s, const by_hand_param_t *p, const by_hand_in_t *in, float climb_mps) {
  const float up = quat_up(in->q_wb).z;
  // Below its floor the sensor measures nothing; the known gap is moved on.
  const float least_m = f_max(p->floor_m, CEILING_RANGE_MIN_M); // a sensor that never started gives 0
  if (!(in->range_m >= least_m && in->range_m <= CEILING_RANGE_MAX_M && up >= UPRIGHT)) return;
  const float gap_m = (in->range_m - p->up_offset_m) * up - climb_mps * in->range_age_s;
  if (!(fabsf(gap_m) <= GAP_MAX_M)) return;
  s->gap_m = gap_m;
  s->since_s = 0.0f;
}

bool by_hand_step(by_hand_t *s, const by_hand_param_t *p, const by_hand_in_t *in, float *climb_mps) {
  const float climb = fabsf(in->climb_mps) <= BOUND_VEL_MPS ? in->climb_mps : 0.0f;
  if (s->since_s < BY_HAND_BELIEVE_S) s->gap_m -= climb * in->period_s;
  s->since_s = f_clamp(s->since_s + in->period_s, 0.0f, BY_HAND_BELIEVE_S);
  if (in->range_new) look(s, p, in, climb);
  const float room_m = s->gap_m - p->gap_min_m - BY_HAND_ROOM_M, rise = f_max(climb, 0.0f);
  const float needs_m = BY_HAND_NEAR_M + rise * BY_HAND_REACT_S + rise * rise * (0.5f / BY_HAND_BRAKE_MPS2);
  const bool known = s->since_s < BY_HAND_BELIEVE_S;
  s->held = known && in->thrust_N > 0.0f && room_m < needs_m + (s->held ? BY_HAND_LEAVE_M : 0.0f);
  const float asked_mps = BY_HAND_STICK_MPS * (in->thrust_N / p->weight_N - 1.0f),
              most_mps = p->kp_per_s * room_m;
  *climb_mps = f_clamp(asked_mps < most_mps ? asked_mps : most_mps, -BY_HAND_STICK_MPS, BY_HAND_STICK_MPS);
  return s->held;
}
