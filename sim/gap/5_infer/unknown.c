// unknown.c - where a residual is largest.
#include "gap/5_infer/unknown.h"

#include "base/nth.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDEST 6 // bins of a window

// --- coordinates ------------------------------------------------------------------------------------------

typedef enum {
  CEILING,
  HEIGHT,
  POS_X,
  POS_Y,
  VEL_X,
  VEL_Y,
  VEL_Z,
  VOLTAGE,
  THRUST,
  RATE_X,
  RATE_Y,
  RATE_Z,
  TIME,
  COORDINATES
} coordinate_t;

static const char *const NAME[COORDINATES][2] = {[CEILING] = {"ceiling distance", "m"},
                                                 [HEIGHT] = {"height", "m"},
                                                 [POS_X] = {"x", "m"},
                                                 [POS_Y] = {"y", "m"},
                                                 [VEL_X] = {"v_x", "m/s"},
                                                 [VEL_Y] = {"v_y", "m/s"},
                                                 [VEL_Z] = {"v_z", "m/s"},
                                                 [VOLTAGE] = {"voltage", "V"},
                                                 [THRUST] = {"thrust", "N"},
                                                 [RATE_X] = {"roll rate", "rad/s"},
                                                 [RATE_Y] = {"pitch rate", "rad/s"},
                                                 [RATE_Z] = {"yaw rate", "rad/s"},
                                                 [TIME] = {"time", "s"}};

const int coordinate_count = COORDINATES;
const char *coordinate_name(int i) {
  return NAME[i][0];
}
const char *coordinate_unit(int i) {
  return NAME[i][1];
}

bool coordinate_is_place(int i) {
  return i == CEILING || i == HEIGHT || i == POS_X || i == POS_Y || i == TIME;
}

static double thrust_of(const grid_t *g, int j) {
  double sum = 0.0;
  for (int k = 0; k < ROTORS; k++) sum += g->motors[0].thrust_N[k][j];
  return sum;
}

double coordinate_of(int i, const grid_t *g, const model_t *m, int j) {
  const grid_point_t *p = &g->point[j];
  const double none = (double)NAN;
  const axes_t axes = axes_of(p->q_wb);
  const d3_t v = axes_to_body(&axes, p->vel_w_mps);
  const double up_m = m->ceiling_m - p->pos_w_m.z - body_rotor_z_m(m);
  switch ((coordinate_t)i) {
  case CEILING: return g->has_position && isfinite(up_m) ? up_m : none;
  case HEIGHT: return g->has_position ? p->pos_w_m.z - body_rest_z_m(m) : none;
  case POS_X: return g->has_position ? p->pos_w_m.x : none;
  case POS_Y: return g->has_position ? p->pos_w_m.y : none;
  case VEL_X: return g->has_velocity ? v.x : none;
  case VEL_Y: return g->has_velocity ? v.y : none;
  case VEL_Z: return g->has_velocity ? v.z : none;
  case VOLTAGE: return g->has_vbat ? p->vbat_V : none;
  case THRUST: return g->motors[0].thrust_N[0] ? thrust_of(g, j) : none;
  case RATE_X: return g->has_rates ? p->rate_b_radps.x : none;
  case RATE_Y: return g->has_rates ? p->rate_b_radps.y : none;
  case RATE_Z: return g->has_rates ? p->rate_b_radps.z : none;
  case TIME: return p->t_s - g->flight->t_s[0]; // of the log, also where a part of it is held out
  case COORDINATES: break;
  }
  return none;
}

// --- bins -------------------------------------------------------------------------------------------------

// The bin of every row, and the edges (UNKNOWN_BINS + 1). False: the coordinate is not there or does not
// move.
static bool cut_bins(const double *value, int n, double *parted, int *bin, double edge[UNKNOWN_BINS + 1]) {
  for (int i = 0; i < n; i++) {
    if (isnan(value[i])) return false;
    parted[i] = value[i];
  }
  for (int k = 0, from = 0, at = 0; k <= UNKNOWN_BINS; k++, from = at) {
    at = k * (n - 1) / UNKNOWN_BINS;
    edge[k] = nth_smallest(parted + from, n - from, at - from);
  }
  if (!(edge[UNKNOWN_BINS] - edge[0] > 1e-9)) return false;
  for (int i = 0; i < n; i++) {
    int k = 0;
    while (k < UNKNOWN_BINS - 1 && value[i] >= edge[k + 1]) k++;
    bin[i] = k;
  }
  return true;
}

// A list's rows: 0: smooth, 1: range.
static const rows_t *rows_of(const set_t *s, int list) {
  return list ? &s->range : &s->smooth;
}

static bool bins_of(const set_t *s, const model_t *m, int coordinate, int list, double *room, int *bin,
                    double edge[UNKNOWN_BINS + 1]) {
  const rows_t *r = rows_of(s, list);
  if (r->n < 4 * UNKNOWN_BINS) return false;
  for (int i = 0; i < r->n; i++) room[i] = coordinate_of(coordinate, &s->grid[r->flight[i]], m, r->point[i]);
  return cut_bins(room, r->n, room + r->n, bin, edge);
}

