// judge_ceiling.c - what is wrong with the range sensor, the distance and the thrust near a ceiling.
#include "flight/bounds.h"
#include "flight/ceiling.h"
#include "flight/judge.h"

// Constants: the name ends in the unit, if there is one. The comment behind gives the reason for the value,
// and the line above each group names the test that pins it.

// test: guard_raises_each_reason_at_its_threshold
#define NEAR_M      0.2f  // full thrust closes it in 0.22 s
#define ODD_M       0.05f // up to here the estimate itself believes a sample (CEILING_JUMP_M)
#define MOVED_M     0.02f // more than the noise of range and height
#define FULL_SHARE  0.98f // of the largest thrust: the mixer gives some of it up
#define RATIO_NEAR  1.15f // dropping a tenth of the weight makes 1.11
#define RATIO_FAR_M 0.11f // the curve ends at 0.1 m
// test: guard_takes_a_range_for_frozen_that_is_the_same_for_long_enough_and_often_enough
#define RANGE_SAME 3 // samples in whole millimetres: two are alike by chance
// test: guard_takes_the_mean_ratio_of_a_tenth_of_a_second
#define RATIO_MEAN_S 0.1f // with a motor lag 30 % wrong the end of a climb shows 1.15 for half of this
// test: guard_knows_what_is_usual_after_a_second_in_the_air
#define RATIO_AFTER_S 1.0f // until then the vehicle lifts off
// test: guard_lets_the_usual_ratio_follow_by_the_time_that_has_passed
#define RATIO_SLOW_S 5.0f // upwards: a ceiling that comes near must not become usual
#define RATIO_FAST_S 2.0f // downwards
// test: guard_takes_a_ratio_that_grows_with_the_height_risen_for_a_ceiling
#define GROWTH_PER_M 80.0f  // as the curve of this rotor does: 1.8 over its radius (ceil.cb)
#define GROWTH_LEAST 0.075f // of the ratio beyond the usual one: the curve gives it 22 mm below a ceiling
#define GROWTH_FAR_M 0.06f  // the curve gives a twentieth of that here; nearer, it explains a growth
// test: guard_takes_no_jolt_for_a_ceiling
#define GROWTH_MEAN_S 0.4f // a gust lasts for 0.3 s; in a climb at 0.1 m/s the curve grows 24-fold
#define GROWTH_SHARE  0.8f // of the ratio's variance; a dropped load or a gust explains less by chance
#define GROWTH_SEEN   2.5f // sum of squares of f about its mean: a rise of 1 cm or more, below 0.16 m/s
// test: guard_forgets_a_growth_where_a_bit_of_it_flipped
#define GROWTH_MOST  1e3f // of all sums together: 40 samples of a ratio that is wrong by 3.5
#define GROWTH_ROUND 1.0f // tolerance of fy^2: rounding makes a hundredth of it, the least ceiling 56
// test: guard_has_no_usual_ratio_where_a_bit_of_it_flipped
#define RATIO_LEAST 0.3f // no vehicle with a valid thrust map has less
#define RATIO_MOST  5.0f // as params.h has it for ceil.ratioMax
// test: guard_has_no_usual_ratio_in_the_first_second_in_the_air
#define CARRIED_MOST_S 10.0f // the count stops here: long enough to know
// test: guard_sums_up_what_range_samples_say_of_a_ceiling_that_is_too_near
#define TOO_NEAR_M     0.015f // more than the errors of range and flight
#define VERY_NEAR_M    0.055f // where the estimate follows the climb alone (ceil.near), and a little more
#define TOO_NEAR_SUM   14 // 1.4 s of samples that the height explains, 0.7 s of others, 0.4 s at the floor
#define TOO_NEAR_MOST  20 // 0.4 s after the last such sample the reason ends
#define TOO_NEAR_LESS  2  // subtracted for any other sample
#define TOO_NEAR_OTHER 2  // added for one that the height does not explain
#define TOO_NEAR_FLOOR 4  // added for one that it does not explain at the sensor's floor

// True if no valid sample came for too long, after a ceiling was near enough to need one.
static bool range_lost(guard_t *g, const guard_in_t *in, bool distance) {
  g->near_seen = EITHER(in->zc_known, in->zc_m < NEAR_M && in->zc_m >= in->range_near_m, g->near_seen);
  g->range_ms = judge_longer(g->range_ms, !distance, in->ms);
  return g->near_seen && g->range_ms > GUARD_RANGE_LOST_LASTS_MS;
}

static bool blind(const guard_param_t *p, const guard_in_t *in) {
  return in->zc_known && in->zc_m < in->range_near_m && in->blind_s > p->blind_max_s;
}

