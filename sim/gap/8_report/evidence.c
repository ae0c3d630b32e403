// evidence.c - where each named effect shows in the held-out flights, and how well.
#include "gap/8_report/report.h"

#include "base/by_size.h"
#include "base/nth.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MATTERS_M    0.07 // farther from a ceiling, its effect is below 5 % (thesis)
#define BIN_ROWS_MIN 6    // a bin with fewer rows is dropped
#define OUTSIDE      0.01 // share of the rows left out at each end of the coordinate
#define TAIL         0.05 // share of the sum of squares left out at each end of `where`

// --- held-out rows over a coordinate ----------------------------------------------------------------------

interval_t report_span(const set_t *s, const rows_t *rows, const model_t *m, int coordinate, double outside) {
  double *const x = malloc(((size_t)rows->n + 1) * sizeof *x);
  int n = 0;
  for (int i = 0; x && i < rows->n; i++) {
    x[n] = coordinate_of(coordinate, &s->grid[rows->flight[i]], m, rows->point[i]);
    n += !isnan(x[n]);
  }
  interval_t span = {(double)NAN, (double)NAN};
  if (n) {
    const int least = (int)(outside * n);
    span = (interval_t){nth_smallest(x, n, least), nth_smallest(x, n, n - 1 - least)};
  }
  free(x);
  return span;
}

// Returns the profile's coordinate of a held-out row; NaN: not in the log.
static double at(const report_t *r, const profile_t *p, int row) {
  const set_t *const s = &r->study->diagnosis.held;
  const rows_t *const rows = set_rows(s, p->channel);
  return coordinate_of(p->coordinate, &s->grid[rows->flight[row]], &r->study->vehicle, rows->point[row]);
}

static int rows_of(const report_t *r, const profile_t *p) {
  return set_rows(&r->study->diagnosis.held, p->channel)->n;
}

static void add_row(profile_t *p, int bin, const report_t *r, int i, double effect, double variance) {
  p->x[bin] += at(r, p, i);
  p->before[bin] += r->before.r[p->channel][i];
  p->after[bin] += r->after.r[p->channel][i];
  p->effect[bin] += effect;
  p->low[bin] += sqrt(variance);
  p->rows[bin] += 1.0;
}

// Turns the sums into means and drops bins with too few rows.
static void close_bins(profile_t *p) {
  p->n = 0;
  for (int k = 0; k < REPORT_BINS; k++) {
    const double n = p->rows[k];
    if (n < BIN_ROWS_MIN) continue;
    const int to = p->n++;
    const double effect = p->effect[k] / n, wide = p->low[k] / n;
    p->x[to] = p->x[k] / n, p->rows[to] = n;
    p->before[to] = p->before[k] / n, p->after[to] = p->after[k] / n;
    p->effect[to] = effect, p->low[to] = effect - wide, p->high[to] = effect + wide;
  }
}

// Returns the range of a picture: all rows but the outermost; or, if it is less than a third of that, `near`
// with about its width on each side.
static interval_t span_of(const report_t *r, const profile_t *p, const interval_t *near) {
  const set_t *const held = &r->study->diagnosis.held;
  const interval_t s =
      report_span(held, set_rows(held, p->channel), &r->study->vehicle, p->coordinate, OUTSIDE);
  if (!near || 3.0 * (near->to - near->from) > s.to - s.from) return s;
  const double wide = fmax(near->to - near->from, 0.05 * (s.to - s.from));
  return (interval_t){fmax(s.from, near->from - wide), fmin(s.to, near->to + 1.5 * wide)};
}

// Fills a profile with means of held-out rows over its coordinate. effect, variance: what the effect adds to
// each row, and its variance, or null. near: the range that matters, or null.
static void fill_profile(const report_t *r, const double *effect, const double *variance,
                         const interval_t *near, profile_t *p) {
  *p = (profile_t){.channel = p->channel, .coordinate = p->coordinate};
  const interval_t s = span_of(r, p, near);
  for (int i = 0; i < rows_of(r, p) && s.to > s.from; i++) {
    const double x = at(r, p, i);
    if (!(x >= s.from && x <= s.to)) continue;
    const int bin = (int)fmin(REPORT_BINS - 1, floor(REPORT_BINS * (x - s.from) / (s.to - s.from)));
    add_row(p, bin, r, i, effect ? effect[i] : 0.0, variance ? variance[i] : 0.0);
  }
  close_bins(p);
}

// --- which coordinate -------------------------------------------------------------------------------------

typedef struct {
  double x, square;
} mark_t;

