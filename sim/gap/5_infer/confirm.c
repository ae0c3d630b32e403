// confirm.c - estimates the names again, with the reference trajectory as instrument.
#include "gap/5_infer/confirm.h"

#include "base/lsq_blocks.h"
#include "base/lsq_instrument.h"
#include "gap/2_predict/grid.h"
#include <math.h>
#include <stdlib.h>

// Lags: the quiet flight itself, and earlier and later by as much as rows resolve. Forces, turning and range
// have instruments of their own for each column.
enum { LAGS = 3, INSTRUMENTS = LAGS * GROUPS };

typedef struct {
  candidates_t names; // only those in the model
  chosen_t chosen;    // the same, by their numbers in `names`
  const int *of;      // their numbers among all candidates
  set_t *s;
  const model_t *base;
  model_t now; // the base with the names
  const closed_loop_t *loop;
  gram_t plain;   // of the names as they were found, in smoothed velocities
  design_t table; // columns of names and instruments, and the residual; velocities as logged
} confirming_t;

// --- the flight along the reference -----------------------------------------------------------------------

static closed_loop_t quiet(const closed_loop_t *w) {
  closed_loop_t q = {.tilt_gain = w->tilt_gain,
                     .climb_gain = w->climb_gain,
                     .height_gain = w->height_gain,
                     .flown_by = w->flown_by};
  for (int i = 0; i < 3; i++) q.rate_gain[i] = w->rate_gain[i];
  return q;
}

// first: the point of the track at which the flight begins.
static done_t fly_quietly(const confirming_t *t, int flight, gap_flight_t *flown, int *first, bool *flew,
                          why_t *why) {
  const grid_t *g = &t->s->grid[flight];
  const closed_loop_t loop = quiet(t->loop);
  model_t room = t->now;
  room.ceiling_m =
      HUGE_VAL; // without a disturbance the model touches nothing that the logged vehicle did not touch
  grid_t track;
  TRY(set_points_track(g, &track, why));
  for (*first = 0; *first < g->n && !g->point[*first].ok;) ++*first;
  why_t lost;
  const done_t status = nominal_fly(&track, &room, &loop, 1, flown, NULL, &lost);
  *flew = status == DONE;
  free(track.point);
  return status == FAILED ? error_failed(why, "%s", lost.text) : DONE;
}

// --- columns ----------------------------------------------------------------------------------------------

typedef struct {
  double *base[CHANNELS], *with[CHANNELS], *series[CHANNELS], *scratch, *room;
} replay_room_t;

static bool replay_room(replay_room_t *r, size_t n) {
  r->room = calloc((3 * CHANNELS + RESIDUAL_SCRATCH) * (n + 1), sizeof(double));
  for (size_t ch = 0; r->room && ch < CHANNELS; ch++) {
    r->base[ch] = r->room + ch * (n + 1);
    r->with[ch] = r->room + (CHANNELS + ch) * (n + 1);
    r->series[ch] = r->room + (2 * CHANNELS + ch) * (n + 1);
  }
  r->scratch = r->room ? r->room + 3 * CHANNELS * (n + 1) : NULL;
  return r->room != NULL;
}

// The quiet flight's series at the log's points, `lag` points later; before and after it its nearest value.
static void shift(const grid_t *log, const grid_t *quiet, int first, int lag, const double *from,
                  double *to) {
  for (int j = 0; j < log->n; j++) {
    const int k = j - first - lag;
    to[j] = quiet->n ? from[k < 0 ? 0 : k < quiet->n ? k : quiet->n - 1] : 0.0;
  }
}

static double **instrument(confirming_t *t, int channel, int column, int lag) {
  return &t->table.x[channel][t->names.columns + INSTRUMENTS * column + LAGS * group_of(channel) + lag];
}

static done_t put_instruments(confirming_t *t, int flight, grid_t *quiet, int first, replay_room_t *r,
                              int column, why_t *why) {
  const grid_t *g = &t->s->grid[flight];
  const int step = (int)fmax(1.0, round(FILTER_ROWS / RESIDUAL_HZ / g->period_s));
  for (int l = 0; l < LAGS; l++) {
    double *row[CHANNELS] = {NULL};
    for (int ch = 0; ch < CHANNELS; ch++) {
      if (!t->table.x[ch][column]) continue; // the name does not show there
      double **const to = instrument(t, ch, column, l);
      if (!*to) *to = calloc((size_t)set_rows(t->s, ch)->n + 1, sizeof(double));
      if (!*to) return error_failed(why, "out of memory");
      row[ch] = *to;
      shift(g, quiet, first, (l - LAGS / 2) * step, r->with[ch], r->series[ch]);
    }
    residual_rows(t->s, flight, SERIES_PREDICTED, (const double *const *)r->series, r->scratch, row);
  }
  return DONE;
}

