// segments.c - what a flight was like.
#include "flight/segments.h"

#include <math.h>

#define LAST_S    5.0
#define PEAK_M    2e-4
#define SETTLED_M 1e-3

// The samples first..last belong to a segment that begins at sample first.
typedef struct {
  const sample_t *s;
  int first, last;
  double setpoint_m;
} span_t;

static double error_m(const span_t *x, int i) {
  return x->s[i].z_m - x->setpoint_m;
}

static void measure_rise(const span_t *x, segment_t *out) {
  const double way_m = -error_m(x, x->first), direction = way_m < 0.0 ? -1.0 : 1.0;
  const double start_s = x->s[x->first].t_s;
  double beyond_m = 0.0;
  int unsettled = x->first - 1;
  for (int i = x->first; i <= x->last; i++) {
    const double past_m = direction * error_m(x, i);
    beyond_m = fmax(beyond_m, past_m);
    if (isnan(out->t90_s) && fabs(way_m) > 1e-6 && past_m >= -0.1 * fabs(way_m))
      out->t90_s = x->s[i].t_s - start_s;
    if (!(fabs(past_m) <= SETTLED_M)) unsettled = i;
  }
  out->overshoot_mm = 1e3 * beyond_m;
  if (unsettled < x->last) out->settle_1mm_s = x->s[unsettled + 1].t_s - start_s;
}

static int count_peaks(const span_t *x) {
  const double direction = error_m(x, x->first) > 0.0 ? -1.0 : 1.0;
  int i = x->first, peaks = 0;
  while (i <= x->last && direction * error_m(x, i) < 0.0) i++;
  for (i = i > x->first ? i : x->first + 1; i < x->last; i++) {
    const double before = error_m(x, i) - error_m(x, i - 1), after = error_m(x, i + 1) - error_m(x, i);
    peaks += before * after < 0.0 && fabs(error_m(x, i)) > PEAK_M;
  }
  return peaks;
}

static void measure_hover(const span_t *x, segment_t *out) {
  double sum = 0.0, sum2 = 0.0;
  int n = 0;
  for (int i = x->last; i >= x->first && x->s[i].t_s > x->s[x->last].t_s - LAST_S; i--, n++) {
    sum += error_m(x, i);
    sum2 += error_m(x, i) * error_m(x, i);
  }
  if (n == 0) return;
  const double mean = sum / n;
  out->mean_error_mm = 1e3 * mean;
  out->rms_mm = 1e3 * sqrt(sum2 / n);
  out->sd_mm = 1e3 * sqrt(fmax(0.0, sum2 / n - mean * mean));
}

static segment_t measure(const span_t *x) {
  segment_t out = {.setpoint_m = x->setpoint_m, .t90_s = (double)NAN, .settle_1mm_s = (double)NAN};
  out.mean_error_mm = out.sd_mm = out.rms_mm = (double)NAN;
  measure_rise(x, &out);
  measure_hover(x, &out);
  out.peaks = count_peaks(x);
  double gap_m = x->s[x->first].gap_m;
  if (x->first == 0) out.tilt_max_rad = x->s[0].tilt_rad;
  for (int i = x->first + 1; i <= x->last; i++) {
    gap_m = fmin(gap_m, x->s[i].gap_min_m);
    out.tilt_max_rad = fmax(out.tilt_max_rad, x->s[i].tilt_rad);
  }
  out.min_gap_mm = isfinite(gap_m) ? 1e3 * gap_m : (double)NAN;
  // A contact that lasts from the segment before counts here too.
  out.contacts = x->s[x->last].contacts - x->s[x->first].contacts + x->s[x->first].touching;
  return out;
}

int segments_of(const record_t *record, const plan_t *plan, segment_t segment[WAYPOINTS_MAX]) {
  int n = 0, first = 0;
  for (int i = 0; i < plan->n_way; i++) {
    const double until_s = i + 1 < plan->n_way ? plan->way[i + 1].at_s : plan->end_s;
    int last = first;
    while (last + 1 < record->n && record->sample[last].t_s < until_s - 1e-9) last++;
    if (first >= record->n) break;
    const span_t span = {record->sample, first, last, plan->way[i].setpoint_m};
    segment[n++] = measure(&span);
    first = last;
  }
  return n;
}