// True for a sample that is not a distance, or that the vehicle's climb does not explain.
static bool range_odd(const guard_t *g, const guard_in_t *in, bool distance) {
  const bool kept = (g->now & GUARD_RANGE_ODD) != 0;
  const bool odd = !distance || (in->zc_known && in->range_m >= in->range_floor_m &&
                                 fabsf(in->range_m - in->zc_m) > ODD_M);
  return EITHER(in->range_new, odd, kept);
}

// True if the same value comes again and again while the height moves.
static bool range_frozen(guard_t *g, const guard_in_t *in, bool distance) {
  const bool kept = (g->now & GUARD_RANGE_FROZEN) != 0;
  g->range_new_ms = judge_longer(g->range_new_ms, true, in->ms);
  if (!ANY(in->range_new)) return kept;
  const bool is_new = in->range_new;
  const bool same = distance && in->range_m == g->range_last_m && in->range_m >= in->range_floor_m;
  const int times = EITHER(g->range_same < RANGE_SAME, g->range_same + 1, g->range_same);
  const int same_ms = judge_longer(g->range_same_ms, true, g->range_new_ms);
  const float moved_m = fabsf(in->pos_w_m.z - g->range_z_m);
  const bool frozen = times >= RANGE_SAME && same_ms >= GUARD_RANGE_FROZEN_LASTS_MS && moved_m > MOVED_M;
  g->range_same = EITHER(is_new, EITHER(same, times, 0), g->range_same);
  g->range_same_ms = EITHER(is_new, EITHER(same, same_ms, 0), g->range_same_ms);
  g->range_new_ms = EITHER(is_new, 0, g->range_new_ms);
  g->range_last_m = EITHER(is_new && !same, in->range_m, g->range_last_m);
  g->range_z_m = EITHER(is_new && !same, in->pos_w_m.z, g->range_z_m);
  return EITHER(is_new, same && (kept || frozen), kept);
}

static bool saturated(guard_t *g, const guard_in_t *in) {
  g->full_ms = judge_longer(g->full_ms, in->thrust_N > FULL_SHARE * in->thrust_max_N, in->ms);
  return in->zc_known && in->zc_m < NEAR_M && g->full_ms > GUARD_SATURATED_LASTS_MS;
}

// Returns how much a range sample says that the ceiling is nearer than the set point allows. If the estimated
// height does not explain it, the height has drifted, and the sample counts for more. After a step of the
// accelerometer's bias it counts 0, because that excursion ends by itself.
static int nearer(const guard_t *g, const guard_in_t *in) {
  const float least_m = in->range_m + TOO_NEAR_M;
  const bool at_floor = in->range_m < in->range_floor_m;
  const bool says = in->range_m > 0.0f && in->range_m < VERY_NEAR_M &&
                    least_m < in->ceiling_z_m - in->setpoint_z_m; // NaN: no ceiling or no height
  const bool explained = !(least_m < in->ceiling_z_m - in->pos_w_m.z);
  const bool jumped = g->bias_s < JUDGE_SETTLED_S && !at_floor;
  return EITHER(!says || jumped, 0, EITHER(explained, 1, EITHER(at_floor, TOO_NEAR_FLOOR, TOO_NEAR_OTHER)));
}

static bool too_near(guard_t *g, const guard_in_t *in) {
  if (g->nearer < 0 || g->nearer > TOO_NEAR_MOST) g->nearer = 0; // a flipped bit
  if (ANY(in->range_new)) {
    const int by = nearer(g, in);
    const int now =
        EITHER(by > 0, g->nearer + by, EITHER(g->nearer > TOO_NEAR_LESS, g->nearer - TOO_NEAR_LESS, 0));
    g->nearer = EITHER(in->range_new, EITHER(now > TOO_NEAR_MOST, TOO_NEAR_MOST, now), g->nearer);
  }
  return g->nearer >= TOO_NEAR_SUM;
}

static bool can_be(float ratio) {
  return fabsf(ratio - 0.5f * (RATIO_MOST + RATIO_LEAST)) <= 0.5f * (RATIO_MOST - RATIO_LEAST);
}

// Adds a sample to the fit. When the vehicle rises by dz, all older samples are farther below it: their share
// of the ceiling's excess shrinks by exp(-dz GROWTH_PER_M). A sink is not followed, as the shares would grow
// without bound.
static void fit_growth(guard_growth_t *s, float more, float climb_m, float keep) {
  const float up = f_clamp(GROWTH_PER_M * climb_m, 0.0f, 0.5f);
  const float share = keep * (1.0f - up + 0.5f * up * up); // exp, as exactly as needed
  s->ff = share * (1.0f - up + 0.5f * up * up) * s->ff + 1.0f;
  s->fy = share * s->fy + more;
  s->f = share * s->f + 1.0f;
  s->n = keep * s->n + 1.0f;
  s->y = keep * s->y + more;
  s->yy = keep * s->yy + more * more;
}

