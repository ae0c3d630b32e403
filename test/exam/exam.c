// exam.c - the hidden-effect exam.
#include "exam/exam.h"

#include "gap/7_verify/verify.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DRAWS 20 // how often a set whose vehicle cannot fly is drawn anew

exam_kind_t exam_kind(int i) {
  static const exam_kind_t order[] = {EXAM_ONE, EXAM_NOTHING, EXAM_ONE,   EXAM_TWO, EXAM_STRANGE,
                                      EXAM_ONE, EXAM_NOTHING, EXAM_HOVER, EXAM_ONE, EXAM_TWO};
  return order[i % (int)(sizeof order / sizeof *order)];
}

// --- making -----------------------------------------------------------------------------------------------

// True if either name is right for the other: the same, or of one class of which at most one is named.
static bool same(const char *a, const char *b) {
  const fx_t *x = fx_find(a), *y = fx_find(b);
  return x && y && (x == y || (x->group != FX_ALONE && x->group == y->group));
}

static done_t hide(exam_set_t *set, random_t *r, model_t *truth, why_t *why) {
  if (set->kind == EXAM_STRANGE) {
    set->n = 0;
    const int i = (int)random_uniform(r, 0.0, TRUTH_STRANGE - 0.001);
    const fx_use_t use = truth_strange(i, random_uniform(r, 1.0, 3.0), &set->strange);
    return model_add_fx(truth, &use, why);
  }
  set->n = set->kind == EXAM_NOTHING ? 0 : set->kind == EXAM_TWO ? 2 : 1;
  for (int k = 0; k < set->n; k++) {
    int i;
    do i = (int)random_uniform(r, 0.0, TRUTH_EFFECTS - 0.001);
    while (k > 0 && same(truth_name(i), set->hidden[0]));
    set->hidden[k] = truth_name(i);
    set->times[k] = pow(2.0, random_uniform(r, -2.0, 2.0));
    const double which = random_uniform(r, 0.0, 1.0);
    const fx_use_t use = truth_effect(i, set->times[k], which, set->own_form);
    TRY(model_add_fx(truth, &use, why));
  }
  return DONE;
}

static done_t fly(exam_set_t *set, random_t *r, const model_t *truth, gap_flight_t flight[EXAM_FIT + 1],
                  unsigned long seed, why_t *why) {
  exam_flight_t job = {
      .truth = truth, .hover_only = set->kind == EXAM_HOVER, .indi = random_uniform(r, 0.0, 1.0) > 0.5};
  // An incremental controller that does not know how late the motors are oscillates: nobody identifies such a
  // vehicle.
  for (int k = 0; k < set->n; k++) job.indi = job.indi && !same(set->hidden[k], "motor_lag");
  set->flew = true;
  for (int i = 0; i <= EXAM_FIT && set->flew; i++) {
    job.seed = seed * 16u + (unsigned long)i;
    if (exam_fly(&job, &flight[i], why) != DONE) set->flew = false;
  }
  return DONE;
}

// --- marking ----------------------------------------------------------------------------------------------

static bool is_hidden(const exam_set_t *set, const char *name) {
  for (int k = 0; k < set->n; k++)
    if (same(set->hidden[k], name)) return true;
  return false;
}

static void mark_names(exam_set_t *set, const diagnosis_t *d) {
  size_t used = 0;
  for (int i = 0; i < d->found.n; i++) {
    const named_t *named = &d->found.named[i];
    const char *name = found_use(&d->found, named)->fx->name;
    bool right = is_hidden(set, name);
    for (int q = 0; q < named->n_rival; q++) right = right || is_hidden(set, named->rival[q]->name);
    reliability_add(&set->stated, named->probability, right);
    if (is_hidden(set, name))
      set->found++;
    else
      set->wrong++;
    for (int k = 0; k < set->n; k++) {
      set->rival_held[k] = set->rival_held[k] || same(set->hidden[k], name);
      for (int q = 0; q < named->n_rival; q++)
        set->rival_held[k] = set->rival_held[k] || same(set->hidden[k], named->rival[q]->name);
    }
    used += (size_t)snprintf(set->answer + used, sizeof set->answer - used, "%s%s", used ? "+" : "", name);
    if (used >= sizeof set->answer) used = sizeof set->answer - 1;
  }
  set->exact = set->found == set->n && set->wrong == 0;
}

static void mark_unknown(exam_set_t *set, const diagnosis_t *d) {
  set->unknown = d->unknown;
  set->cell = d->left.cell;
  if (set->kind != EXAM_STRANGE || !d->unknown) return;
  const char *at = set->strange.coordinate, *said = d->left.cell.coordinate;
  const bool level = strcmp(at, "xy") == 0 && (strcmp(said, "x") == 0 || strcmp(said, "y") == 0);
  const bool high = strcmp(at, "height") == 0 && strcmp(said, "ceiling distance") == 0;
  const bool place = level || high || at[0] == '\0' || strcmp(at, said) == 0;
  set->unknown_right = place && (set->strange.channels >> d->left.cell.channel & 1u);
}

