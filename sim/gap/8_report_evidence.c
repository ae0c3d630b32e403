// 8_report_evidence.c - where each named effect shows in the held-out flights, and how well.
#include "gap/8_report.h"

#include "gap/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

status_t report_take_evidence(report_t *r, study_t *study, why_t *why);

#define ROWS_MIN 6    // of a range
#define OUTSIDE  0.01 // of the rows, on each side, that no range reaches to
#define TAIL     0.05 // of the sum of squares on each side of `where`

typedef struct {
  double *r[CHANNELS];
} lines_t;

static bool lines_make(double *r[CHANNELS], const set_t *s) {
  bool good = true;
  for (int ch = 0; ch < CHANNELS; ch++) {
    r[ch] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    good = good && r[ch];
  }
  return good;
}

static void lines_free(double *r[CHANNELS]) {
  for (int ch = 0; ch < CHANNELS; ch++) free(r[ch]);
}

// --- profiles ---------------------------------------------------------------------------------------------

static int coordinate_find(const char *name) {
  for (int i = 0; i < coordinate_count; i++)
    if (name && strcmp(coordinate_name(i), name) == 0) return i;
  return -1;
}

static double at(const report_t *r, int channel, int coordinate, int row) {
  const set_t *const s = &r->study->diagnosis.held;
  const rows_t *const rows = set_rows(s, channel);
  return coordinate_of(coordinate, &s->grid[rows->flight[row]], &r->study->vehicle, rows->point[row]);
}

typedef struct {
  double x, square;
} mark_t;

static int by_x(const void *a, const void *b) {
  const double x = ((const mark_t *)a)->x, y = ((const mark_t *)b)->x;
  return (x > y) - (x < y);
}

// The rows' coordinates, ascending; the caller frees. Null: no memory, or nothing there.
static mark_t *sorted(const report_t *r, int channel, int coordinate, const double *effect, int *n) {
  const rows_t *const rows = set_rows(&r->study->diagnosis.held, channel);
  mark_t *const mark = malloc(((size_t)rows->n + 1) * sizeof *mark);
  *n = 0;
  for (int i = 0; mark && i < rows->n; i++) {
    const double x = at(r, channel, coordinate, i);
    if (!isnan(x)) mark[(*n)++] = (mark_t){x, effect ? effect[i] * effect[i] : 0.0};
  }
  if (mark && *n) qsort(mark, (size_t)*n, sizeof *mark, by_x);
  return mark;
}

static void add_row(profile_t *p, int bin, const report_t *r, int i, double effect, double variance) {
  p->x[bin] += at(r, p->channel, p->coordinate, i);
  p->before[bin] += r->before[p->channel][i];
  p->after[bin] += r->after[p->channel][i];
  p->effect[bin] += effect;
  p->low[bin] += sqrt(variance);
  p->rows[bin] += 1.0;
}

// Sums become means; what has too few rows goes.
static void close_bins(profile_t *p) {
  p->n = 0;
  for (int k = 0; k < REPORT_BINS; k++) {
    const double n = p->rows[k];
    if (n < ROWS_MIN) continue;
    const int to = p->n++;
    const double effect = p->effect[k] / n, wide = 2.0 * p->low[k] / n;
    p->x[to] = p->x[k] / n, p->rows[to] = n;
    p->before[to] = p->before[k] / n, p->after[to] = p->after[k] / n;
    p->effect[to] = effect, p->low[to] = effect - wide, p->high[to] = effect + wide;
  }
}

// What a picture spans: all rows but the outermost, or what matters and about as much beside it.
static span_t span_of(const report_t *r, const profile_t *p, const span_t *near) {
  int n;
  mark_t *const mark = sorted(r, p->channel, p->coordinate, NULL, &n);
  span_t s = {0.0, 0.0};
  if (n) s = (span_t){mark[(int)(OUTSIDE * n)].x, mark[n - 1 - (int)(OUTSIDE * n)].x};
  free(mark);
  if (!near || 3.0 * (near->to - near->from) > s.to - s.from) return s;
  const double wide = fmax(near->to - near->from, 0.05 * (s.to - s.from));
  return (span_t){fmax(s.from, near->from - wide), fmin(s.to, near->to + 1.5 * wide)};
}

void report_profile(const report_t *r, const double *effect, const double *variance, const span_t *near,
                    profile_t *p) {
  *p = (profile_t){.channel = p->channel, .coordinate = p->coordinate};
  const span_t s = span_of(r, p, near);
  const rows_t *const rows = set_rows(&r->study->diagnosis.held, p->channel);
  for (int i = 0; i < rows->n && s.to > s.from; i++) {
    const double x = at(r, p->channel, p->coordinate, i);
    if (!(x >= s.from && x <= s.to)) continue;
    const int bin = (int)fmin(REPORT_BINS - 1, floor(REPORT_BINS * (x - s.from) / (s.to - s.from)));
    add_row(p, bin, r, i, effect ? effect[i] : 0.0, variance ? variance[i] : 0.0);
  }
  close_bins(p);
}

// --- named effects ----------------------------------------------------------------------------------------

static void without(model_t *m, const fx_t *fx) {
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx == fx) {
      m->fx[i] = m->fx[--m->n_fx];
      return;
    }
}