static int by_x(const void *a, const void *b) {
  return by_size(&((const mark_t *)a)->x, &((const mark_t *)b)->x);
}

// Returns the range that holds the middle 90 % of the effect's sum of squares.
static interval_t where_most(const report_t *r, const profile_t *p, const double *effect) {
  mark_t *const mark = malloc(((size_t)rows_of(r, p) + 1) * sizeof *mark);
  interval_t where = {0.0, 0.0};
  double all = 0.0, sum = 0.0;
  int n = 0, first = 0, last = 0;
  for (int i = 0; mark && i < rows_of(r, p); i++) {
    const double x = at(r, p, i);
    if (!isnan(x)) mark[n++] = (mark_t){x, effect[i] * effect[i]};
  }
  if (n) qsort(mark, (size_t)n, sizeof *mark, by_x);
  for (int i = 0; i < n; i++) all += mark[i].square;
  for (int i = 0; i < n; i++) {
    if (sum < TAIL * all) first = i;
    sum += mark[i].square;
    if (sum <= (1.0 - TAIL) * all) last = i;
  }
  if (n) where = (interval_t){mark[first].x, mark[first > last ? first : last].x};
  free(mark);
  return where;
}

static double square_correlation(const double *sum, double n) {
  const double xx = sum[2] - sum[0] * sum[0] / n, yy = sum[3] - sum[1] * sum[1] / n;
  const double xy = sum[4] - sum[0] * sum[1] / n;
  return xx > 0.0 && yy > 1e-12 * sum[3] ? xy * xy / (xx * yy) : 0.0;
}

// Returns the squared correlation (0..1) of the effect with the coordinate or with its absolute value,
// whichever is larger; -1 if no row has the coordinate.
static double explained(const report_t *r, const profile_t *p, const double *effect) {
  double sum[2][5] = {{0.0}}, n = 0.0;
  for (int i = 0; i < rows_of(r, p); i++) {
    const double x = at(r, p, i), y = effect[i];
    if (isnan(x)) continue;
    n += 1.0;
    for (int k = 0; k < 2; k++) {
      const double own = k ? fabs(x) : x, add[5] = {own, y, own * own, y * y, own * y};
      for (int q = 0; q < 5; q++) sum[k][q] += add[q];
    }
  }
  return n > 0.0 ? fmax(square_correlation(sum[0], n), square_correlation(sum[1], n)) : -1.0;
}

// Returns the rms of a residual in a range; 0 if it has no row.
static double rms_in(const report_t *r, const profile_t *p, const interval_t *span, const double *residual) {
  double sum = 0.0, n = 0.0;
  for (int i = 0; i < rows_of(r, p); i++) {
    const double x = at(r, p, i);
    if (!(x >= span->from && x <= span->to)) continue;
    sum += residual[i] * residual[i];
    n += 1.0;
  }
  return n > 0.0 ? sqrt(sum / n) : 0.0;
}

// --- named effects ----------------------------------------------------------------------------------------

// What the effect adds to each row, and the variance of that by the standard errors of its sizes.
typedef struct {
  lines_t effect, variance;
  const lines_t *now; // the residual with all named effects
} adds_t;