bool unknown_bins(const set_t *s, const model_t *m, int coordinate, int list, double *room, int *bin) {
  double edge[UNKNOWN_BINS + 1];
  return bins_of(s, m, coordinate, list, room, bin, edge);
}

// Products of indicator columns with each other and with the residual, all white.
typedef struct {
  double D[UNKNOWN_BINS + 1][UNKNOWN_BINS + 1], y[UNKNOWN_BINS + 1]; // the last: a constant
} products_t;

static void add_products(products_t *p, const rows_t *r, const color_t *c, const double *v, const int *bin) {
  const double weight[3] = {1.0 / c->sd, -c->a1 / c->sd, -c->a2 / c->sd};
  const double constant = weight[0] + weight[1] + weight[2];
  memset(p, 0, sizeof *p);
  for (int i = 2; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    const double white = weight[0] * v[i] + weight[1] * v[i - 1] + weight[2] * v[i - 2];
    for (int a = 0; a < 3; a++) {
      const int k = bin[i - a];
      p->y[k] += weight[a] * white;
      p->D[k][UNKNOWN_BINS] += weight[a] * constant;
      for (int b = 0; b < 3; b++) p->D[k][bin[i - b]] += weight[a] * weight[b];
    }
    p->y[UNKNOWN_BINS] += constant * white;
    p->D[UNKNOWN_BINS][UNKNOWN_BINS] += constant * constant;
  }
}

static void try_windows(const products_t *p, bool centred, int channel, int coordinate,
                        const double edge[UNKNOWN_BINS + 1], cell_t *cell) {
  const double all = p->D[UNKNOWN_BINS][UNKNOWN_BINS];
  if (!(all > 0.0)) return;
  for (int from = 0; from < UNKNOWN_BINS; from++) {
    double y = 0.0, own = 0.0, cross = 0.0;
    for (int to = from; to < UNKNOWN_BINS && to < from + WIDEST; to++) {
      y += p->y[to];
      cross += p->D[to][UNKNOWN_BINS];
      for (int k = from; k <= to; k++) own += (k == to ? 1.0 : 2.0) * p->D[k][to];
      const double share = centred ? cross / all : 0.0;
      const double free_y = y - share * p->y[UNKNOWN_BINS], free_own = own - share * cross;
      if (!(free_own > 1e-3 * own)) continue;
      const double statistic = fabs(free_y) / sqrt(free_own);
      if (statistic > cell->statistic)
        *cell =
            (cell_t){channel,           NAME[coordinate][0], NAME[coordinate][1],    edge[from], edge[to + 1],
                     free_y / free_own, statistic,           to + 1 == UNKNOWN_BINS, false};
    }
  }
}

static void scan_coordinate(const set_t *s, const model_t *m, int coordinate,
                            double *const residual[CHANNELS], const color_t *color, bool centred,
                            double *room, int *bin, cell_t *cell) {
  products_t p;
  double edge[UNKNOWN_BINS + 1];
  for (int list = 0; list < 2; list++) {
    if (!bins_of(s, m, coordinate, list, room, bin, edge)) continue;
    for (int ch = list ? CH_RANGE : 0; ch < (list ? CHANNELS : CH_SMOOTH); ch++) {
      if (!color[ch].used) continue;
      add_products(&p, rows_of(s, list), &color[ch], residual[ch], bin);
      try_windows(&p, centred, ch, coordinate, edge, cell);
    }
  }
}

// --- the lateral force in the world's axes ----------------------------------------------------------------

static bool has_lateral_force(const set_t *s) {
  bool has = residual_has(s, CH_FX) && residual_has(s, CH_FY);
  for (int i = 0; i < s->n_grid; i++) has = has && s->grid[i].has_attitude;
  return has;
}

// Turned about the vertical by the heading, or back (way -1). In place, too.
static void turn_by_heading(const set_t *s, double way, const double *fx, const double *fy, double *east,
                            double *north) {
  for (int i = 0; i < s->smooth.n; i++) {
    const axes_t axes = axes_of(s->grid[s->smooth.flight[i]].point[s->smooth.point[i]].q_wb);
    const d3_t ahead = axes_to_world(&axes, d3(1.0, 0.0, 0.0));
    const double level = fmax(hypot(ahead.x, ahead.y), 1e-6), c = ahead.x / level, n = way * ahead.y / level,
                 x = fx[i], y = fy[i];
    east[i] = c * x - n * y;
    north[i] = n * x + c * y;
  }
}

// Subtracts the mean of every bin.
static void flatten(const rows_t *r, const int *bin, double *v) {
  double sum[UNKNOWN_BINS] = {0.0};
  int n[UNKNOWN_BINS] = {0};
  for (int i = 0; i < r->n; i++) {
    sum[bin[i]] += v[i];
    n[bin[i]]++;
  }
  for (int i = 0; i < r->n; i++) v[i] -= sum[bin[i]] / n[bin[i]];
}

