// 3_residual.c - measured less predicted, as rows for least squares.
#include "gap/3_residual.h"

#include "lowpass.h"
#include "plant/pair.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CUTOFF_HZ 8.0
#define SPREAD_S  0.08 // a masked point spoils the filter's output so far around it
#define EDGE_S    0.3  // so does the end of a segment
#define TINY      1e-140
#define LEAST_S   1.0
#define NEAR_M    0.003

// --- which points become rows -----------------------------------------------------------------------------

// good[j]: nothing masked is near.
static void find_good(const grid_t *g, bool *good) {
  const int spread = (int)ceil(SPREAD_S / g->period_s), edge = (int)ceil(EDGE_S / g->period_s);
  for (int j = 0; j < g->n; j++) good[j] = true;
  for (int j = 0; j < g->n; j++) {
    const bool first = j == 0 || g->point[j].segment != g->point[j - 1].segment;
    const bool last = j + 1 == g->n || g->point[j].segment != g->point[j + 1].segment;
    const int reach = first || last ? edge : g->point[j].ok ? -1 : spread;
    for (int k = j - reach; k <= j + reach; k++)
      if (k >= 0 && k < g->n) good[k] = false;
  }
}

static bool rows_room(rows_t *r, size_t n) {
  r->point = malloc((n + 1) * sizeof(int));
  r->flight = malloc((n + 1) * sizeof(int));
  r->block = malloc((n + 1) * sizeof(int));
  r->follows = malloc((n + 1) * sizeof(bool));
  return r->point && r->flight && r->block && r->follows;
}

static void rows_add(rows_t *r, int flight, int point, int block, bool follows) {
  r->point[r->n] = point;
  r->flight[r->n] = flight;
  r->block[r->n] = block;
  r->follows[r->n++] = follows;
}

static void add_flight(set_t *s, int flight, const bool *good) {
  const grid_t *g = &s->grid[flight];
  const int step = (int)fmax(1.0, round(1.0 / (RESIDUAL_HZ * g->period_s)));
  const double start_s = g->n ? g->point[0].t_s : 0.0, end_s = g->n ? g->point[g->n - 1].t_s : 0.0;
  int last = -1000, last_range = -1;
  for (int j = 0; j < g->n; j++) {
    const int block = s->n_block + (int)((g->point[j].t_s - start_s) / BLOCK_S);
    s->half[block] = 2 * flight + (g->point[j].t_s - start_s > 0.5 * (end_s - start_s));
    if (good[j] && j >= last + step) {
      rows_add(&s->smooth, flight, j, block, j == last + step);
      last = j;
    }
    if (!good[j] || !isfinite(g->point[j].range_m)) continue;
    rows_add(&s->range, flight, j, block,
             last_range >= 0 && g->point[j].t_s - g->point[last_range].t_s < 0.25);
    last_range = j;
  }
  if (g->n) s->n_block += (int)((end_s - start_s) / BLOCK_S) + 1;
}

static status_t no_rows(const grid_t *g, why_t *why) {
  const char *const name = g->flight->name;
  const double span_s = g->n * g->period_s;
  int near = 0;
  for (int j = 0; j < g->n; j++) near += g->point[j].clear_m < NEAR_M;
  if (span_s < LEAST_S)
    return error_set(why, "%s: %.2g s of flight; allowed: %g s or more", name, span_s, LEAST_S);
  if (2 * near > g->n)
    return error_set(
        why, "%s: on the floor, or at the vehicle file's ceiling or above it; allowed: free flight", name);
  return error_set(
      why, "%s: no instant at which motors carry it, free of floor and ceiling, with every signal there",
      name);
}

status_t set_make(set_t *s, grid_t *grid, int n, why_t *why) {
  *s = (set_t){.grid = grid, .n_grid = n, .n_half = 2 * n};
  size_t points = 0, most = 1, blocks = 1;
  for (int i = 0; i < n; i++) {
    const size_t here = (size_t)grid[i].n;
    points += here;
    most = here > most ? here : most;
    if (here) blocks += (size_t)((grid[i].point[here - 1].t_s - grid[i].point[0].t_s) / BLOCK_S) + 2;
  }
  bool *const good = malloc(most * sizeof(bool));
  s->half = calloc(blocks, sizeof(int));
  const bool room = rows_room(&s->smooth, points) && rows_room(&s->range, points);
  if (!good || !s->half || !room) {
    free(good);
    return error_failed(why, "out of memory");
  }
  for (int i = 0; i < n; i++) {
    find_good(&grid[i], good);
    add_flight(s, i, good);
  }
  free(good);
  if (s->smooth.n > 0) return ST_OK;
  return n ? no_rows(&grid[0], why) : error_set(why, "no flight");
}

static void rows_free(rows_t *r) {
  free(r->point);
  free(r->flight);
  free(r->block);
  free(r->follows);
}

void set_free(set_t *s) {
  for (int i = 0; i < s->n_grid; i++) grid_free(&s->grid[i]);
  free(s->grid);
  rows_free(&s->smooth);
  rows_free(&s->range);
  free(s->half);
  *s = (set_t){.n_grid = 0};
}

// --- rows of a series
// ---------------------------------------------------------------------------------------

static double at(const grid_t *g, const double *v, int j, int k) {
  return k >= 0 && k < g->n && g->point[k].segment == g->point[j].segment ? v[k] : v[j];
}

