// unknown.c - what is left that no named effect explains.
#include "gap/5_infer/unknown.h"

#include "gap/5_infer/in_time.h"
#include "gap/5_infer/limits.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the lateral force in the world's axes ----------------------------------------------------------------

static bool has_lateral_force(const set_t *s) {
  bool has = residual_has(s, CH_FX) && residual_has(s, CH_FY);
  for (int i = 0; i < s->n_grid; i++) has = has && s->grid[i].has_attitude;
  return has;
}

// Turns a force by the heading from the body's axes to the world's, or back (way -1). It may be in place.
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
  double sum[WINDOW_BINS] = {0.0};
  int n[WINDOW_BINS] = {0};
  for (int i = 0; i < r->n; i++) {
    sum[bin[i]] += v[i];
    n[bin[i]]++;
  }
  for (int k = 0; k < WINDOW_BINS; k++) sum[k] /= n[k] > 0 ? n[k] : 1;
  for (int i = 0; i < r->n; i++) v[i] -= sum[bin[i]];
}

static void clean(const set_t *s, const model_t *m, int coordinate, double *const residual[CHANNELS],
                  double *room, int *bin) {
  for (int list = 0; list < 2; list++) {
    if (!windows_bins(s, m, coordinate, list, room, bin)) continue;
    for (int ch = list ? CH_RANGE : 0; ch < (list ? CHANNELS : CH_SMOOTH); ch++)
      if (residual_has(s, ch)) flatten(set_rows(s, ch), bin, residual[ch]);
  }
}

static void clean_in_world(const set_t *s, const model_t *m, double *const residual[CHANNELS], double *room,
                           int *bin) {
  double *const fx = residual[CH_FX], *const fy = residual[CH_FY];
  if (!has_lateral_force(s)) return;
  turn_by_heading(s, 1.0, fx, fy, fx, fy);
  if (s->n_grid > 1) {
    rows_center(&s->smooth, fx);
    rows_center(&s->smooth, fy);
  }
  for (int i = 0; i < COORDINATES; i++) {
    if (!windows_bins(s, m, i, 0, room, bin)) continue;
    flatten(&s->smooth, bin, fx);
    flatten(&s->smooth, bin, fy);
  }
  turn_by_heading(s, -1.0, fx, fy, fx, fy);
}

done_t unknown_clean(const set_t *s, const model_t *m, double *const residual[CHANNELS], why_t *why) {
  double *const room = malloc(2 * set_most_rows(s) * sizeof(double));
  int *const bin = malloc(set_most_rows(s) * sizeof(int));
  for (int sweep = 0; room && bin && sweep < 2; sweep++) {
    for (int ch = 0; s->n_grid > 1 && ch < CHANNELS; ch++)
      if (residual_has(s, ch)) rows_center(set_rows(s, ch), residual[ch]);
    for (int i = 0; i < COORDINATES; i++) clean(s, m, i, residual, room, bin);
    clean_in_world(s, m, residual, room, bin);
  }
  const bool good = room && bin;
  free(room);
  free(bin);
  return good ? DONE : error_failed(why, "out of memory");
}

// --- colours ----------------------------------------------------------------------------------------------