// The answer lists smallest visible sizes, and effects whose typical size cannot be seen.
static void mark_not_testable(exam_set_t *set, const diagnosis_t *d) {
  for (int k = 0; k < set->n; k++) {
    const fx_t *const fx = fx_find(set->hidden[k]);
    const double told = found_least(&d->found, &d->candidates, fx, NULL);
    bool withdrawn = false;
    for (int i = 0; i < d->withdrawn.n; i++) withdrawn = withdrawn || d->withdrawn.name[i].fx == fx;
    set->least[k] = told / truth_typical(set->hidden[k]);
    if (told >= 1.0 || withdrawn || set->least[k] > set->times[k]) set->says_not_testable = true;
  }
}

bool exam_holds(const exam_value_t *v) {
  return fabs(v->value - v->truth) <= EXAM_WITHIN * v->stderr_;
}

// A delay is flown in whole ticks.
static double flown(const model_t *truth, const fx_use_t *hidden, int param) {
  const double p = hidden->p[param], before_s = truth->frame.motor_delay_s;
  if (strcmp(hidden->fx->name, "delay") != 0) return p;
  return round((before_s + p) / EXAM_TICK_S) * EXAM_TICK_S - before_s;
}

// Hidden effects in a form of the exam's own, or of which another form is named, have no such numbers, and
// are left out.
static void mark_values(exam_set_t *set, const diagnosis_t *d, const model_t *truth) {
  for (int i = 0; i < d->found.n; i++) {
    const named_t *const named = &d->found.named[i];
    const fx_use_t *const use = found_use(&d->found, named);
    const candidate_t *const own = &d->candidates.candidate[named->candidate];
    for (int q = 0; q < truth->n_fx; q++)
      for (int k = own->from; truth->fx[q].fx == use->fx && truth->fx[q].form == use->form && k < own->to &&
                              set->n_value < EXAM_VALUES;
           k++) {
        const int param = use->fx->size[k].param;
        int n;
        set->value[set->n_value++] =
            (exam_value_t){use->fx->name, fx_use_params(use, &n)[param].name,
                           flown(truth, &truth->fx[q], param), named->value[k], named->stderr_[k]};
      }
  }
}

bool exam_shrink(double before, double *after, double *oracle) {
  const bool known = before > 0.0 && *oracle > 0.0 && isfinite(*after / before) && isfinite(*oracle / before);
  *after = known ? *after / before : 0.0;
  *oracle = known ? *oracle / before : 0.0;
  return known;
}

static done_t mark_shrink(exam_set_t *set, diagnosis_t *d, const model_t *base, const model_t *truth,
                          why_t *why) {
  double *r[CHANNELS], before = 1.0;
  color_t color[CHANNELS];
  done_t status = DONE;
  for (int ch = 0; ch < CHANNELS; ch++) r[ch] = calloc((size_t)set_rows(&d->held, ch)->n + 1, sizeof(double));
  status = residual_of(&d->held, truth, r, why);
  for (int ch = 0; ch < CHANNELS; ch++) {
    color[ch] =
        residual_has(&d->held, ch) ? color_fit(set_rows(&d->held, ch), r[ch]) : (color_t){.used = false};
    free(r[ch]);
  }
  if (status == DONE) status = whiten_left(&d->held, base, color, &before, why);
  if (status == DONE) status = whiten_left(&d->held, &d->extended, color, &set->after, why);
  if (status == DONE) status = whiten_left(&d->held, truth, color, &set->oracle, why);
  set->shrink_known = status == DONE && exam_shrink(before, &set->after, &set->oracle);
  return status;
}

static done_t examine(exam_set_t *set, const model_t *base, const model_t *truth, gap_flight_t *flight,
                      unsigned long seed, why_t *why) {
  diagnosis_t *const d = malloc(sizeof *d);
  const gap_flights_t fit = {flight, EXAM_FIT}, held = {flight + EXAM_FIT, 1};
  const diagnose_job_t job = {.fit = &fit, .held = &held, .model = base, .seed = seed};
  if (!d) return error_failed(why, "out of memory");
  done_t status = diagnose(&job, d, why);
  if (status == DONE) {
    mark_names(set, d);
    mark_unknown(set, d);
    mark_not_testable(set, d);
    mark_values(set, d, truth);
    status = mark_shrink(set, d, base, truth, why);
  }
  diagnosis_free(d);
  free(d);
  return status;
}

done_t exam_one(exam_kind_t kind, unsigned long seed, exam_set_t *set, why_t *why) {
  model_t base, truth;
  gap_flight_t flight[EXAM_FIT + 1] = {{.n = 0}};
  random_t *const r = random_open(seed * 7919u + 1u);
  if (!r) return error_failed(why, "out of memory");
  *set = (exam_set_t){.kind = kind, .own_form = seed % 2 == 1};
  done_t status = exam_vehicle(&base, why);
  for (int draw = 0; draw < DRAWS && status == DONE && !set->flew; draw++) {
    set->drawn_again = draw;
    truth = base;
    status = hide(set, r, &truth, why);
    for (int i = 0; i <= EXAM_FIT; i++) gap_flight_free(&flight[i]);
    if (status == DONE) status = fly(set, r, &truth, flight, seed + 1000003u * (unsigned long)draw, why);
  }
  if (status == DONE && set->flew) status = examine(set, &base, &truth, flight, seed, why);
  for (int i = 0; i <= EXAM_FIT; i++) gap_flight_free(&flight[i]);
  random_close(r);
  return status;
}