static done_t add_variance(const report_t *r, set_t *held, const finding_t *f, int k, adds_t *adds,
                           why_t *why) {
  model_t m = r->study->diagnosis.extended;
  fx_use_t more = *f->use;
  lines_t left;
  more.p[f->fx->size[k].param] += f->named->stderr_[k];
  TRY(model_add_fx(&m, &more, why));
  const done_t status = residual_lines(held, &m, &left, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    for (int i = 0; i < set_rows(held, ch)->n; i++)
      adds->variance.r[ch][i] += pow(left.r[ch][i] - adds->now->r[ch][i], 2);
  lines_free(&left);
  return status;
}

static done_t find_adds(const report_t *r, set_t *held, const finding_t *f, adds_t *adds, why_t *why) {
  model_t m = r->study->diagnosis.extended;
  fx_use_t without = *f->use; // its other numbers may belong to another name
  for (int k = f->from; k < f->to; k++)
    fx_use_resize(&without, k, f->in_file ? fx_use_size(f->in_file, k) : 0.0);
  if (f->in_file || f->fx->size_apart)
    TRY(model_add_fx(&m, &without, why));
  else
    model_drop_fx(&m, f->fx);
  TRY(residual_lines(held, &m, &adds->effect, why));
  TRY(lines_make(&adds->variance, held, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int i = 0; i < set_rows(held, ch)->n; i++) adds->effect.r[ch][i] -= adds->now->r[ch][i];
  for (int k = f->from; k < f->to; k++) TRY(add_variance(r, held, f, k, adds, why));
  return DONE;
}

static int channel_of(const report_t *r, const char *wanted, double *const effect[CHANNELS]) {
  const diagnosis_t *const d = &r->study->diagnosis;
  double most = -1.0;
  int best = CH_FZ;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (!p->used || !(p->after > 0.0)) continue;
    if (wanted && strcmp(wanted, gap_channel[ch]) == 0) return ch;
    double sum = 0.0;
    for (int i = 0; i < set_rows(&d->held, ch)->n; i++) sum += effect[ch][i] * effect[ch][i];
    if (!(sum / (p->after * p->after) > most)) continue;
    most = sum / (p->after * p->after);
    best = ch;
  }
  return best;
}

static bool is_wanted(const fx_t *fx, int coordinate) {
  const char *const name = coordinate_name(coordinate);
  if (!fx->over[0]) return strcmp(name, "time") != 0;
  for (int k = 0; k < 2; k++)
    if (fx->over[k] && strcmp(name, fx->over[k]) == 0) return true;
  return false;
}

// Fills the finding's profile and rms over the coordinate that explains most of the effect, among those that
// the effect depends on; else over time.
static void find_place(const report_t *r, finding_t *f, double *const effect[CHANNELS],
                       double *const variance[CHANNELS]) {
  const int channel = channel_of(r, f->fx->in, effect);
  profile_t *const p = &f->profile;
  double most = -1.0;
  int best = COORDINATE_TIME;
  for (int k = 0; k < COORDINATES; k++) {
    const profile_t over = {.channel = channel, .coordinate = k};
    const double told = is_wanted(f->fx, k) ? explained(r, &over, effect[channel]) : -1.0;
    if (!(told > most)) continue;
    most = told;
    best = k;
  }
  *p = (profile_t){.channel = channel, .coordinate = best};
  f->where = where_most(r, p, effect[channel]);
  fill_profile(r, effect[channel], variance[channel], &f->where, p);
  f->matters = f->fx->surface ? (interval_t){0.0, MATTERS_M} : f->where;
  f->before = rms_in(r, p, &f->matters, r->before.r[channel]);
  f->after = rms_in(r, p, &f->matters, r->after.r[channel]);
}

static done_t find_one(report_t *r, set_t *held, const lines_t *now, finding_t *f, why_t *why) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const candidate_t *const own = &d->candidates.candidate[f->named->candidate];
  f->name = candidate_name(own);
  f->fx = own->use.fx, f->from = own->from, f->to = own->to;
  f->use = model_fx(&d->extended, f->fx);
  f->in_file = model_fx(&r->study->vehicle, f->fx);
  adds_t adds = {.now = now};
  const done_t status = find_adds(r, held, f, &adds, why);
  if (status == DONE) find_place(r, f, adds.effect.r, adds.variance.r);
  const int channel = f->profile.channel;
  if (status == DONE) report_describe(r, f, adds.effect.r[channel], set_rows(held, channel)->n);
  lines_free(&adds.effect);
  lines_free(&adds.variance);
  return status;
}

static void order_by_share(report_t *r, const found_t *found) {
  for (int i = 0; i < found->n; i++) {
    int at = i;
    for (; at > 0 && r->finding[at - 1].named->share < found->named[i].share; at--)
      r->finding[at].named = r->finding[at - 1].named;
    r->finding[at].named = &found->named[i];
  }
}

done_t report_take_evidence(report_t *r, study_t *study, why_t *why) {
  diagnosis_t *const d = &study->diagnosis;
  const verify_job_t held = {&d->held, &d->fit, &study->vehicle, &d->loop, &d->found, &d->turns, &d->own};
  r->own = calloc((size_t)d->held.n_grid * CHANNELS + 1, sizeof(double));
  if (!r->own) return error_failed(why, "out of memory");
  TRY(verify_lines(&held, &r->before, &r->after, r->own, why));
  r->n_finding = d->found.n;
  order_by_share(r, &d->found);
  lines_t now = {.r = {NULL}};
  done_t status = residual_lines(&d->held, &d->extended, &now, why);
  for (int i = 0; i < r->n_finding && status == DONE; i++)
    status = find_one(r, &d->held, &now, &r->finding[i], why);
  lines_free(&now);
  TRY(status);
  r->left = (profile_t){.channel = d->left.cell.channel, .coordinate = d->left.cell.along};
  if (d->left.cell.statistic > 0.0 && d->left.cell.along != NOWHERE && d->left.cell.along != BY_FLIGHT)
    fill_profile(r, NULL, NULL, NULL, &r->left);
  return DONE;
}
