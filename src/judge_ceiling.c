// judge_ceiling.c - what is wrong with the range sensor, the distance and the thrust near a ceiling.
#include "flight/bounds.h"
#include "flight/ceiling.h"
#include "flight/judge.h"

#define RANGE_SAME    3
#define NEAR_M        0.2f
#define MOVED_M       0.02f
#define FULL_SHARE    0.98f
#define ODD_M         0.05f
#define RATIO_NEAR    1.15f
#define RATIO_FAR_M   0.11f
#define RATIO_AFTER_S 1.0f
#define RATIO_SLOW_S  5.0f
#define RATIO_FAST_S  2.0f
#define TOO_NEAR_M    0.015f
#define VERY_NEAR_M   0.055f
#define TOO_NEAR_SUM  14
#define TOO_NEAR_MOST 20

// No sample that is a distance for too long, after a ceiling was near enough to need one.
static bool range_lost(guard_t *g, const guard_in_t *in, bool distance) {
  if (in->zc_known) g->near_seen = in->zc_m < NEAR_M && in->zc_m >= in->range_near_m;
  g->range_ms = judge_longer(g->range_ms, !distance, in->ms);
  return g->near_seen && g->range_ms > GUARD_RANGE_LOST_LASTS_MS;
}

static bool blind(const guard_param_t *p, const guard_in_t *in) {
  return in->zc_known && in->zc_m < in->range_near_m && in->blind_s > p->blind_max_s;
}

// A sample that is no distance, or that the vehicle's climb does not explain.
static bool range_odd(const guard_t *g, const guard_in_t *in, bool distance) {
  if (!in->range_new) return (g->now & GUARD_RANGE_ODD) != 0;
  return !distance ||
         (in->zc_known && in->range_m >= in->range_floor_m && fabsf(in->range_m - in->zc_m) > ODD_M);
}

// The same value again and again while the height moves.
static bool range_frozen(guard_t *g, const guard_in_t *in, bool distance) {
  const bool kept = (g->now & GUARD_RANGE_FROZEN) != 0;
  g->range_new_ms = judge_longer(g->range_new_ms, true, in->ms);
  if (!in->range_new) return kept;
  if (distance && in->range_m == g->range_last_m && in->range_m >= in->range_floor_m) {
    if (g->range_same < RANGE_SAME) g->range_same++;
    g->range_same_ms = judge_longer(g->range_same_ms, true, g->range_new_ms);
    g->range_new_ms = 0;
    const float moved_m = fabsf(in->pos_w_m.z - g->range_z_m);
    return kept || (g->range_same >= RANGE_SAME && g->range_same_ms >= GUARD_RANGE_FROZEN_LASTS_MS &&
                    moved_m > MOVED_M);
  }
  g->range_last_m = in->range_m;
  g->range_z_m = in->pos_w_m.z;
  g->range_same = g->range_same_ms = g->range_new_ms = 0;
  return false;
}

static bool saturated(guard_t *g, const guard_in_t *in) {
  g->full_ms = judge_longer(g->full_ms, in->thrust_N > FULL_SHARE * in->thrust_max_N, in->ms);
  return in->zc_known && in->zc_m < NEAR_M && g->full_ms > GUARD_SATURATED_LASTS_MS;
}

// How much a range sample says that the ceiling is nearer than the set point allows. If the estimated height
// does not know it, then that has drifted, and it counts twice, or four times at the sensor's floor. A step
// of the accelerometer's bias is an excursion that ends by itself.
static int nearer(const guard_t *g, const guard_in_t *in) {
  const float least_m = in->range_m + TOO_NEAR_M;
  const bool at_floor = in->range_m < in->range_floor_m;
  if (!(in->range_m > 0.0f && in->range_m < VERY_NEAR_M && least_m < in->ceiling_z_m - in->setpoint_z_m))
    return 0; // NaN: no ceiling or no height
  if (g->bias_s < JUDGE_SETTLED_S && !at_floor) return 0;
  if (!(least_m < in->ceiling_z_m - in->pos_w_m.z)) return 1;
  return at_floor ? 4 : 2;
}

static bool too_near(guard_t *g, const guard_in_t *in) {
  if (g->nearer < 0 || g->nearer > TOO_NEAR_MOST) g->nearer = 0; // a flipped bit
  if (in->range_new) {
    const int by = nearer(g, in);
    g->nearer = by > 0 ? g->nearer + by : g->nearer > 2 ? g->nearer - 2 : 0;
    if (g->nearer > TOO_NEAR_MOST) g->nearer = TOO_NEAR_MOST;
  }
  return g->nearer >= TOO_NEAR_SUM;
}

// The second witness: near a ceiling the same thrust carries more, whatever the range sensor says. Against
// what it usually carries, which follows slowly upwards (a lighter vehicle) and quickly down.
static bool ratio(guard_t *g, const guard_in_t *in) {
  const float dt = 1e-3f * (float)in->ms;
  const float now = in->force_N / f_max(in->thrust_now_N, CARRYING_SHARE * in->weight_N);
  g->carried_s = in->carries ? f_clamp(g->carried_s + dt, 0.0f, 10.0f) : 0.0f;
  if (g->carried_s < RATIO_AFTER_S) {
    g->ratio_usual = now;
    return false;
  }
  const float over_s = now > g->ratio_usual ? RATIO_SLOW_S : RATIO_FAST_S;
  g->ratio_usual += f_clamp(dt / over_s, 0.0f, 1.0f) * (now - g->ratio_usual);
  const bool high =
      now > RATIO_NEAR * g->ratio_usual && !g->acc_lost && in->zc_known && in->zc_m > RATIO_FAR_M;
  g->ratio_ms = judge_longer(g->ratio_ms, high, in->ms);
  return g->ratio_ms >= GUARD_RATIO_LASTS_MS;
}

unsigned judge_ceiling(guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  const bool distance =
      in->range_new && in->range_m >= CEILING_RANGE_MIN_M && in->range_m <= CEILING_RANGE_MAX_M;
  unsigned now = 0;
  if (range_lost(g, in, distance)) now |= GUARD_RANGE_LOST;
  if (blind(p, in)) now |= GUARD_BLIND;
  if (range_odd(g, in, distance)) now |= GUARD_RANGE_ODD;
  if (range_frozen(g, in, distance)) now |= GUARD_RANGE_FROZEN;
  if (saturated(g, in)) now |= GUARD_SATURATED;
  if (too_near(g, in)) now |= GUARD_TOO_NEAR;
  if (ratio(g, in)) now |= GUARD_RATIO;
  return now;
}