// What the effect adds to each channel, and its variance by the standard errors of its sizes.
static status_t effect_lines(const report_t *r, set_t *held, const finding_t *f, double *effect[CHANNELS],
                             double *variance[CHANNELS], double *room[CHANNELS], why_t *why) {
  model_t m = r->study->diagnosis.extended;
  without(&m, f->fx);
  TRY(residual_of(held, &m, effect, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int i = 0; i < set_rows(held, ch)->n; i++) effect[ch][i] -= r->after[ch][i];
  for (int k = 0; k < f->candidate->n; k++) {
    m = r->study->diagnosis.extended;
    fx_use_t more = f->candidate->use;
    more.p[f->fx->size[k].param] += f->named->stderr_[k];
    TRY(model_add_fx(&m, &more, why));
    TRY(residual_of(held, &m, room, why));
    for (int ch = 0; ch < CHANNELS; ch++)
      for (int i = 0; i < set_rows(held, ch)->n; i++) {
        const double step = room[ch][i] - r->after[ch][i];
        variance[ch][i] += step * step;
      }
  }
  return ST_OK;
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

// Where the middle 90 % of what the effect does lie.
static span_t find_where(const report_t *r, const profile_t *p, const double *effect) {
  int n;
  double all = 0.0, sum = 0.0;
  mark_t *const mark = sorted(r, p->channel, p->coordinate, effect, &n);
  for (int i = 0; i < n; i++) all += mark[i].square;
  span_t where = n ? (span_t){mark[0].x, mark[0].x} : (span_t){0.0, 0.0};
  bool begun = false;
  for (int i = 0; i < n; i++) {
    sum += mark[i].square;
    if (!begun && sum >= TAIL * all) where.from = mark[i].x, begun = true;
    if (sum <= (1.0 - TAIL) * all) where.to = mark[i].x;
  }
  free(mark);
  where.to = fmax(where.from, where.to);
  return where;
}

// How much of what the effect adds changes along the coordinate: the variance of its means. -1: the
// coordinate is not there.
static double told_by(const profile_t *p) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (int k = 0; k < p->n; k++) {
    n += p->rows[k];
    sum += p->rows[k] * p->effect[k];
    squares += p->rows[k] * p->effect[k] * p->effect[k];
  }
  return n > 0.0 ? fmax(squares / n - sum * sum / n / n, 0.0) : -1.0;
}

// Of the coordinates that an effect depends on the one that tells most of it; else time.
static void find_place(const report_t *r, finding_t *f, double *const effect[CHANNELS],
                       double *const variance[CHANNELS]) {
  const where_t where = manoeuvre_where(f->fx);
  const int channel = channel_of(r, where.channel, effect);
  const char *const names[] = {where.coordinate[0], where.coordinate[1], "time"};
  double most = -1.0;
  for (int k = 0; k < 3; k++) {
    profile_t p = {.channel = channel, .coordinate = coordinate_find(names[k])};
    if (p.coordinate < 0 || (k == 2 && most >= 0.0)) continue;
    const span_t span = find_where(r, &p, effect[channel]);
    report_profile(r, effect[channel], variance[channel], &span, &p);
    if (k < 2 && !(told_by(&p) > most)) continue;
    most = told_by(&p);
    f->profile = p, f->where = span;
  }
}

static void find_flight(finding_t *f) {
  if (f->named->n_rival)
    manoeuvre_apart(f->fx, f->named->rival[0], f->fly);
  else
    snprintf(f->fly, sizeof f->fly, "%s", manoeuvre_show(f->fx));
}

static status_t find_one(report_t *r, set_t *held, int i, why_t *why) {
  const diagnosis_t *const d = &r->study->diagnosis;
  finding_t *const f = &r->finding[i];
  f->named = &d->found.named[i];
  f->candidate = &d->candidates.candidate[f->named->candidate];
  f->fx = f->candidate->use.fx;
  for (int k = 0; k < f->candidate->n; k++) f->value[k] = *candidate_value(f->candidate, k);
  lines_t effect, variance, room;
  const bool good[3] = {lines_make(effect.r, held), lines_make(variance.r, held), lines_make(room.r, held)};
  status_t status = good[0] && good[1] && good[2] ? ST_OK : error_failed(why, "out of memory");
  if (status == ST_OK) status = effect_lines(r, held, f, effect.r, variance.r, room.r, why);
  if (status == ST_OK) find_place(r, f, effect.r, variance.r);
  lines_free(effect.r);
  lines_free(variance.r);
  lines_free(room.r);
  find_flight(f);
  return status;
}

status_t report_take_evidence(report_t *r, study_t *study, why_t *why) {
  diagnosis_t *const d = &study->diagnosis;
  const bool good[2] = {lines_make(r->before, &d->held), lines_make(r->after, &d->held)};
  if (!good[0] || !good[1]) return error_failed(why, "out of memory");
  TRY(residual_of(&d->held, &study->vehicle, r->before, why));
  TRY(residual_of(&d->held, &d->extended, r->after, why));
  r->n_finding = d->found.n;
  for (int i = 0; i < r->n_finding; i++) TRY(find_one(r, &d->held, i, why));
  const int coordinate = coordinate_find(d->cell.coordinate);
  r->left = (profile_t){.channel = d->cell.channel, .coordinate = coordinate};
  if (d->cell.statistic > 0.0 && coordinate >= 0) report_profile(r, NULL, NULL, NULL, &r->left);
  return ST_OK;
}
