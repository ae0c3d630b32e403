// candidates.c - the effects that the model lacks, or has with other numbers.
#include "gap/4_candidates/candidates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the list ---------------------------------------------------------------------------------------------

static double slowest_Hz(const set_t *s) {
  double rate_Hz = HUGE_VAL;
  for (int f = 0; f < s->n_grid; f++) rate_Hz = fmin(rate_Hz, s->grid[f].flight->rate_Hz);
  return rate_Hz;
}

bool candidates_slow(const set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    if (grid_is_slow(&s->grid[f])) return true;
  return false;
}

bool candidates_by_turning(const fx_t *fx, const set_t *s) {
  return fx->scales_thrust && !residual_has(s, CH_FZ);
}

double candidates_least(const fx_t *fx, const set_t *s) {
  const char *const unit = fx->param[fx->size[0].param].unit;
  const bool is_time = unit && strcmp(unit, "s") == 0;
  return is_time ? fmax(fx->size[0].least, 1.0 / slowest_Hz(s)) : 0.0;
}

const char *candidates_obstacle(const fx_t *fx, const model_t *m, const set_t *s) {
  const grid_t *g = &s->grid[0];
  const bool turning = residual_has(s, CH_WX) || residual_has(s, CH_WY) || residual_has(s, CH_WZ);
  const struct {
    int need;
    bool there;
    const char *without;
  } row[] = {
      {FX_NEEDS_CEILING, isfinite(m->ceiling_m), "the vehicle file has no ceiling"},
      {FX_NEEDS_WALL, isfinite(m->wall_y_m), "the vehicle file has no wall"},
      {FX_NEEDS_POSITION, g->has_position, "the log has no position"},
      {FX_NEEDS_RANGE, residual_has(s, CH_RANGE), "the log has no range sensor's samples"},
      {FX_NEEDS_VOLTAGE, g->has_vbat, "the log has no battery voltage"},
      {FX_NEEDS_VELOCITY, g->has_velocity, "the log has no velocity"},
      {FX_NEEDS_ACCELERATION, g->has_force && !g->acceleration_made, "the log has no acceleration"},
      {FX_NEEDS_ATTITUDE, g->has_attitude, "the log has no attitude"},
      {FX_NEEDS_TURNING, turning, "no turning is compared"},
  };
  if (fx->n_size == 0) return "it has no numbers that could be estimated";
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    if ((fx->needs & row[i].need) && !row[i].there) return row[i].without;
  if (!(fx->needs & FX_NEEDS_RANGE) && !residual_has(s, CH_FX) && !turning)
    return "the log has neither acceleration nor rates";
  return NULL;
}

// Returns the nominal value, or that of the first size that has one, or the step; never 0.
static double typical_of(const fx_use_t *use, int k) {
  int n;
  const fx_param_t *param = fx_use_params(use, &n);
  const fx_size_t *size = use->fx->size;
  double typical = fabs(param[size[k].param].nominal);
  for (int i = 0; i < use->fx->n_size && typical == 0.0; i++) typical = fabs(param[size[i].param].nominal);
  return typical > 0.0 ? typical : size[k].step;
}

// Radii from a surface at which all decays of typical size do the same. Otherwise a slow decay of typical
// size would act far off, where nothing does, and a quick one would do nothing.
// gap_takes_decays_of_typical_size_as_equally_strong_one_radius_off holds it.
#define TYPICAL_RADII 1.0

static double by_cell(const candidates_t *c, const fx_t *fx) {
  return fx->shape_by_cell ? c->cells : 1.0;
}

static double as_strong(const fx_use_t *use, double radius_m) {
  const double gap_m = TYPICAL_RADII * radius_m;
  const fx_place_t place = {gap_m, gap_m, radius_m};
  fx_use_t typical = fx_use(use->fx), here = *use;
  if (!use->fx->excess || !fx_use_has_shape(use)) return 1.0;
  fx_use_resize(&here, 0, typical_of(use, 0));
  return use->fx->excess(&typical, &place) / use->fx->excess(&here, &place);
}

