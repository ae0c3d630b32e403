// whiten.c - residual and columns made white, and their sums of products.
#include "gap/5_infer/whiten.h"

#include "base/lsq_blocks.h"
#include "gap/2_predict/lines.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Fits the colour of what the known columns leave, without each flight's own constant; plain: its spread
// alone.
static bool fit_color(gram_t *g, const set_t *s, const design_t *t, int ch, const explained_t *e) {
  const int n = e->n, *column = e->column;
  const double *b = e->b;
  const rows_t *r = set_rows(s, ch);
  double *const left = malloc(2 * ((size_t)r->n + 1) * sizeof(double));
  if (!left) return false;
  double *const own = left + r->n;
  for (int i = 0; i < r->n; i++) left[i] = t->x[ch][t->columns][i];
  for (int k = 0; k < n; k++) {
    const double *x = t->x[ch][column[k]];
    for (int i = 0; x && i < r->n; i++) left[i] -= b[k] * x[i];
  }
  if (!residual_has(s, ch))
    g->color[ch] = (color_t){.used = false};
  else if (!e->plain)
    g->color[ch] = color_of_flights(r, left, own);
  else {
    rows_center(r, left);
    g->color[ch] = color_plain(r, left);
  }
  if (e->between) g->color[ch].between = fmax(g->color[ch].between, e->between[ch]);
  free(left);
  return true;
}

// White columns of a channel: which ones, and where they begin.
typedef struct {
  int n, *column;
  double *room, **x;
} white_t;

static void white_free(white_t *w) {
  free(w->column);
  free(w->room);
  free(w->x);
}

// Whitens some columns (by column; null: all) and the residual.
static bool white_make(white_t *w, const set_t *s, const design_t *t, int ch, const color_t *color,
                       const bool *some) {
  const rows_t *r = set_rows(s, ch);
  const size_t n = (size_t)t->columns + 1;
  *w = (white_t){.column = malloc(n * sizeof(int)), .x = malloc(n * sizeof(double *))};
  for (int i = 0; w->column && i <= t->columns; i++)
    if (t->x[ch][i] && (!some || i == t->columns || some[i])) w->column[w->n++] = i;
  w->room = malloc((size_t)w->n * ((size_t)r->n + 1) * sizeof(double));
  if (!w->column || !w->x || !w->room) return false;
#pragma omp parallel for schedule(dynamic, 4)
  for (int i = 0; i < w->n; i++) {
    w->x[i] = w->room + (size_t)i * (size_t)r->n;
    color_whiten(color, r, t->x[ch][w->column[i]], w->x[i]);
  }
  return true;
}

// Adds the rows of one half-flight. No other half has its blocks.
static bool add_half(gram_t *g, const rows_t *r, int ch, int half, const white_t *w) {
  const size_t room = (size_t)(g->size * g->size);
  const double **from = malloc(((size_t)w->n + 1) * sizeof(double *));
  bool good = from != NULL;
  for (int i = 0, end; good && i < r->n; i = end) {
    for (end = i; end < r->n && r->block[end] == r->block[i];) end++;
    if (g->half[r->block[i]] != half) continue;
    for (int k = 0; k < w->n; k++) from[k] = w->x[k] + i;
    good = lsq_add_products(end - i, w->n, from, w->column, g->size, g->block + (size_t)r->block[i] * room,
                            g->by_group[group_of(ch)] + (size_t)half * room);
  }
  free(from);
  return good;
}

static bool add_channel(gram_t *g, const set_t *s, const design_t *t, int ch) {
  const rows_t *r = set_rows(s, ch);
  white_t w;
  bool good = white_make(&w, s, t, ch, &g->color[ch], NULL);
  for (int i = 0; i < r->n; i++) g->rows += color_reaches(r, i);
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : good)
  for (int half = 0; half < g->n_half; half++) good = good && add_half(g, r, ch, half, &w);
  white_free(&w);
  return good;
}