static done_t put_flight(confirming_t *t, int flight, grid_t *quiet, int first, why_t *why) {
  const grid_t *g = &t->s->grid[flight];
  replay_room_t r;
  path_t path;
  if (!replay_room(&r, (size_t)(g->n > quiet->n ? g->n : quiet->n)))
    return error_failed(why, "out of memory");
  done_t status = replay_keep(quiet, &t->now, &path, r.base, why);
  for (int i = 0; i < t->names.n; i++)
    for (int k = t->names.candidate[i].from; k < t->names.candidate[i].to && status == DONE; k++) {
      const candidate_t *const own = &t->names.candidate[i];
      const int column = own->first + k;
      const fx_use_t *const whole = model_fx(&t->now, own->use.fx);
      status = column_differentiate(quiet, &path, whole, k, own->step[k], r.base, r.with, why);
      if (status == DONE) status = put_instruments(t, flight, quiet, first, &r, column, why);
    }
  path_free(&path);
  free(r.room);
  return status;
}

static done_t make_instruments(confirming_t *t, bool *flew, why_t *why) {
  *flew = true;
  for (int f = 0; f < t->s->n_grid && *flew; f++) {
    gap_flight_t flown;
    grid_t quiet = {.n = 0};
    int first;
    TRY(fly_quietly(t, f, &flown, &first, flew, why));
    if (!*flew) break;
    done_t status = grid_make(&quiet, &flown, 0, flown.n, t->base, why);
    if (status == DONE) status = put_flight(t, f, &quiet, first, why);
    grid_free(&quiet);
    gap_flight_free(&flown);
    TRY(status);
  }
  return DONE;
}

static done_t make_table(confirming_t *t, why_t *why) {
  design_t names;
  TRY(design_make(&names, t->s, t->base, &t->names, &t->chosen, why));
  const int n = names.columns;
  t->table = (design_t){.columns = n * (1 + INSTRUMENTS)};
  bool good = true;
  for (int ch = 0; ch < CHANNELS; ch++) {
    double **const x = t->table.x[ch] = calloc((size_t)t->table.columns + 1, sizeof *x);
    good = good && x;
    for (int i = 0; x && i <= n; i++) {
      x[i < n ? i : t->table.columns] = names.x[ch][i];
      names.x[ch][i] = NULL;
    }
  }
  design_free(&names);
  return good ? DONE : error_failed(why, "out of memory");
}

// --- the answer -------------------------------------------------------------------------------------------

// Sets at[] to the columns of the sizes that the compared channels show; returns how many.
static int shown_of(const candidate_t *c, const named_t *named, int at[FX_SIZE_MAX]) {
  int n = 0;
  for (int k = 0; k < c->n; k++)
    if (named->stderr_[k] > 0.0) at[n++] = c->first + k;
  return n;
}

static bool right_sign(const candidate_t *c, const confirm_t *a) {
  for (int k = 0; k < c->n; k++)
    if (a->stderr_[k] > 0.0 && c->use.fx->size[k].sign > 0 &&
        a->value[k] + score_margin(c, a->stderr_[k]) <= c->least[k])
      return false;
  return true;
}

static double wald_p(const double *v, const double *V, const int *at, int n, int all, double blocks) {
  double own[FX_SIZE_MAX * FX_SIZE_MAX];
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) own[i * n + k] = V[at[i] * all + at[k]];
  return lsq_f_above(lsq_wald(v, own, n) / n, n, blocks);
}

typedef struct {
  double plain[COLUMN_MAX], b[COLUMN_MAX], F[COLUMN_MAX], blocks[COLUMN_MAX];
  double V[COLUMN_MAX * COLUMN_MAX], apart[COLUMN_MAX * COLUMN_MAX];
} fit_t;

static void answer(const candidate_t *c, const fit_t *f, int all, named_t *named) {
  confirm_t *const a = &named->confirm;
  double found[FX_SIZE_MAX], differ[FX_SIZE_MAX];
  int at[FX_SIZE_MAX];
  bool beyond = false;
  const int n = shown_of(c, named, at);
  *a = (confirm_t){.answer = CONFIRM_WEAK, .F = HUGE_VAL, .blocks = HUGE_VAL};
  for (int i = 0; i < n; i++) a->F = fmin(a->F, f->F[at[i]]);
  if (!(a->F >= CONFIRM_F)) return;
  for (int i = 0; i < n; i++) a->blocks = fmin(a->blocks, f->blocks[at[i]]);
  a->blocks = fmax(a->blocks, n + 2.0);
  const double free = a->blocks - n; // degrees of freedom
  for (int i = 0; i < n; i++) {
    const int k = at[i] - c->first;
    a->value[k] = found[i] = f->b[at[i]];
    a->stderr_[k] = sqrt(f->V[at[i] * (all + 1)]);
    differ[i] = f->b[at[i]] - f->plain[at[i]];
    // A smaller difference does not matter, however sure: the name's own error already holds it.
    beyond = beyond || fabs(differ[i]) > hypot(a->stderr_[k], named->stderr_[k]);
  }
  a->p = wald_p(found, f->V, at, n, all, free);
  a->p_apart = wald_p(differ, f->apart, at, n, all, free);
  a->apart = beyond && a->p_apart < SELECT_ALPHA;
  a->answer = a->p < SELECT_ALPHA && right_sign(c, a) ? CONFIRM_YES : CONFIRM_NO;
}