typedef struct {
  int from, to; // of an effect's numbers: the first, and behind the last
} numbers_t;

// V, about the middle of a flight: by the mean of what is logged, packs of up to six cells are counted right
// from 3.6 V a cell to full.
#define CELL_V 3.9

static double cells_of(const set_t *s) {
  double sum_V = 0.0, points = 0.0;
  for (int f = 0; f < s->n_grid; f++)
    for (int i = 0; i < s->grid[f].n; i++) {
      const double here_V = s->grid[f].point[i].vbat_V;
      if (!isfinite(here_V)) continue;
      sum_V += here_V;
      points += 1.0;
    }
  return points > 0.0 ? fmax(1.0, round(sum_V / points / CELL_V)) : 1.0;
}

// Adds an effect in the form, shape and kind of `use`.
static candidate_t *add(candidates_t *c, const fx_use_t *use, const model_t *m, numbers_t of) {
  const fx_t *const fx = use->fx;
  candidate_t *const to = &c->candidate[c->n++];
  const double *shape;
  *to = (candidate_t){.use = *use, .first = c->columns, .n = fx->n_size, .from = of.from, .to = of.to};
  for (int k = 0; k < fx->n_size; k++) {
    const int param = fx->size[k].param;
    const double grows = model_grows(m, fx->size[k].grows);
    to->typical[k] = grows * typical_of(&to->use, k);
    to->step[k] = grows * fx->size[k].step;
    to->use.p[param] = 0.0;
    to->least[k] = fx->size[k].sign > 0 ? 0.0 : model_fx_least(m, &to->use, param);
  }
  if (fx->needs & FX_NEEDS_WALL) to->use.p[0] = m->wall_y_m;
  to->n_shape = fx_use_shapes(use, &shape);
  for (int i = 0; i < to->n_shape; i++) to->shape[i] = shape[i] * by_cell(c, fx);
  const double strong = as_strong(&to->use, m->rotor_radius_m);
  for (int k = 0; k < fx->n_size; k++) to->typical[k] *= strong;
  c->columns += to->n;
  return to;
}

// Adds an effect that the file has, but no lag or delay: which of these there is, is another question.
static void add_difference(candidates_t *c, const model_t *m, const fx_use_t *own, numbers_t of) {
  int n;
  const fx_param_t *const param = fx_use_params(own, &n);
  const fx_t *const fx = own->fx;
  // In other forms the first number is no factor of what the effect does.
  if (own->form && !own->form->needs_points && own->form->n_shape == 0) return;
  if (fx->group == FX_TIMING) return;
  candidate_t *const to = add(c, own, m, of);
  to->use = *own;
  to->in_file = true;
  for (int k = 0; k < fx->n_size; k++) {
    to->typical[k] = model_grows(m, fx->size[k].grows) * typical_of(own, k);
    to->least[k] = (fx->size[k].sign > 0 ? 0.0 : param[fx->size[k].param].min) - fx_use_size(own, k);
    fx_use_resize(&to->use, k, 0.0);
  }
}

// Adds every shape of the form of `use`, each in every kind that the effect's first numbers have.
static void add_shapes(candidates_t *c, const model_t *m, fx_use_t use, numbers_t of) {
  const fx_t *const fx = use.fx;
  const double *shape;
  const int shapes = fx_use_shapes(&use, &shape);
  const int kinds = of.from > 0 ? 1 : fx->n_kind;
  for (int kind = 0; kind == 0 || kind < kinds; kind++)
    for (int i = 0; i == 0 || i < shapes; i++) {
      if (shapes) use.p[fx->shape_param] = shape[i] * by_cell(c, fx);
      if (fx->n_kind) use.p[fx_use_kind(&use)] = fx->kind[kind];
      (void)add(c, &use, m, of);
    }
}