// Adds to `total` alone, or to another matrix of its size.
static bool add_total(const gram_t *g, const set_t *s, const design_t *t, int ch, const bool *some,
                      double *total) {
  white_t w;
  const bool good =
      white_make(&w, s, t, ch, &g->color[ch], some) &&
      lsq_add_products(set_rows(s, ch)->n, w.n, (const double *const *)w.x, w.column, g->size, total, NULL);
  white_free(&w);
  return good;
}

// Adds numbers from..to-1 of all blocks, in the blocks' order whichever thread does it.
static void add_some(gram_t *g, size_t from, size_t to) {
  const size_t n = (size_t)(g->size * g->size);
  for (int b = 0; b < g->n_block; b++)
    for (size_t i = from; i < to; i++) {
      const double v = g->block[(size_t)b * n + i];
      g->by_half[(size_t)g->half[b] * n + i] += v;
      g->total[i] += v;
    }
  for (size_t h = 0; h < (size_t)g->n_half; h++)
    for (size_t i = from; i < to; i++) g->others[h * n + i] = g->total[i] - g->by_half[h * n + i];
}

static void add_blocks(gram_t *g) {
  const size_t n = (size_t)(g->size * g->size);
#pragma omp parallel
  {
#pragma omp for nowait
    for (int i = 0; i < GROUPS * g->n_half; i++)
      lsq_mirror(g->by_group[i % GROUPS] + (size_t)(i / GROUPS) * n, g->size);
#pragma omp for
    for (int b = 0; b < g->n_block; b++) lsq_mirror(g->block + (size_t)b * n, g->size);
#pragma omp for
    for (int line = 0; line < g->size; line++)
      add_some(g, (size_t)(line * g->size), (size_t)((line + 1) * g->size));
  }
}

static void empty(gram_t *g) {
  const size_t room = (size_t)(g->size * g->size);
  memset(g->block, 0, (size_t)g->n_block * room * sizeof(double));
  memset(g->by_half, 0, (size_t)g->n_half * room * sizeof(double));
  memset(g->total, 0, room * sizeof(double));
  for (int i = 0; i < GROUPS; i++) memset(g->by_group[i], 0, (size_t)g->n_half * room * sizeof(double));
  g->rows = 0;
}

static bool fill(gram_t *g, const set_t *s, const design_t *t, const explained_t *e) {
  bool good = true;
  empty(g);
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : good)
  for (int ch = 0; ch < CHANNELS; ch++) good = good && fit_color(g, s, t, ch, e);
  for (int ch = 0; ch < CHANNELS && good; ch++)
    if (g->color[ch].used) good = add_channel(g, s, t, ch);
  if (good) add_blocks(g);
  return good;
}

// Fills `total` alone. e null: the colours stay. The channels' sums are added in their order.
static bool fill_total(gram_t *g, const set_t *s, const design_t *t, const explained_t *e, const bool *some) {
  const size_t room = (size_t)(g->size * g->size);
  double *const each = calloc(CHANNELS * room, sizeof(double));
  bool good = each != NULL;
#pragma omp parallel for schedule(dynamic, 1) reduction(&& : good)
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (good && e) good = fit_color(g, s, t, ch, e);
    if (good && g->color[ch].used) good = add_total(g, s, t, ch, some, each + (size_t)ch * room);
  }
  memset(g->total, 0, room * sizeof(double));
  for (int ch = 0; good && ch < CHANNELS; ch++)
    for (size_t i = 0; i < room; i++) g->total[i] += each[(size_t)ch * room + i];
  lsq_mirror(g->total, g->size);
  free(each);
  return good;
}