static done_t copy_of(const set_t *s, double *const v[CHANNELS], lines_t *copy, why_t *why) {
  TRY(lines_make(copy, s, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    memcpy(copy->r[ch], v[ch], (size_t)set_rows(s, ch)->n * sizeof(double));
  return DONE;
}

static void fit_colors(const set_t *s, double *const v[CHANNELS], color_t color[CHANNELS]) {
  for (int ch = 0; ch < CHANNELS; ch++)
    color[ch] = residual_has(s, ch) ? color_fit(set_rows(s, ch), v[ch]) : (color_t){.used = false};
}

// Fits the colours of the residual after cleaning. world: the same in the world's axes, or a null pointer.
static done_t find_colors(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                          color_t color[CHANNELS], color_t *world, why_t *why) {
  lines_t clean = {.r = {NULL}};
  done_t status = copy_of(s, residual, &clean, why);
  if (status == DONE) status = unknown_clean(s, m, clean.r, why);
  if (status == DONE) fit_colors(s, clean.r, color);
  if (status == DONE && world) {
    turn_by_heading(s, 1.0, clean.r[CH_FX], clean.r[CH_FY], clean.r[CH_FX], clean.r[CH_FY]);
    fit_colors(s, clean.r, world);
  }
  lines_free(&clean);
  return status;
}

done_t unknown_colors(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                      color_t color[CHANNELS], why_t *why) {
  return find_colors(s, m, residual, color, NULL, why);
}

// --- looks ------------------------------------------------------------------------------------------------

static done_t open_look(look_t *l, why_t *why) {
  l->room = malloc(LOOK_ROOM * set_most_rows(l->s) * sizeof(double));
  l->bin = malloc(3 * set_most_rows(l->s) * sizeof(int));
  return l->room && l->bin ? DONE : error_failed(why, "out of memory");
}

static void close_look(look_t *l) {
  free(l->room);
  free(l->bin);
}

// The coordinates are searched in parallel; of equal cells the one along the first coordinate counts.
done_t unknown_along(const set_t *s, const model_t *m, int from, int to, double *const residual[CHANNELS],
                     const color_t color[CHANNELS], bool centred, cell_t cell[CHANNELS], why_t *why) {
  cell_t each[COORDINATES][LOOKED] = {{{.statistic = 0.0}}};
  bool good = true;
#pragma omp parallel reduction(&& : good)
  {
    look_t l = look_of(s, m, residual, color, centred);
    why_t own;
    good = open_look(&l, &own) == DONE;
#pragma omp for schedule(dynamic, 1)
    for (int i = from; i < to; i++)
      if (l.room && l.bin) windows_along(&l, i, each[i]);
    close_look(&l);
  }
  for (int ch = 0; ch < CHANNELS; ch++) {
    cell[ch] = (cell_t){.statistic = 0.0};
    for (int i = from; i < to; i++)
      if (each[i][ch].statistic > cell[ch].statistic) cell[ch] = each[i][ch];
  }
  return good ? DONE : error_failed(why, "out of memory");
}

// --- all looks --------------------------------------------------------------------------------------------

static void look_everywhere(const look_t *l, scan_t *scan) {
  for (int look = 0; look < UNKNOWN_LOOKS; look++) {
    cell_t each[LOOKED] = {{.statistic = 0.0}};
    if (look < COORDINATES) windows_along(l, look, each);
    if (look == LOOK_FLOOR) windows_on_floor(l, each);
    if (look == LOOK_FLIGHTS) windows_by_flight(l, each);
    if (look == LOOK_PULSE) in_time_pulses(l, each);
    if (look == LOOK_LINE) in_time_lines(l, each);
    for (int ch = 0; ch < LOOKED; ch++) {
      const bool world = ch >= CHANNELS;
      each[ch].channel = world ? ch - CHANNELS : ch;
      each[ch].world = world;
      scan->cell[unknown_cell(each[ch].channel, look, world)] = each[ch];
    }
  }
}

static void add_world(look_t *l, const color_t *color, double *const turned[CHANNELS]) {
  turn_by_heading(l->s, 1.0, l->residual[CH_FX], l->residual[CH_FY], turned[CH_FX], turned[CH_FY]);
  for (int ch = 0; ch < CH_FZ; ch++) {
    l->residual[CHANNELS + ch] = turned[ch];
    l->color[CHANNELS + ch] = color[ch];
  }
}

done_t unknown_scan(const set_t *s, const model_t *m, double *const residual[CHANNELS], scan_t *scan,
                    why_t *why) {
  color_t color[CHANNELS], world[CHANNELS];
  lines_t turned;
  const bool level = has_lateral_force(s);
  *scan = (scan_t){.cell = {{.statistic = 0.0}}};
  TRY(find_colors(s, m, residual, color, level ? world : NULL, why));
  look_t l = look_of(s, m, residual, color, true);
  done_t status = lines_make(&turned, s, why);
  if (status == DONE) status = open_look(&l, why);
  if (status == DONE && level) add_world(&l, world, turned.r);
  if (status == DONE) look_everywhere(&l, scan);
  close_look(&l);
  lines_free(&turned);
  return status;
}

double unknown_in_windows(const scan_t *scan) {
  double most = 0.0;
  for (int i = 0; i < UNKNOWN_CELLS; i++)
    if (i % UNKNOWN_LOOKS < COORDINATES) most = fmax(most, scan->cell[i].statistic);
  return most;
}

// --- what is beyond nominal flights -----------------------------------------------------------------------

// Returns the largest statistic that noise alone gives in all windows of a coordinate.
static double of_noise(void) {
  return limits_noise(WINDOWS_TRIED);
}

// Returns the rms of what a look finds in the nominal flights but number `but` (< 0: in all), and in one
// flight of noise alone.
static double usual(const scan_t *nominal, int n, int but, int cell) {
  double squares = of_noise() * of_noise();
  int flights = 1;
  for (int i = 0; i < n; i++) {
    if (i == but) continue;
    squares += nominal[i].cell[cell].statistic * nominal[i].cell[cell].statistic;
    flights++;
  }
  return sqrt(squares / flights);
}

// Returns the bound of a cell's statistic: chance, and an error of the model, which nominal flights do not
// have: a right form with other numbers. The error counts as much of the channel's largest effect as an
// effect must be to be named (SELECT_LEAST). It is as wide in the spectrum as the flight's manoeuvres; a
// line is narrow.
static double bound_of(const cell_t *c, double chance, const double misfit[CHANNELS]) {
  const double left = misfit[c->channel] / sqrt(c->spreads > 1 ? c->spreads : 1);
  const double share = c->size != 0.0 ? left * c->statistic / c->size : 0.0;
  return hypot(chance, SELECT_LEAST / CANDIDATES_MISFIT * share);
}

// Returns what a cell explains beyond what it would at its bound; -HUGE_VAL: nothing could be judged.
static double beyond(const cell_t *c, double bound) {
  return c->statistic > 0.0 ? c->explained * (1.0 - bound * bound / (c->statistic * c->statistic))
                            : -HUGE_VAL;
}

// Returns the rank in a tie, lowest first: flights, a place, a time, a state. Flights that are flown
// elsewhere differ by place, too, and something at a place is rarer than something fitted anew between
// flights. What lies at a place stays there; what begins at the same time in every flight is rarer; a state
// is mostly one that the vehicle happened to be in there.
static int rank_of(int along) {
  if (along == BY_FLIGHT) return -1;
  return along == COORDINATE_TIME || along == NOWHERE ? 1 : coordinate_is_place(along) ? 0 : 2;
}

// True if both cells are of one force: the lateral force shows in other channels in the world's axes than in
// the body's.
static bool of_one_force(const cell_t *a, const cell_t *b) {
  return a->world == b->world ? a->channel == b->channel : a->channel < CH_FZ && b->channel < CH_FZ;
}

static bool goes_before(const cell_t *a, const cell_t *b) {
  const int first = rank_of(a->along), second = rank_of(b->along);
  return first != second ? first < second : a->explained > b->explained;
}

// Chooses, of the cells that explain at least UNKNOWN_TIE of the best, the one that is told first and, along
// something else, the one that explains most. A place needs this margin: it is known to some centimetres,
// and what lies there begins and ends some rows beside its window; pulses end at the very row.
static void weigh_ties(const scan_t *log, judged_t *to) {
  const cell_t best = to->cell;
  bool tied[UNKNOWN_CELLS];
  for (int k = 0; k < UNKNOWN_CELLS; k++) {
    const cell_t *const c = &log->cell[k];
    tied[k] = beyond(c, to->bound[k]) > 0.0 && of_one_force(c, &best) &&
              c->explained >= UNKNOWN_TIE * best.explained;
    if (!tied[k] || !goes_before(c, &to->cell)) continue;
    to->cell = *c;
    to->cell_bound = to->bound[k];
  }
  for (int k = 0; k < UNKNOWN_CELLS; k++) {
    const cell_t *const c = &log->cell[k];
    if (tied[k] && c->along != to->cell.along && c->explained > to->also.explained) to->also = *c;
  }
}

// Returns the multiple of usual() that no nominal flight exceeds, and chance hardly ever.
static double furthest_of(const scan_t *nominal, int n) {
  double furthest = limits_nominal(n);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < UNKNOWN_CELLS; k++)
      furthest = fmax(furthest, nominal[i].cell[k].statistic / usual(nominal, n, i, k));
  return furthest;
}

void unknown_judge(const scan_t *log, const scan_t *nominal, int n, const double misfit[CHANNELS],
                   judged_t *to) {
  const double furthest = furthest_of(nominal, n);
  double most = -HUGE_VAL;
  *to = (judged_t){.found = false};
  for (int k = 0; k < UNKNOWN_CELLS; k++) {
    const cell_t *const c = &log->cell[k];
    to->chance[k] = furthest * usual(nominal, n, -1, k);
    to->bound[k] = bound_of(c, to->chance[k], misfit);
    if (!(beyond(c, to->bound[k]) > most)) continue;
    most = beyond(c, to->bound[k]);
    to->cell = *c;
    to->cell_bound = to->bound[k];
  }
  to->found = most > 0.0;
  if (to->found) weigh_ties(log, to);
}

// --- how large it is --------------------------------------------------------------------------------------

static bool is_inside(const set_t *s, const model_t *m, const rows_t *r, const cell_t *c, int row) {
  const grid_t *const g = &s->grid[r->flight[row]];
  const double at = coordinate_of(c->along, g, m, r->point[row]);
  if (!(at >= c->from && at <= c->to)) return false;
  const double y_m = c->is_patch ? coordinate_of(COORDINATE_Y, g, m, r->point[row]) : 0.0;
  return !c->is_patch || (y_m >= c->y_from_m && y_m <= c->y_to_m);
}

// Least contrast within flights, over the rows inside: where flights cross the window it is a half at least.
#define CROSSED 0.25

// Takes each flight's mean out of both.
static void within_flights(const rows_t *r, double *x, double *v) {
  for (int from = 0, end; from < r->n; from = end) {
    double x_mean = 0.0, v_mean = 0.0;
    for (end = from; end < r->n && r->flight[end] == r->flight[from]; end++)
      x_mean += x[end], v_mean += v[end];
    x_mean /= end - from, v_mean /= end - from;
    for (int i = from; i < end; i++) x[i] -= x_mean, v[i] -= v_mean;
  }
}

static void regress(const rows_t *r, const double *x, const double *v, int inside, cell_t *cell) {
  double xx = 0.0, xv = 0.0, squares = 0.0;
  for (int i = 0; i < r->n; i++) xx += x[i] * x[i], xv += x[i] * v[i];
  if (!(xx > CROSSED * inside)) return; // flights are inside, or outside: as the look found it
  const double size = xv / xx;
  for (int from = 0, end; from < r->n; from = end) {
    double score = 0.0;
    for (end = from; end < r->n && r->block[end] == r->block[from]; end++)
      score += x[end] * (v[end] - size * x[end]);
    squares += score * score;
  }
  cell->error = fmax(sqrt(squares) / xx, fabs(cell->size) / cell->statistic); // few blocks say too little
  cell->size = size;
}

done_t unknown_measure(const set_t *s, const model_t *m, double *const residual[CHANNELS], cell_t *cell,
                       why_t *why) {
  if (!(cell->statistic > 0.0) || cell->along < 0 || cell->along >= COORDINATES || cell->is_pulse)
    return DONE;
  const rows_t *const r = set_rows(s, cell->channel);
  lines_t v;
  double *const x = malloc(set_most_rows(s) * sizeof(double));
  done_t status = copy_of(s, residual, &v, why);
  if (!x) status = error_failed(why, "out of memory");
  if (status == DONE) {
    if (cell->world) turn_by_heading(s, 1.0, v.r[CH_FX], v.r[CH_FY], v.r[CH_FX], v.r[CH_FY]);
    int inside = 0;
    for (int i = 0; i < r->n; i++) x[i] = is_inside(s, m, r, cell, i), inside += x[i] > 0.0;
    within_flights(r, x, v.r[cell->channel]);
    regress(r, x, v.r[cell->channel], inside, cell);
  }
  free(x);
  lines_free(&v);
  return status;
}

done_t unknown_differ(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                      const scan_t *nominal, int n, const double misfit[CHANNELS], cell_t cell[CHANNELS],
                      why_t *why) {
  color_t color[CHANNELS];
  cell_t each[LOOKED] = {{.statistic = 0.0}};
  for (int ch = 0; ch < CHANNELS; ch++) cell[ch] = (cell_t){.statistic = 0.0};
  if (s->n_grid < 2) return DONE;
  TRY(find_colors(s, m, residual, color, NULL, why));
  look_t l = look_of(s, m, residual, color, true);
  const done_t status = open_look(&l, why);
  if (status == DONE) windows_by_flight(&l, each);
  close_look(&l);
  const double furthest = furthest_of(nominal, n);
  for (int ch = 0; ch < CHANNELS; ch++) {
    const double chance = furthest * usual(nominal, n, -1, unknown_cell(ch, LOOK_FLIGHTS, false));
    if (beyond(&each[ch], bound_of(&each[ch], chance, misfit)) > 0.0) cell[ch] = each[ch];
  }
  return status;
}

const cell_t *unknown_by_flight(const scan_t *log, const judged_t *judged, int group) {
  const cell_t *most = NULL;
  double others = 0.0;
  for (int k = 0; k < UNKNOWN_CELLS; k++) {
    const cell_t *const c = &log->cell[k];
    if (!(beyond(c, judged->bound[k]) > 0.0) || group_of(c->channel) != group) continue;
    if (c->along != BY_FLIGHT)
      others = fmax(others, c->explained);
    else if (!most || c->explained > most->explained)
      most = c;
  }
  return most && most->explained >= UNKNOWN_TIE * others ? most : NULL;
}
