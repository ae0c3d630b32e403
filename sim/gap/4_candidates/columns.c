// columns.c - the columns of the candidates.
#include "gap/4_candidates/candidates.h"

#include "base/wide.h"
#include "gap/2_predict/lines.h"
#include "gap/2_predict/predict.h"
#include <math.h>
#include <stdlib.h>

// Share of the typical size of a chosen number: if it changes by less, the columns of the others stay. So
// much changes them by some hundredths, but for a displaced centre of mass and a weak rotor, which turn the
// vehicle in the mean, by a fifth.
#define STAYS 0.25

// Replaces `with` by the difference quotient; 0 where it is not finite.
WIDE_COPIES static void differ(int n, const double *base, double step, double *with) {
  for (int j = 0; j < n; j++) {
    const double d = (with[j] - base[j]) / step;
    with[j] = fabs(d) < HUGE_VAL ? d : 0.0;
  }
}

done_t column_differentiate(grid_t *g, const path_t *now, const fx_use_t *use, int k, double step,
                            double *const base[CHANNELS], double *const with[CHANNELS], why_t *why) {
  fx_use_t more = *use;
  fx_use_resize(&more, k, fx_use_size(use, k) + step);
  TRY(replay_with(g, now, &more, with, why));
  for (int ch = 0; ch < CHANNELS; ch++) differ(g->n, base[ch], step, with[ch]);
  return DONE;
}

static bool all_zero(const double *v, int n) {
  for (int j = 0; j < n; j++)
    if (v[j] != 0.0) return false;
  return true;
}

static done_t fill_column(design_t *t, const set_t *s, int flight, int column, const flight_lines_t *l) {
  double *row[CHANNELS] = {NULL};
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (!residual_has(s, ch) || all_zero(l->with[ch], s->grid[flight].n)) continue;
    if (!t->x[ch][column]) t->x[ch][column] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    if (!t->x[ch][column]) return FAILED;
    row[ch] = t->x[ch][column];
  }
  residual_rows(s, flight, SERIES_PREDICTED, (const double *const *)l->with, l->scratch, row);
  return DONE;
}

// Which columns are formed, and about which model.
typedef struct {
  const candidates_t *c;
  const chosen_t *chosen;
  const model_t *base;
  const bool *wanted; // by candidate
} asked_t;

// Returns the chosen effect of which the candidate is another shape or kind; null: there is none.
static const fx_t *chosen_otherwise(const asked_t *a, int candidate) {
  const candidate_t *const all = a->c->candidate;
  for (int i = 0; i < a->chosen->n; i++)
    if (a->chosen->of[i] != candidate && candidates_exclude(&all[a->chosen->of[i]], &all[candidate]))
      return a->chosen->use[i].fx;
  return NULL;
}

// True if the candidate's column is wanted and starts from the model without `dropped`.
static bool is_asked(const asked_t *a, int candidate, const fx_t *dropped) {
  return a->wanted[candidate] && chosen_otherwise(a, candidate) == dropped;
}

// The columns of one flight that start from one model.
typedef struct {
  design_t *t;
  const set_t *s;
  int flight;
  const path_t *now;
  const asked_t *asked;
  int n, *candidate, *size; // by column: the candidate, and which of its numbers
} column_list_t;

// Lists the columns of the other shapes of `dropped`; null: of what starts from the whole model. False: no
// memory.
static bool columns_list(column_list_t *to, const fx_t *dropped) {
  const candidates_t *const c = to->asked->c;
  to->candidate = malloc(2 * ((size_t)c->columns + 1) * sizeof(int));
  to->size = to->candidate ? to->candidate + c->columns : NULL;
  for (int i = 0; to->candidate && i < c->n; i++)
    for (int k = c->candidate[i].from; is_asked(to->asked, i, dropped) && k < c->candidate[i].to; k++) {
      to->candidate[to->n] = i;
      to->size[to->n++] = k;
    }
  return to->candidate != NULL;
}

static done_t fill_one(const column_list_t *a, int i, grid_t *g, const flight_lines_t *l, why_t *why) {
  const candidate_t *const c = &a->asked->c->candidate[a->candidate[i]];
  const fx_use_t *const own = model_fx(a->now->model, c->use.fx);
  const fx_use_t whole = own ? *own : c->use;
  const int k = a->size[i];
  TRY(column_differentiate(g, a->now, &whole, k, c->step[k], l->base, l->with, why));
  if (fill_column(a->t, a->s, a->flight, c->first + k, l) != DONE) return error_failed(why, "out of memory");
  return DONE;
}

// Of several failures the first in the order of the columns is told, whichever thread met it.
static done_t fill_all(const column_list_t *a, const flight_lines_t *base, why_t *why) {
  done_t status = DONE;
  int failed = a->n;
#pragma omp parallel
  {
    flight_lines_t l;
    grid_t g = grid_lend(&a->s->grid[a->flight]);
    const bool room = flight_lines_beside(&l, a->s, base);
#pragma omp for schedule(dynamic, 1)
    for (int i = 0; i < a->n; i++) {
      why_t own;
      const done_t now = room ? fill_one(a, i, &g, &l, &own) : error_failed(&own, "out of memory");
      if (now == DONE) continue;
#pragma omp critical(columns_failed)
      if (i < failed) failed = i, status = now, *why = own;
    }
    free(l.room);
    grid_give_back(&g);
  }
  return status;
}