static void clean(const set_t *s, const model_t *m, int coordinate, double *const residual[CHANNELS],
                  double *room, int *bin) {
  double edge[UNKNOWN_BINS + 1];
  for (int list = 0; list < 2; list++) {
    if (!bins_of(s, m, coordinate, list, room, bin, edge)) continue;
    for (int ch = list ? CH_RANGE : 0; ch < (list ? CHANNELS : CH_SMOOTH); ch++)
      if (residual_has(s, ch)) flatten(rows_of(s, list), bin, residual[ch]);
  }
}

static void clean_in_world(const set_t *s, const model_t *m, double *const residual[CHANNELS], double *room,
                           int *bin) {
  double edge[UNKNOWN_BINS + 1], *const fx = residual[CH_FX], *const fy = residual[CH_FY];
  if (!has_lateral_force(s)) return;
  turn_by_heading(s, 1.0, fx, fy, fx, fy);
  for (int i = 0; i < COORDINATES; i++) {
    if (!bins_of(s, m, i, 0, room, bin, edge)) continue;
    flatten(&s->smooth, bin, fx);
    flatten(&s->smooth, bin, fy);
  }
  turn_by_heading(s, -1.0, fx, fy, fx, fy);
}

done_t unknown_clean(const set_t *s, const model_t *m, double *const residual[CHANNELS], why_t *why) {
  double *const room = malloc(2 * set_most_rows(s) * sizeof(double));
  int *const bin = malloc(set_most_rows(s) * sizeof(int));
  for (int sweep = 0; room && bin && sweep < 2; sweep++) {
    for (int i = 0; i < COORDINATES; i++) clean(s, m, i, residual, room, bin);
    clean_in_world(s, m, residual, room, bin);
  }
  const bool good = room && bin;
  free(room);
  free(bin);
  return good ? DONE : error_failed(why, "out of memory");
}

done_t unknown_colors(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                      color_t color[CHANNELS], why_t *why) {
  const size_t rows = set_most_rows(s);
  double *const copy = malloc(CHANNELS * rows * sizeof(double)), *part[CHANNELS];
  if (!copy) return error_failed(why, "out of memory");
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    part[ch] = copy + ch * rows;
    memcpy(part[ch], residual[ch], (size_t)set_rows(s, (int)ch)->n * sizeof(double));
  }
  const done_t status = unknown_clean(s, m, part, why);
  for (int ch = 0; ch < CHANNELS; ch++)
    color[ch] = residual_has(s, ch) ? color_fit(set_rows(s, ch), part[ch]) : (color_t){.used = false};
  free(copy);
  return status;
}

done_t unknown_along(const set_t *s, const model_t *m, int coordinate, double *const residual[CHANNELS],
                     const color_t *color, cell_t *cell, why_t *why) {
  double *const room = malloc(2 * set_most_rows(s) * sizeof(double));
  int *const bin = malloc(set_most_rows(s) * sizeof(int));
  *cell = (cell_t){.statistic = 0.0};
  if (room && bin) scan_coordinate(s, m, coordinate, residual, color, true, room, bin, cell);
  const bool good = room && bin;
  free(room);
  free(bin);
  return good ? DONE : error_failed(why, "out of memory");
}

static done_t scan_world(const set_t *s, const model_t *m, double *const residual[CHANNELS], bool centred,
                         double *room, int *bin, cell_t *cell, why_t *why) {
  const size_t rows = (size_t)s->smooth.n + 1;
  double *const turned = malloc(2 * rows * sizeof(double)), *all[CHANNELS];
  color_t color[CHANNELS];
  cell_t found = {.statistic = 0.0};
  if (!turned) return error_failed(why, "out of memory");
  memcpy(all, residual, sizeof all);
  all[CH_FX] = turned;
  all[CH_FY] = turned + rows;
  turn_by_heading(s, 1.0, residual[CH_FX], residual[CH_FY], all[CH_FX], all[CH_FY]);
  const done_t status = unknown_colors(s, m, all, color, why);
  for (int ch = CH_FY + 1; ch < CHANNELS; ch++) color[ch].used = false;
  for (int i = 0; i < COORDINATES && status == DONE; i++)
    scan_coordinate(s, m, i, all, color, centred, room, bin, &found);
  free(turned);
  found.world = true;
  if (found.statistic > cell->statistic) *cell = found;
  return status;
}

done_t unknown_largest(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                       const color_t *color, bool centred, cell_t *cell, why_t *why) {
  color_t own[CHANNELS];
  *cell = (cell_t){.statistic = 0.0};
  if (!color) TRY(unknown_colors(s, m, residual, own, why));
  double *const room = malloc(2 * set_most_rows(s) * sizeof(double));
  int *const bin = malloc(set_most_rows(s) * sizeof(int));
  for (int i = 0; room && bin && i < COORDINATES; i++)
    scan_coordinate(s, m, i, residual, color ? color : own, centred, room, bin, cell);
  done_t status = room && bin ? DONE : error_failed(why, "out of memory");
  if (status == DONE && !color && has_lateral_force(s))
    status = scan_world(s, m, residual, centred, room, bin, cell, why);
  free(room);
  free(bin);
  return status;
}
