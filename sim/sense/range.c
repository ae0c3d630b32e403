// range.c - range and flow sensors.
#include "sense/range.h"

#include "base/either.h"
#include "base/larger.h"
#include "base/pair.h"
#include <math.h>

static double rounded(const range_param_t *p, double x) {
  return EITHER(p->rounding > 0.5, nearbyint(x), x);
}

void range_init(range_t *s) {
  *s = (range_t){0};
}

// The distance that the sensor saw at that tick, for a surface distance_m away along its axis.
static double seen_m(const range_t *s, unsigned tick, double distance_m, double cone_rad) {
  const double upright = PICK(s->upright, tick % RANGE_MEMORY);
  const double slant_m = distance_m * upright / cos(larger(acos(upright) - cone_rad, 0.0));
  return EITHER(cone_rad > 0.0 && upright > 0.0, slant_m, distance_m);
}

// True every period_ms, but not at the start.
static bool is_due(const range_t *s, unsigned period_ms) {
  return s->tick > 0 && s->tick % period_ms == 0;
}

static double noise(random_t *r, double sd) {
  return sd > 0.0 ? sd * random_normal(r) : 0.0;
}

// Draws in a fixed order, whatever is seen: what is above must not change the other sensors' noise.
range_drawn_t range_draw(const range_t *s, const range_param_t *p, random_t *r) {
  range_drawn_t drawn = {.up_age_ms = 0.0};
  if (s->tick % RANGE_ANY_PERIOD_MS != 0) return drawn;
  if (is_due(s, RANGE_UP_PERIOD_MS)) {
    drawn.up_age_ms = random_uniform(r, RANGE_UP_AGE_MIN_MS, RANGE_UP_AGE_MAX_MS + 1);
    drawn.up_error_m = noise(r, p->up_m);
  }
  if (is_due(s, RANGE_DOWN_PERIOD_MS)) drawn.down = noise(r, p->down_m > 0.0 ? 1.0 : 0.0);
  if (is_due(s, RANGE_FLOW_PERIOD_MS)) {
    drawn.flow_x = noise(r, p->flow_counts);
    drawn.flow_y = noise(r, p->flow_counts);
  }
  return drawn;
}

static void up(range_t *s, const range_param_t *p, const range_drawn_t *drawn, range_sample_t *out) {
  out->up_new = is_due(s, RANGE_UP_PERIOD_MS);
  if (out->up_new) {
    s->up_at = s->tick - (unsigned)smaller(drawn->up_age_ms, RANGE_UP_AGE_MAX_MS);
    const double true_m = seen_m(s, s->up_at, PICK(s->up_m, s->up_at % RANGE_MEMORY), p->up_cone_rad);
    const double read_m = (1.0 + p->up_scale) * true_m + p->up_offset_m + drawn->up_error_m;
    s->up_mm = EITHER(true_m <= RANGE_UP_MAX_M, larger(rounded(p, 1000.0 * read_m), RANGE_UP_FLOOR_MM),
                      RANGE_UP_NOTHING_MM);
  }
  out->up_mm = s->up_mm;
  out->up_age_ms = EITHER(s->up_mm > 0.0, (int)(s->tick - s->up_at), 0);
}

// Noise relative to that near the ground: 2 at 2.5 m, 81 at 4 m.
static double down_noise_growth(double range_m) {
  return 1.0 + exp(log(80.0) / 1.5 * (range_m - 2.5));
}

static void down(const range_t *s, const range_param_t *p, const range_drawn_t *drawn, range_sample_t *out) {
  out->down_new = is_due(s, RANGE_DOWN_PERIOD_MS);
  if (!out->down_new) return;
  const unsigned at = s->tick - RANGE_DOWN_AGE_MS;
  const double true_m = seen_m(s, at, PICK(s->down_m, at % RANGE_MEMORY), p->down_cone_rad);
  out->down_age_ms = RANGE_DOWN_AGE_MS;
  const double sd_m = p->down_m * down_noise_growth(true_m);
  const double read_m = (1.0 + p->down_scale) * true_m + p->down_offset_m + sd_m * drawn->down;
  out->down_m = EITHER(true_m <= RANGE_DOWN_MAX_M, larger(0.0, 1e-3 * rounded(p, 1000.0 * read_m)),
                       RANGE_DOWN_NOTHING_M);
}

static double deliver(const range_param_t *p, double noise, double *moved) {
  const double counts = rounded(p, *moved);
  *moved -= counts;
  return counts + rounded(p, noise);
}

static void flow(range_t *s, const range_param_t *p, const range_drawn_t *drawn, const truth_t *truth,
                 range_sample_t *out) {
  const d3_t v = dq_to_body(truth->q_wb, truth->vel_w_mps), w = truth->rate_b_radps;
  const double inverse_per_m = 1.0 / larger(truth->down_m, RANGE_FLOW_NEAREST_M);
  // The image moves when the camera moves over the ground and when it turns.
  s->moved_x += 1e-3 * RANGE_COUNTS_PER_RAD * (v.x * inverse_per_m - w.y);
  s->moved_y += 1e-3 * RANGE_COUNTS_PER_RAD * (v.y * inverse_per_m + w.x);
  out->flow_new = is_due(s, RANGE_FLOW_PERIOD_MS);
  if (!out->flow_new) return;
  out->flow_x = deliver(p, drawn->flow_x, &s->moved_x);
  out->flow_y = deliver(p, drawn->flow_y, &s->moved_y);
  out->flow_span_s = 1e-3 * RANGE_FLOW_PERIOD_MS;
}

PAIR_COPIES range_sample_t range_take(range_t *s, const range_param_t *p, const range_drawn_t *drawn,
                                      const truth_t *truth) {
  range_sample_t out = {.up_new = false};
  const unsigned at = s->tick % RANGE_MEMORY;
  s->up_m[at] = truth->up_m;
  s->down_m[at] = truth->down_m;
  const dq_t q = truth->q_wb;
  s->upright[at] = smaller(1.0, 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
  up(s, p, drawn, &out);
  down(s, p, drawn, &out);
  flow(s, p, drawn, truth, &out);
  s->tick++;
  return out;
}

range_sample_t range_step(range_t *s, const range_param_t *p, random_t *r, const truth_t *truth) {
  const range_drawn_t drawn = range_draw(s, p, r);
  return range_take(s, p, &drawn, truth);
}