// Fills the columns of the candidates that start from this model: all but the other shapes of chosen effects,
// or (dropped) the other shapes of one that the model has no longer.
static done_t fill_columns(design_t *t, const set_t *s, int flight, const path_t *now, const fx_t *dropped,
                           const asked_t *asked, const flight_lines_t *base, why_t *why) {
  column_list_t all = {t, s, flight, now, asked, 0, NULL, NULL};
  const done_t status =
      columns_list(&all, dropped) ? fill_all(&all, base, why) : error_failed(why, "out of memory");
  free(all.candidate);
  return status;
}

// predicted: gets the rows that this model predicts; may be null.
static done_t fill_from(design_t *t, set_t *s, int flight, const model_t *m, const fx_t *dropped,
                        const asked_t *a, flight_lines_t *l, const lines_t *predicted, why_t *why) {
  path_t path;
  done_t status = replay_keep(&s->grid[flight], m, &path, l->base, why);
  if (status == DONE && predicted)
    residual_rows(s, flight, SERIES_PREDICTED, (const double *const *)l->base, l->scratch, predicted->r);
  if (status == DONE) status = fill_columns(t, s, flight, &path, dropped, a, l, why);
  path_free(&path);
  return status;
}

static bool any_is_asked(const asked_t *a, const fx_t *dropped) {
  bool any = false;
  for (int i = 0; i < a->c->n; i++) any = any || is_asked(a, i, dropped);
  return any;
}

static done_t fill_flight(design_t *t, set_t *s, int flight, const model_t *now, const asked_t *a,
                          flight_lines_t *l, const lines_t *predicted, why_t *why) {
  TRY(fill_from(t, s, flight, now, NULL, a, l, predicted, why));
  for (int i = 0; i < a->chosen->n; i++) {
    const fx_t *const fx = a->chosen->use[i].fx;
    if (a->c->candidate[a->chosen->of[i]].in_file || !any_is_asked(a, fx)) continue;
    model_t m = *now;
    model_drop_fx(&m, fx);
    TRY(fill_from(t, s, flight, &m, fx, a, l, NULL, why));
  }
  return DONE;
}

void design_add_chosen(design_t *t, const set_t *s, const candidates_t *c, const chosen_t *chosen,
                       double times) {
  for (int i = 0; i < chosen->n; i++) {
    const candidate_t *const own = &c->candidate[chosen->of[i]];
    for (int k = 0; k < own->n; k++)
      for (int ch = 0; ch < CHANNELS; ch++) {
        const double *x = t->x[ch][own->first + k];
        const double value = times * fx_use_size(&chosen->use[i], k);
        for (int r = 0; x && r < set_rows(s, ch)->n; r++) t->x[ch][t->columns][r] += value * x[r];
      }
  }
}

static bool design_room(design_t *t, const set_t *s, const candidates_t *c) {
  t->chosen = calloc((size_t)c->n + 1, sizeof(bool));
  if (!t->chosen) return false;
  for (int ch = 0; ch < CHANNELS; ch++) {
    t->x[ch] = calloc((size_t)t->columns + 1, sizeof(double *));
    if (!t->x[ch]) return false;
    t->x[ch][t->columns] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    if (!t->x[ch][t->columns]) return false;
  }
  return true;
}

// --- a log that misses commands ---------------------------------------------------------------------------

// Takes out of x what is a multiple of p about its mean.
static void take_out(double *x, const double *p, int n) {
  double sum = 0.0, xp = 0.0, pp = 0.0;
  for (int i = 0; i < n; i++) sum += p[i];
  const double mean = n > 0 ? sum / n : 0.0;
  for (int i = 0; i < n; i++) xp += x[i] * (p[i] - mean), pp += (p[i] - mean) * (p[i] - mean);
  for (int i = 0; i < n && pp > 0.0; i++) x[i] -= xp / pp * (p[i] - mean);
}

// Leaves the scale of the turning out of the columns of bends and slopes of the thrust. A log that misses
// commands does not tell how strongly they turn the vehicle: they seem to turn it too weakly, by as much as
// the log misses, and a large enough bend or slope would be as weak. The forces tell these. Inertia and
// torque, which do nothing but scale, are held both ways against it (5_infer/both_ways.h).
static void leave_out_scales(design_t *t, const set_t *s, const asked_t *a, const lines_t *predicted) {
  for (int i = 0; i < a->c->n; i++) {
    const candidate_t *const c = &a->c->candidate[i];
    if (!a->wanted[i] || !c->use.fx->about_weight) continue;
    for (int ch = CH_WX; ch <= CH_WZ; ch++)
      for (int f = 0; f < s->n_grid && residual_has(s, ch); f++) {
        if (!grid_misses_commands(&s->grid[f])) continue;
        const rows_t *const r = set_rows(s, ch);
        const int from = rows_from(r, f), n = rows_from(r, f + 1) - from;
        for (int k = c->first; k < c->first + c->n; k++)
          if (t->x[ch][k]) take_out(t->x[ch][k] + from, predicted->r[ch] + from, n);
      }
  }
}