// True if the ratio grows as below a ceiling. Least-squares fit over the samples: ratio beyond the usual one
// = const + a f, where f is the share of each sample as above, 1 for this one. So a is a ceiling's excess
// here and now, inferred from its growth. It is a ceiling's if a, and the fit at this sample, are as large as
// near a ceiling, and if the fit explains the variance. (ff, fy and yy are n times the sums of squares about
// the means.) A fit that explains more than there is comes from a flipped bit, and all is forgotten.
static bool grows(guard_growth_t *s) {
  const float ff = s->n * s->ff - s->f * s->f, fy = s->n * s->fy - s->f * s->y,
              yy = s->n * s->yy - s->y * s->y;
  const float here = s->y * ff + fy * (s->n - s->f); // times n ff
  const bool possible =
      fabsf(s->n + s->f + s->ff + s->y + s->fy + s->yy) <= GROWTH_MOST && fy * fy <= ff * yy + GROWTH_ROUND;
  if (!possible) *s = (guard_growth_t){.n = 0.0f};
  return possible && ff >= GROWTH_SEEN * s->n && fy >= GROWTH_LEAST * ff &&
         here >= GROWTH_LEAST * s->n * ff && fy * fy >= GROWTH_SHARE * ff * yy;
}

// The second witness: near a ceiling the same thrust carries more, whatever the range sensor says. The ratio
// is compared with the usual one, which follows slowly upwards (a lighter vehicle) and quickly down. The
// result of a sample stands until the next if two memories of it agree; otherwise a bit of one has flipped.
static bool ratio(guard_t *g, const guard_in_t *in) {
  g->force_ms = judge_longer(g->force_ms, true, in->ms);
  if (!in->force_new) return (g->now & GUARD_RATIO) != 0 && g->ratio_ms >= GUARD_RATIO_LASTS_MS;
  const int ms = g->force_ms;
  g->force_ms = 0;
  const float dt = 1e-3f * (float)ms;
  const float shown = in->force_N / f_max(in->thrust_now_N, CARRYING_SHARE * in->weight_N);
  const bool known = can_be(g->ratio_now) && can_be(g->ratio_usual); // else a bit flipped
  g->carried_s = in->carries && known ? f_clamp(g->carried_s + dt, 0.0f, CARRIED_MOST_S) : 0.0f;
  if (g->carried_s < RATIO_AFTER_S) {
    g->ratio_now = g->ratio_usual = shown;
    g->growth = (guard_growth_t){.n = 0.0f};
    return false;
  }
  g->ratio_now += f_min(dt / RATIO_MEAN_S, 1.0f) * (shown - g->ratio_now);
  const float now = g->ratio_now;
  const float over_s = EITHER(now > g->ratio_usual, RATIO_SLOW_S, RATIO_FAST_S);
  g->ratio_usual += f_min(dt / over_s, 1.0f) * (now - g->ratio_usual);
  fit_growth(&g->growth, shown - g->ratio_usual, dt * g->vel_w_mps.z, 1.0f - f_min(dt / GROWTH_MEAN_S, 1.0f));
  const bool high = now > RATIO_NEAR * g->ratio_usual && in->zc_known && in->zc_m > RATIO_FAR_M;
  const bool near = grows(&g->growth) && !(in->zc_known && in->zc_m <= GROWTH_FAR_M);
  g->ratio_ms = judge_longer(g->ratio_ms, (high || near) && !g->acc_lost, ms);
  return g->ratio_ms >= GUARD_RATIO_LASTS_MS;
}

unsigned judge_ceiling(guard_t *g, const guard_param_t *p, const guard_in_t *in) {
  const bool distance =
      in->range_new && in->range_m >= CEILING_RANGE_MIN_M && in->range_m <= CEILING_RANGE_MAX_M;
  unsigned now = 0;
  FOR_WHOM(range_lost(g, in, distance), &now) now |= GUARD_RANGE_LOST;
  FOR_WHOM(blind(p, in), &now) now |= GUARD_BLIND;
  FOR_WHOM(range_odd(g, in, distance), &now) now |= GUARD_RANGE_ODD;
  FOR_WHOM(range_frozen(g, in, distance), &now) now |= GUARD_RANGE_FROZEN;
  FOR_WHOM(saturated(g, in), &now) now |= GUARD_SATURATED;
  FOR_WHOM(too_near(g, in), &now) now |= GUARD_TOO_NEAR;
  FOR_WHOM(ratio(g, in), &now) now |= GUARD_RATIO;
  return now;
}
