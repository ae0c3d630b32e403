// 3_residual.c - measured less predicted, as rows for least squares.
#include "gap/3_residual.h"

#include "lowpass.h"
#include <math.h>
#include <stdlib.h>

#define CUTOFF_HZ 8.0
#define SPREAD_S  0.08 // a masked point spoils the filter's output so far around it
#define EDGE_S    0.3  // so does the end of a segment

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
  return error_set(why, "%s: no instant at which it flies freely with every signal there",
                   n ? grid[0].flight->name : "no flight");
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

// Forwards and backwards; every segment starts at rest.
static void smooth(const grid_t *g, double *v) {
  const double cutoff_Hz = fmin(CUTOFF_HZ, 0.4 / g->period_s);
  lowpass_t f;
  for (int way = 1; way >= -1; way -= 2) {
    const int from = way > 0 ? 0 : g->n - 1;
    for (int j = from; j >= 0 && j < g->n; j += way) {
      if (j == from || g->point[j].segment != g->point[j - way].segment)
        lowpass_init(&f, cutoff_Hz, 1.0 / g->period_s, v[j]);
      v[j] = lowpass_step(&f, v[j]);
    }
  }
}

// Measured and predicted alike; turning is a difference over two points.
static bool is_free(const grid_t *g, int channel, int j) {
  const bool turning = channel >= CH_FORCES;
  return g->point[j].ok &&
         (!turning || ((j == 0 || g->point[j - 1].ok) && (j + 1 == g->n || g->point[j + 1].ok)));
}

void residual_rows(const set_t *s, int flight, int channel, series_t kind, const double *series,
                   double *scratch, double *row) {
  const grid_t *g = &s->grid[flight];
  const rows_t *r = set_rows(s, channel);
  const double *from = series;
  if (channel < CH_SMOOTH) {
    double last = 0.0;
    for (int j = 0; j < g->n; j++) {
      const double v = channel < CH_FORCES        ? series[j]
                       : kind == SERIES_PREDICTED ? over_two(g, series, j)
                                                  : differentiated(g, series, j);
      if (isfinite(v) && is_free(g, channel, j)) last = v;
      scratch[j] = last; // what is masked does not spill over through the filter
    }
    smooth(g, scratch);
    from = scratch;
  }
  for (int i = 0; i < r->n; i++)
    if (r->flight[i] == flight) row[i] = from[r->point[i]];
}

static double measured(const point_t *p, int channel) {
  const double v[CHANNELS] = {p->acc_b_mps2.x,   p->acc_b_mps2.y,   p->acc_b_mps2.z, p->rate_b_radps.x,
                              p->rate_b_radps.y, p->rate_b_radps.z, p->range_m};
  return v[channel];
}

status_t residual_measured(const set_t *s, int channel, double *row, why_t *why) {
  for (int f = 0; f < s->n_grid; f++) {
    const grid_t *g = &s->grid[f];
    double *const series = malloc(2 * ((size_t)g->n + 1) * sizeof(double));
    if (!series) return error_failed(why, "out of memory");
    for (int j = 0; j < g->n; j++) series[j] = measured(&g->point[j], channel);
    residual_rows(s, f, channel, SERIES_RATE, series, series + g->n, row);
    free(series);
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
