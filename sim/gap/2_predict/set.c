// set.c - chooses the points of flights that become rows.
#include "gap/2_predict/set.h"

#include "base/nth.h"
#include <math.h>
#include <stdlib.h>

#define SPREAD_S     0.08 // how far around a masked point it spoils the filter's output
#define EDGE_S       0.3  // ... and the end of a segment does
#define FLIGHT_MIN_S 1.0
#define TOUCHES_M    0.003
#define STRETCHES    6.0 // of a flight, up to twice as many: few, so that slow changes are not alike in all

// good[j]: no masked point or segment's end is near.
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

// Returns an instant's half-flight. A flight's stretches belong to its halves in turn, so that what is met
// once (a ceiling), or in one flight only (turning about the vertical), lies in both and either can confirm
// the other.
static int half_of(int flight, double since_s, double span_s) {
  const double stretch_s = fmax(BLOCK_S, BLOCK_S * floor(span_s / BLOCK_S / STRETCHES));
  return 2 * flight + (int)(since_s / stretch_s) % 2;
}

static void add_flight(set_t *s, int flight, const bool *good) {
  const grid_t *g = &s->grid[flight];
  const int step = (int)fmax(1.0, round(1.0 / (RESIDUAL_HZ * g->period_s)));
  const double start_s = g->n ? g->point[0].t_s : 0.0, end_s = g->n ? g->point[g->n - 1].t_s : 0.0;
  int last = -1000, last_range = -1;
  for (int j = 0; j < g->n; j++) {
    const int block = s->n_block + set_block_of(g, j);
    s->half[block] = half_of(flight, g->point[j].t_s - start_s, end_s - start_s);
    if (good[j] && j >= last + step) {
      rows_add(&s->smooth, flight, j, block, j == last + step);
      last = j;
    }
    if (!good[j] || !isfinite(g->point[j].range_m)) continue;
    rows_add(&s->range, flight, j, block,
             last_range >= 0 && g->point[j].t_s - g->point[last_range].t_s < 0.25);
    last_range = j;
  }
  if (g->n) s->n_block += set_block_of(g, g->n - 1) + 1;
}

// Sets marks, for measured and predicted series alike; turning is a difference over two points.
static bool mark(grid_t *g) {
  g->mark = malloc((size_t)g->n + 1);
  for (int j = 0; g->mark && j < g->n; j++) {
    const bool first = j == 0 || g->point[j].segment != g->point[j - 1].segment;
    const bool last = j + 1 == g->n || g->point[j].segment != g->point[j + 1].segment;
    const bool beside = (j == 0 || g->point[j - 1].ok) && (j + 1 == g->n || g->point[j + 1].ok);
    g->mark[j] =
        (unsigned char)((g->point[j].ok ? MARK_FREE : 0) | (g->point[j].ok && beside ? MARK_TURN_FREE : 0) |
                        (first ? MARK_FIRST : 0) | (last ? MARK_LAST : 0));
  }
  return g->mark != NULL;
}

static done_t no_rows(const grid_t *g, why_t *why) {
  const char *const name = g->flight->name;
  const double span_s = g->n * g->period_s;
  int near = 0;
  for (int j = 0; j < g->n; j++) near += g->point[j].clear_m < TOUCHES_M;
  if (span_s < FLIGHT_MIN_S)
    return error_set(why, "%s: %.2g s of flight; allowed: %g s or more", name, span_s, FLIGHT_MIN_S);
  if (2 * near > g->n)
    return error_set(
        why, "%s: on the floor, or at the vehicle file's ceiling or above it; allowed: free flight", name);
  return error_set(why,
                   "%s: no instant at which motors carry it, below their limit, free of floor and ceiling, "
                   "with every signal there",
                   name);
}

done_t set_make(set_t *s, grid_t *grid, int n, why_t *why) {
  *s = (set_t){.grid = grid, .n_grid = n, .n_half = 2 * n};
  size_t points = 0, most = 1, blocks = 1;
  for (int i = 0; i < n; i++) {
    const size_t here = (size_t)grid[i].n;
    points += here;
    most = here > most ? here : most;
    if (here) blocks += (size_t)set_block_of(&grid[i], grid[i].n - 1) + 2;
  }
  bool *const good = malloc(most * sizeof(bool));
  s->half = calloc(blocks, sizeof(int));
  bool room = rows_room(&s->smooth, points) && rows_room(&s->range, points);
  for (int i = 0; i < n && room; i++) room = mark(&grid[i]);
  if (!good || !s->half || !room) {
    free(good);
    return error_failed(why, "out of memory");
  }
  for (int i = 0; i < n; i++) {
    find_good(&grid[i], good);
    add_flight(s, i, good);
  }
  free(good);
  if (s->smooth.n > 0) return DONE;
  return n ? no_rows(&grid[0], why) : error_set(why, "no flight");
}