// Gives an all-zero column a unit diagonal, orthogonal to all others, so that the others can be solved for.
static void set_apart(gram_t *g, int n) {
  for (int i = 0; i < n; i++) {
    const int diagonal = i * (g->size + 1);
    if (!gram_shows(g, i)) g->total[diagonal] = g->block[diagonal] = 1.0;
  }
}

// Whitens by the colours of what the names leave.
static done_t take_products(const confirming_t *t, const design_t *table, gram_t *g, why_t *why) {
  int column[COLUMN_MAX];
  double value[COLUMN_MAX];
  const int n = t->names.columns;
  for (int i = 0; i < t->names.n; i++)
    for (int k = 0; k < t->names.candidate[i].n; k++) {
      column[t->names.candidate[i].first + k] = t->names.candidate[i].first + k;
      value[t->names.candidate[i].first + k] = fx_use_size(&t->chosen.use[i], k);
    }
  const explained_t known = {n, column, value, false, NULL};
  TRY(gram_make(g, t->s, table, &known, NULL, why));
  set_apart(g, n);
  return DONE;
}

static done_t make_plain(confirming_t *t, why_t *why) {
  design_t names;
  TRY(design_make(&names, t->s, t->base, &t->names, &t->chosen, why));
  const done_t status = take_products(t, &names, &t->plain, why);
  design_free(&names);
  return status;
}

static done_t ask_instruments(const confirming_t *t, found_t *found, why_t *why) {
  gram_t g;
  const int n = t->names.columns;
  TRY(take_products(t, &t->table, &g, why));
  fit_t *const f = malloc(sizeof *f);
  const lsq_instrument_t job = {g.total,   g.block,        g.n_block,     n, GROUPS, LAGS,
                                CONFIRM_F, t->plain.total, t->plain.block};
  const bool good =
      f && lsq_instrument(&job, &(lsq_instrumented_t){f->plain, f->b, f->F, f->blocks, f->V, f->apart});
  for (int i = 0; i < found->n; i++)
    for (int k = 0; k < t->names.n; k++) {
      if (t->of[k] != found->named[i].candidate) continue;
      found->named[i].confirm = (confirm_t){.answer = CONFIRM_WEAK};
      if (good) answer(&t->names.candidate[k], f, n, &found->named[i]);
    }
  const done_t status = f ? DONE : error_failed(why, "out of memory");
  free(f);
  gram_free(&g);
  return status;
}

// --- the whole --------------------------------------------------------------------------------------------

static done_t take_names(confirming_t *t, const candidates_t *c, const chosen_t *chosen, why_t *why) {
  t->of = chosen->of;
  TRY(candidates_chosen(&t->names, &t->chosen, c, chosen, why));
  return chosen_model(chosen, t->base, &t->now, why);
}

static bool all_have_set_points(const set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    if (!set_points_there(&s->grid[f])) return false;
  return s->n_grid > 0;
}

// Swaps smoothed and logged velocities; called again it swaps them back, and meanwhile `seen` are the
// smoothed ones. Errors of velocities do not bias an instrumented fit. With smoothed velocities it finds a
// fifth too much, because smoothing takes away part of the motion.
static void swap_speeds(set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    for (int j = 0; j < s->grid[f].n; j++) {
      grid_point_t *const p = &s->grid[f].point[j];
      const d3_t smooth = p->vel_w_mps;
      p->vel_w_mps = p->seen_w_mps;
      p->seen_w_mps = smooth;
    }
}

done_t confirm_names(const candidates_t *c, set_t *s, const model_t *base, const closed_loop_t *loop,
                     found_t *found, const char **why_not, why_t *why) {
  confirming_t t = {.s = s, .base = base, .loop = loop, .plain = {.size = 0}};
  bool flew = false;
  *why_not = NULL;
  if (found->n == 0 || !all_have_set_points(s)) return DONE;
  done_t status = take_names(&t, c, &found->chosen, why);
  if (status == DONE) status = make_plain(&t, why);
  swap_speeds(s);
  if (status == DONE) status = make_table(&t, why);
  if (status == DONE) status = make_instruments(&t, &flew, why);
  if (status == DONE && flew) status = ask_instruments(&t, found, why);
  swap_speeds(s);
  if (status == DONE && !flew) *why_not = "the model cannot be flown along the logged set points";
  gram_free(&t.plain);
  design_free(&t.table);
  candidates_free(&t.names);
  return status;
}