// Fills the sums in the colours of what all candidates together leave, because an effect not yet named is no
// noise. Ordinary least squares come first: an autoregression of the raw residual would hide what is slow in
// it.
static bool refine(gram_t *g, const set_t *s, const design_t *t, const double *ridge, const double *between,
                   bool total_alone) {
  const int n = t->columns;
  int *const column = malloc(((size_t)n + 1) * sizeof(int));
  double *const b = malloc(((size_t)n + 1) * sizeof(double));
  explained_t e = {0, column, b, true, NULL};
  bool good = column && b && fill_total(g, s, t, &e, NULL);
  for (int i = 0; good && i < n; i++) column[i] = i;
  e = (explained_t){n, column, b, false, between};
  for (int i = 0; good && i < 2; i++) {
    lsq_solve_products(g->total, g->size, column, n, ridge, b, NULL);
    good = i == 0 || total_alone ? fill_total(g, s, t, &e, NULL) : fill(g, s, t, &e);
  }
  free(column);
  free(b);
  return good;
}

done_t gram_make(gram_t *g, const set_t *s, const design_t *t, const explained_t *known, const double *ridge,
                 why_t *why) {
  *g = (gram_t){.size = t->columns + 1,
                .n_block = s->n_block,
                .n_half = s->n_half,
                .n_flight = s->n_grid,
                .half = s->half};
  const size_t room = (size_t)(g->size * g->size);
  g->block = calloc((size_t)g->n_block * room, sizeof(double));
  g->by_half = calloc(2 * (size_t)g->n_half * room, sizeof(double));
  g->others = g->by_half + (size_t)g->n_half * room;
  g->total = calloc(room, sizeof(double));
  bool good = g->block && g->by_half && g->total;
  for (int i = 0; i < GROUPS; i++) {
    g->by_group[i] = calloc((size_t)g->n_half * room, sizeof(double));
    good = good && g->by_group[i];
  }
  if (good) good = ridge ? refine(g, s, t, ridge, NULL, false) : fill(g, s, t, known);
  if (good) return DONE;
  gram_free(g);
  return error_failed(why, "out of memory");
}

done_t gram_make_total(gram_t *g, const set_t *s, const design_t *t, const double *ridge,
                       const double *between, why_t *why) {
  const explained_t nothing = {.between = between};
  *g = (gram_t){.size = t->columns + 1};
  g->total = calloc((size_t)(g->size * g->size), sizeof(double));
  if (g->total && (ridge ? refine(g, s, t, ridge, between, true) : fill_total(g, s, t, &nothing, NULL)))
    return DONE;
  gram_free(g);
  return error_failed(why, "out of memory");
}

done_t gram_renew(gram_t *g, const set_t *s, const design_t *t, const explained_t *known, const bool *some,
                  why_t *why) {
  return fill_total(g, s, t, known, some) ? DONE : error_failed(why, "out of memory");
}

void gram_free(gram_t *g) {
  free(g->block);
  free(g->by_half);
  free(g->total);
  for (int i = 0; i < GROUPS; i++) {
    free(g->by_group[i]);
    g->by_group[i] = NULL;
  }
  g->block = g->by_half = g->total = NULL;
}

done_t whiten_between(set_t *s, const model_t *m, double between[CHANNELS], why_t *why) {
  lines_t l = {.r = {NULL}};
  memset(between, 0, CHANNELS * sizeof(double));
  if (s->n_grid < 2) return DONE;
  double *const room = malloc(set_most_rows(s) * sizeof(double));
  const done_t status = room ? residual_lines(s, m, &l, why) : error_failed(why, "out of memory");
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    if (residual_has(s, ch)) between[ch] = color_of_flights(set_rows(s, ch), l.r[ch], room).between;
  lines_free(&l);
  free(room);
  return status;
}

done_t whiten_left(set_t *s, const model_t *m, const color_t color[CHANNELS], double *left, why_t *why) {
  lines_t l;
  done_t status = lines_make(&l, s, why);
  if (status == DONE) status = residual_of(s, m, l.r, why);
  *left = 0.0;
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    if (color[ch].used) *left += color_left(set_rows(s, ch), &color[ch], l.r[ch]);
  lines_free(&l);
  return status;
}