static void rows_free(rows_t *r) {
  free(r->point);
  free(r->flight);
  free(r->block);
  free(r->follows);
  free(r->lift);
}

void set_free(set_t *s) {
  for (int i = 0; i < s->n_grid; i++) grid_free(&s->grid[i]);
  free(s->grid);
  rows_free(&s->smooth);
  rows_free(&s->range);
  for (int ch = 0; ch < CHANNELS; ch++) free(s->measured[ch]);
  free(s->half);
  free(s->cuts);
  *s = (set_t){.n_grid = 0};
}

done_t set_lend(const set_t *s, set_t *lent, why_t *why) {
  *lent = *s;
  lent->grid = malloc(((size_t)s->n_grid + 1) * sizeof *lent->grid);
  if (!lent->grid) return error_failed(why, "out of memory");
  for (int i = 0; i < s->n_grid; i++) lent->grid[i] = grid_lend(&s->grid[i]);
  return DONE;
}

void set_give_back(set_t *lent) {
  for (int i = 0; lent->grid && i < lent->n_grid; i++) grid_give_back(&lent->grid[i]);
  free(lent->grid);
  lent->grid = NULL;
}

// Returns the constant of the rows from..end-1.
static double constant_in(const rows_t *r, const double *v, int from, int end) {
  double product = 0.0, square = 0.0;
  for (int i = from; i < end; i++) {
    product += rows_lift(r, i) * v[i];
    square += rows_lift(r, i) * rows_lift(r, i);
  }
  return square > 0.0 ? product / square : 0.0;
}

double rows_constant(const rows_t *r, const double *v, int flight) {
  return constant_in(r, v, rows_from(r, flight), rows_from(r, flight + 1));
}

double rows_usual(const rows_t *r, const double *v, int flights) {
  double sum = 0.0;
  int n = 0;
  for (int f = 0; f < flights; f++)
    if (rows_from(r, f) < rows_from(r, f + 1)) sum += rows_constant(r, v, f), n++;
  return n ? sum / n : 0.0;
}

void rows_take(const rows_t *r, double *v, int flight, double constant) {
  for (int i = rows_from(r, flight); i < rows_from(r, flight + 1); i++) v[i] -= constant * rows_lift(r, i);
}

static void make_constant(const rows_t *r, double *v, double to) {
  for (int from = 0, end; from < r->n; from = end) {
    for (end = from; end < r->n && r->flight[end] == r->flight[from];) end++;
    const double more = constant_in(r, v, from, end) - to;
    for (int i = from; i < end; i++) v[i] -= more * rows_lift(r, i);
  }
}

void rows_center(const rows_t *r, double *v) {
  make_constant(r, v, 0.0);
}

// Returns the median of rows less `constant`, plain or times the lift: absolute, or over that factor.
static double median_in(const rows_t *r, const double *v, int from, int end, bool lifts, double constant,
                        bool absolute, double *room) {
  for (int i = from; i < end; i++) {
    const double times = lifts ? rows_lift(r, i) : 1.0, left = v[i] - constant * times;
    room[i - from] = absolute ? fabs(left) : left / times;
  }
  return nth_smallest(room, end - from, (end - from) / 2);
}

void rows_clear(const rows_t *r, double *v, double *room) {
  for (int from = 0, end; from < r->n; from = end) {
    for (end = from; end < r->n && r->flight[end] == r->flight[from];) end++;
    double constant[2], left[2];
    for (int k = 0; k < 2; k++) {
      constant[k] = median_in(r, v, from, end, k == 1, 0.0, false, room);
      left[k] = median_in(r, v, from, end, k == 1, constant[k], true, room);
    }
    const bool lifts = left[1] < left[0];
    for (int i = from; i < end; i++) v[i] -= constant[lifts] * (lifts ? rows_lift(r, i) : 1.0);
  }
}

void rows_level(const rows_t *r, double *v) {
  make_constant(r, v, constant_in(r, v, 0, r->n));
}