static void add_variants(candidates_t *c, const model_t *m, const fx_t *fx, numbers_t of) {
  const fx_use_t *const own = model_fx(m, fx);
  fx_use_t use = fx_use(fx);
  if (own)
    add_difference(c, m, own, of);
  else
    add_shapes(c, m, use, of);
  for (int i = 0; !own && i < curve_count; i++) {
    if (!(curve_table[i]->surfaces & fx->surface) || !curve_table[i]->n_shape) continue;
    if (curve_table[i] == use.form) continue;
    fx_use_form(&use, curve_table[i]);
    add_shapes(c, m, use, of);
  }
}

done_t candidates_make(candidates_t *c, const model_t *m, const set_t *s, why_t *why) {
  *c = (candidates_t){.candidate = calloc((size_t)((fx_count + 2 * curve_count) * FX_SHAPE_MAX * FX_KIND_MAX),
                                          sizeof(candidate_t))};
  if (!c->candidate) return error_failed(why, "out of memory");
  c->cells = cells_of(s);
  for (int i = 0; i < fx_count; i++) {
    const fx_t *const fx = fx_table[i];
    if (candidates_obstacle(fx, m, s)) continue;
    if (fx->size_apart) add_variants(c, m, fx, (numbers_t){0, fx->size_apart});
    add_variants(c, m, fx, (numbers_t){fx->size_apart, fx->n_size});
  }
  return DONE;
}

void candidates_free(candidates_t *c) {
  free(c->candidate);
  *c = (candidates_t){.n = 0};
}

bool candidates_exclude(const candidate_t *a, const candidate_t *b) {
  return a->use.fx == b->use.fx && a->from == b->from;
}

const char *candidate_name(const candidate_t *c) {
  return c->from > 0 ? c->use.fx->apart_name : c->use.fx->name;
}

int candidates_of(const candidates_t *c, int candidate) {
  int n = 0;
  for (int i = 0; i < c->n; i++) n += candidates_exclude(&c->candidate[i], &c->candidate[candidate]);
  return n;
}

bool candidate_is_numbered(const candidate_t *c) {
  int n;
  const fx_t *const fx = c->use.fx;
  return c->n_shape > 1 && fx_is_number(&fx_use_params(&c->use, &n)[fx->shape_param]);
}

void candidates_bar(candidates_t *c, int candidate) {
  const candidate_t *const own = &c->candidate[candidate];
  const bool alone = candidate_is_numbered(own);
  for (int i = 0; i < c->n; i++)
    if (i == candidate || (!alone && candidates_exclude(&c->candidate[i], own)))
      c->candidate[i].barred = true;
}

void candidates_reshape(candidates_t *c, const chosen_t *chosen) {
  for (int i = 0; i < chosen->n; i++) {
    const fx_t *const fx = chosen->use[i].fx;
    if (c->candidate[chosen->of[i]].n_shape)
      c->candidate[chosen->of[i]].use.p[fx->shape_param] = fx_use_shape(&chosen->use[i]);
  }
}

// --- what is chosen ---------------------------------------------------------------------------------------

// Returns the candidate's place among the chosen, or the one that it would have.
static int place_of(const chosen_t *chosen, int candidate) {
  int i = 0;
  while (i < chosen->n && chosen->of[i] < candidate) i++;
  return i;
}

const fx_use_t *chosen_use(const chosen_t *chosen, int candidate) {
  const int at = place_of(chosen, candidate);
  return at < chosen->n && chosen->of[at] == candidate ? &chosen->use[at] : NULL;
}

fx_use_t *chosen_take(chosen_t *chosen, const candidates_t *c, int candidate) {
  const int at = place_of(chosen, candidate);
  if (at < chosen->n && chosen->of[at] == candidate) return &chosen->use[at];
  for (int i = chosen->n++; i > at; i--) {
    chosen->of[i] = chosen->of[i - 1];
    chosen->use[i] = chosen->use[i - 1];
  }
  chosen->of[at] = candidate;
  chosen->use[at] = c->candidate[candidate].use;
  return &chosen->use[at];
}