static double differentiated(const grid_t *g, const double *v, int j) {
  return (at(g, v, j, j + 1) - at(g, v, j, j - 1)) / (2.0 * g->period_s);
}

static double over_two(const grid_t *g, const double *v, int j) {
  return (at(g, v, j, j - 1) + 4.0 * v[j] + at(g, v, j, j + 1)) / 6.0;
}

// One number of every smooth channel.
typedef double smooth_t[CH_SMOOTH];

// A number that is almost nothing is nothing: what dies away in the filter would end where processors are
// slow.
static pair_t not_tiny(pair_t y) {
  const pair_bits_t is = (y > TINY) | (y < -TINY);
  return (pair_t)(is & (pair_bits_t)y);
}

// Forwards and backwards; every segment starts at rest. All channels at once: one alone waits for itself.
static void smooth(const grid_t *g, smooth_t *v) {
  enum { PAIRS = CH_SMOOTH / 2 };
  pair_t x1[PAIRS] = {{0.0}}, x2[PAIRS] = {{0.0}}, y1[PAIRS] = {{0.0}}, y2[PAIRS] = {{0.0}};
  lowpass_t f;
  lowpass_init(&f, fmin(CUTOFF_HZ, 0.4 / g->period_s), 1.0 / g->period_s, 0.0);
  for (int way = 1; way >= -1; way -= 2) {
    const int from = way > 0 ? 0 : g->n - 1;
    for (int j = from; j >= 0 && j < g->n; j += way) {
      const bool starts = j == from || g->point[j].segment != g->point[j - way].segment;
      for (int k = 0; k < PAIRS; k++) {
        const pair_t x = pair_of(v[j] + 2 * k);
        if (starts) x1[k] = x2[k] = y1[k] = y2[k] = x;
        const pair_t y = not_tiny(f.b * (x + 2.0 * x1[k] + x2[k]) - f.a1 * y1[k] - f.a2 * y2[k]);
        x2[k] = x1[k], x1[k] = x;
        y2[k] = y1[k], y1[k] = y;
        pair_put(v[j] + 2 * k, y);
      }
    }
  }
}

// Measured and predicted alike; turning is a difference over two points.
static bool is_free(const grid_t *g, int channel, int j) {
  const bool turning = channel >= CH_FORCES;
  return g->point[j].ok &&
         (!turning || ((j == 0 || g->point[j - 1].ok) && (j + 1 == g->n || g->point[j + 1].ok)));
}

// What is masked does not spill over through the filter: the last value stands in for it.
static void take(const grid_t *g, int channel, series_t kind, const double *series, smooth_t *v) {
  double last = 0.0;
  for (int j = 0; j < g->n; j++) {
    const double x = channel < CH_FORCES        ? series[j]
                     : kind == SERIES_PREDICTED ? over_two(g, series, j)
                                                : differentiated(g, series, j);
    if (isfinite(x) && is_free(g, channel, j)) last = x;
    v[j][channel] = last;
  }
}

void residual_rows(const set_t *s, int flight, series_t kind, const double *const series[CHANNELS],
                   double *scratch, double *const row[CHANNELS]) {
  const grid_t *g = &s->grid[flight];
  smooth_t *const v = (smooth_t *)scratch;
  memset(v, 0, (size_t)g->n * sizeof *v);
  for (int ch = 0; ch < CH_SMOOTH; ch++)
    if (row[ch]) take(g, ch, kind, series[ch], v);
  smooth(g, v);
  for (int ch = 0; ch < CHANNELS; ch++) {
    const rows_t *r = set_rows(s, ch);
    const int end = rows_from(r, flight + 1);
    for (int i = rows_from(r, flight); row[ch] && i < end; i++)
      row[ch][i] = ch < CH_SMOOTH ? v[r->point[i]][ch] : series[ch][r->point[i]];
  }
}

static void measured(const point_t *p, double at[CHANNELS]) {
  d3_put(at, p->acc_b_mps2);
  d3_put(at + CH_FORCES, p->rate_b_radps);
  at[CH_RANGE] = p->range_m;
}

status_t residual_measured(const set_t *s, double *const row[CHANNELS], why_t *why) {
  for (int f = 0; f < s->n_grid; f++) {
    const grid_t *g = &s->grid[f];
    const size_t n = (size_t)g->n + 1;
    double *const room = malloc((CHANNELS + CH_SMOOTH) * n * sizeof(double)), *series[CHANNELS];
    if (!room) return error_failed(why, "out of memory");
    for (size_t ch = 0; ch < CHANNELS; ch++) series[ch] = room + ch * n;
    for (int j = 0; j < g->n; j++) {
      double at[CHANNELS];
      measured(&g->point[j], at);
      for (int ch = 0; ch < CHANNELS; ch++) series[ch][j] = at[ch];
    }
    residual_rows(s, f, SERIES_RATE, (const double *const *)series, room + CHANNELS * n, row);
    free(room);
  }
  return ST_OK;
}

bool residual_has(const set_t *s, int channel) {
  if (s->muted[channel]) return false;
  if (channel == CH_RANGE) return s->range.n > 20 && s->grid[0].has_position;
  for (int i = 0; i < s->n_grid; i++) {
    const grid_t *g = &s->grid[i];
    if (channel < CH_FORCES ? !g->has_force : !(g->has_rates && g->has_moments)) return false;
  }
  return true;
}