// Fills columns that are empty.
static done_t fill(design_t *t, set_t *s, const asked_t *a, flight_lines_t *l, lines_t *predicted,
                   why_t *why) {
  double *r[CHANNELS];
  model_t now;
  TRY(chosen_model(a->chosen, a->base, &now, why));
  TRY(lines_make(predicted, s, why));
  if (!flight_lines_make(l, s)) return error_failed(why, "out of memory");
  for (int ch = 0; ch < CHANNELS; ch++) r[ch] = t->x[ch][t->columns];
  TRY(residual_measured(s, r, why));
  for (int f = 0; f < s->n_grid; f++) TRY(fill_flight(t, s, f, &now, a, l, predicted, why));
  leave_out_scales(t, s, a, predicted);
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int i = 0; i < set_rows(s, ch)->n; i++) r[ch][i] -= predicted->r[ch][i];
  design_add_chosen(t, s, a->c, a->chosen, 1.0); // as the linear columns have them
  return DONE;
}

// Fills columns that are empty: those of some candidates, and the residual. On an error the design is freed.
static done_t fill_design(design_t *t, set_t *s, const asked_t *a, why_t *why) {
  flight_lines_t l = {.room = NULL};
  lines_t predicted = {.r = {NULL}};
  const done_t status = fill(t, s, a, &l, &predicted, why);
  free(l.room);
  lines_free(&predicted);
  for (int i = 0; i < a->c->n; i++)
    if (a->wanted[i]) t->chosen[i] = chosen_use(a->chosen, i) != NULL;
  if (status != DONE) design_free(t);
  return status;
}

static bool *wanted_room(const candidates_t *c, bool wanted) {
  bool *const room = malloc(((size_t)c->n + 1) * sizeof(bool));
  for (int i = 0; room && i < c->n; i++) room[i] = wanted;
  return room;
}

done_t design_make(design_t *t, set_t *s, const model_t *base, const candidates_t *c, const chosen_t *chosen,
                   why_t *why) {
  *t = (design_t){.columns = c->columns, .about = *chosen};
  bool *const all = wanted_room(c, true);
  if (!all || !design_room(t, s, c)) {
    free(all);
    design_free(t);
    return error_failed(why, "out of memory");
  }
  const done_t status = fill_design(t, s, &(asked_t){c, chosen, base, all}, why);
  free(all);
  return status;
}

// True for a force that adds to others and leaves their columns as they are; what changes the vehicle, its
// thrust or what it measures does not.
static bool only_adds(const fx_t *fx) {
  return fx->load && !fx->by_thrust && !fx->excess && !fx->tick && !fx->sense;
}

// True if, from one choice to the other, a number moved by more than `STAYS`, or a shape; what only adds does
// not count.
static bool moved(const candidates_t *c, const chosen_t *from, const chosen_t *to) {
  for (int i = 0; i < from->n; i++) {
    const fx_use_t *const a = &from->use[i], *const b = chosen_use(to, from->of[i]);
    const candidate_t *const own = &c->candidate[from->of[i]];
    if (only_adds(a->fx)) continue;
    if (own->n_shape && b && fx_use_shape(a) != fx_use_shape(b)) return true;
    for (int k = 0; k < own->n; k++)
      if (fabs(fx_use_size(a, k) - (b ? fx_use_size(b, k) : 0.0)) > STAYS * own->typical[k]) return true;
  }
  return false;
}

static void empty_columns(design_t *t, const candidate_t *own) {
  for (int k = own->first; k < own->first + own->n; k++)
    for (int ch = 0; ch < CHANNELS; ch++) {
      free(t->x[ch][k]);
      t->x[ch][k] = NULL;
    }
}

done_t design_renew(design_t *t, set_t *s, const model_t *base, const candidates_t *c, const chosen_t *chosen,
                    bool all, why_t *why) {
  const bool far = all && (moved(c, &t->about, chosen) || moved(c, chosen, &t->about));
  bool *const wanted = wanted_room(c, far);
  if (!wanted) {
    design_free(t);
    return error_failed(why, "out of memory");
  }
  for (int i = 0; i < c->n; i++) {
    wanted[i] = far || chosen_use(chosen, i) || (all && t->chosen[i]);
    if (wanted[i]) empty_columns(t, &c->candidate[i]);
  }
  if (far) t->about = *chosen;
  const done_t status = fill_design(t, s, &(asked_t){c, chosen, base, wanted}, why);
  free(wanted);
  return status;
}

void design_free(design_t *t) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    for (int i = 0; t->x[ch] && i <= t->columns; i++) free(t->x[ch][i]);
    free(t->x[ch]);
    t->x[ch] = NULL;
  }
  free(t->chosen);
  t->chosen = NULL;
}