void chosen_drop(chosen_t *chosen, int candidate) {
  if (!chosen_use(chosen, candidate)) return;
  chosen->n--;
  for (int i = place_of(chosen, candidate); i < chosen->n; i++) {
    chosen->of[i] = chosen->of[i + 1];
    chosen->use[i] = chosen->use[i + 1];
  }
}

// Share of the way to another shape, lag or delay: farther off, columns about the old one do not serve.
#define MOVED 0.1

// Returns a shape, a lag or a delay, which linear columns about a model do not show; NaN: it has none. far:
// the distance to another one, for a lag the lag itself, for a shape that to the next one tried.
static double bent_by(const candidate_t *c, const fx_use_t *use, double *far) {
  *far = (double)NAN;
  const fx_t *const fx = use ? use->fx : NULL;
  if (fx && fx->group == FX_TIMING) {
    *far = fabs(fx_use_size(use, 0));
    return fx_use_size(use, 0);
  }
  if (!fx || c->n_shape < 2) return (double)NAN;
  const double shape = fx_use_shape(use);
  int next = 1;
  while (next < c->n_shape - 1 && c->shape[next] < shape) next++;
  *far = c->shape[next] - c->shape[next - 1];
  return shape;
}

static bool moved(const candidates_t *c, const chosen_t *a, const chosen_t *b) {
  for (int i = 0; i < a->n; i++) {
    const candidate_t *const own = &c->candidate[a->of[i]];
    double far, other;
    const double here = bent_by(own, &a->use[i], &far), there = bent_by(own, chosen_use(b, a->of[i]), &other);
    if (isfinite(here) && !(fabs(here - there) < MOVED * far)) return true;
  }
  return false;
}

// True if something was flown that is not found again: the first look took noise for it, which hides what is
// there.
static bool gone(const chosen_t *flown, const chosen_t *found) {
  for (int i = 0; i < flown->n; i++)
    if (!chosen_use(found, flown->of[i])) return true;
  return false;
}

bool chosen_other(const candidates_t *c, const chosen_t *flown, const chosen_t *found) {
  return moved(c, found, flown) || moved(c, flown, found) || gone(flown, found);
}

done_t candidates_chosen(candidates_t *names, chosen_t *own, const candidates_t *all, const chosen_t *chosen,
                         why_t *why) {
  *own = *chosen;
  *names = (candidates_t){.candidate = calloc(CHOSEN_MAX, sizeof(candidate_t)), .cells = all->cells};
  if (!names->candidate) return error_failed(why, "out of memory");
  for (int i = 0; i < chosen->n; i++) {
    candidate_t *const to = &names->candidate[names->n];
    *to = all->candidate[chosen->of[i]];
    to->first = names->columns;
    own->of[i] = names->n++;
    names->columns += to->n;
  }
  return DONE;
}

double candidate_possible(const candidate_t *c, int k, double value) {
  int n;
  const fx_param_t *param = &fx_use_params(&c->use, &n)[c->use.fx->size[k].param];
  return fmin(fmax(value, c->least[k]), param->max);
}

// True if only numbers are there that are a candidate of their own: these have no kinds.
static bool is_apart(const fx_use_t *use) {
  bool others = false;
  for (int k = 0; k < use->fx->size_apart; k++) others = others || fx_use_size(use, k) != 0.0;
  return use->fx->size_apart && !others;
}

fx_use_t effect_whole(const model_t *base, const fx_use_t *use) {
  const fx_use_t *const own = model_fx(base, use->fx);
  fx_use_t whole = own && is_apart(use) ? *own : *use;
  for (int k = 0; own && k < use->fx->n_size; k++)
    fx_use_resize(&whole, k, fx_use_size(own, k) + fx_use_size(use, k));
  return whole;
}

done_t chosen_model(const chosen_t *chosen, const model_t *base, model_t *m, why_t *why) {
  *m = *base;
  for (int i = 0; i < chosen->n; i++) {
    const fx_use_t whole = effect_whole(m, &chosen->use[i]); // some of its numbers may be in it already
    TRY(model_add_fx(m, &whole, why));
  }
  return DONE;
}
