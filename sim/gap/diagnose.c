// diagnose.c - the workflow on flights in memory: stages 2 to 5, and 7.
#include "gap/diagnose.h"

#include "gap/2_predict/excluded.h"
#include "gap/2_predict/lift.h"
#include "gap/5_infer/both_ways.h"
#include "gap/5_infer/confirm.h"
#include "gap/5_infer/loop_fit.h"
#include "gap/5_infer/own_work.h"
#include "gap/5_infer/select.h"
#include "gap/5_infer/shape.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TRIAL_SEED 1000 // trials draw other numbers than the flights that count

static done_t cut_flights(set_t *s, const gap_flights_t *flights, const diagnose_job_t *job, why_t *why) {
  grid_t *const grid = calloc((size_t)flights->n + 1, sizeof(grid_t));
  if (!grid) return error_failed(why, "out of memory");
  done_t status = DONE;
  for (int i = 0; i < flights->n && status == DONE; i++) {
    status = grid_make(&grid[i], &flights->flight[i], 0, flights->flight[i].n, job->model, why);
    grid[i].command_Hz = job->flown_by ? job->flown_by->rate_Hz : 0.0;
  }
  if (status == DONE) {
    TRY(set_make(s, grid, flights->n, why));
    return job->fit->n > 1 ? lift_find(s, job->model, why) : DONE; // one flight differs from no other
  }
  for (int i = 0; i < flights->n; i++) grid_free(&grid[i]);
  free(grid);
  return status;
}

static bool held_apart(const diagnose_job_t *job) {
  return job->held && job->held->n > 0;
}

static done_t take_flights(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  TRY(cut_flights(&d->fit, job->fit, job, why));
  TRY(excluded_find(&d->fit, job->model, why));
  TRY(windows_keep(&d->fit, job->model, why));
  TRY(cut_flights(&d->held, held_apart(job) ? job->held : job->fit, job, why));
  memcpy(d->held.excluded, d->fit.excluded, sizeof d->held.excluded);
  return DONE;
}

static done_t find_residual(diagnosis_t *d, const model_t *m, why_t *why) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (!d->residual[ch]) d->residual[ch] = calloc((size_t)set_rows(&d->fit, ch)->n + 1, sizeof(double));
    if (!d->residual[ch]) return error_failed(why, "out of memory");
  }
  return residual_of(&d->fit, m, d->residual, why);
}

static done_t fly_with(const diagnose_job_t *job, diagnosis_t *d, const chosen_t *chosen, why_t *why) {
  model_t m;
  nominal_free(&d->nominal);
  TRY(chosen_model(chosen, job->model, &m, why));
  const nominal_job_t nominal = {&d->fit, job->model, m, &d->candidates, chosen, &d->loop, job->seed, NULL};
  TRY(nominal_make(&d->nominal, &nominal, why));
  d->nominal_flew = d->nominal.n > 0;
  d->flown = *chosen;
  return DONE;
}

static done_t look_first(const diagnose_job_t *job, diagnosis_t *d, found_t *first, why_t *why) {
  selection_t *selection;
  const select_job_t look = {
      .candidates = &d->candidates, .set = &d->fit, .model = job->model, .timing = &d->timing};
  const done_t status = select_effects(&selection, &look, first, why);
  select_close(selection);
  TRY(status);
  d->rounds = first->rounds;
  TRY(shapes_refine(&d->candidates, &d->fit, job->model, first, why));
  candidates_reshape(&d->candidates, &first->chosen);
  d->before = first->chosen;
  return DONE;
}

// Names that control's answer to a disturbance looks like, of whose kind nominal flights had none.
typedef struct {
  int n, of[CHOSEN_MAX];
  bool own[CHOSEN_MAX]; // it is control's own work
} answers_t;

static bool flew_with(const diagnosis_t *d, const fx_t *fx) {
  for (int i = 0; i < d->flown.n; i++)
    if (candidates_alike(d->flown.use[i].fx, fx)) return true;
  return false;
}

// True for a name that may be control's answer. A lag or delay that is too long for linear columns, or that
// rotor speeds show, is sure; one that is too small is not named.
static bool is_answer(const diagnosis_t *d, const fx_use_t *use, int candidate) {
  return use->fx->answers && candidate != d->timing.candidate && !flew_with(d, use->fx) &&
         fabs(fx_use_size(use, 0)) >= candidates_least(use->fx, &d->fit);
}

static done_t find_own_work(const diagnose_job_t *job, const chosen_t *chosen, diagnosis_t *d, bool first,
                            answers_t *a, why_t *why) {
  const own_work_job_t asked = {.c = &d->candidates,
                                .set = &d->fit,
                                .base = job->model,
                                .flown_by = job->flown_by,
                                .seed = job->seed,
                                .trial_seed = job->seed + TRIAL_SEED};
  *a = (answers_t){.n = 0};
  for (int i = 0; i < chosen->n; i++)
    if (is_answer(d, &chosen->use[i], chosen->of[i]) &&
        !(first && chosen->use[i].fx->scales == FX_SCALES_INERTIA))
      a->of[a->n++] = chosen->of[i];
  return own_work(&asked, chosen, a->n, a->of, a->own, why);
}

// Drops control's own work: nominal flights do not have it, and looks do not begin with it. A thrust slope
// that is dropped may have stood for an inertia that the first look did not take, so inertias are tried
// again. One that is in is not tested here: it is borne out both ways (both_ways.h), and no draught looks
// like that.
static done_t drop_own_work(const diagnose_job_t *job, diagnosis_t *d, chosen_t *chosen, why_t *why) {
  answers_t a;
  bool dropped = false;
  TRY(find_own_work(job, chosen, d, true, &a, why));
  for (int k = 0; k < a.n; k++) {
    if (!a.own[k]) continue;
    chosen_drop(chosen, a.of[k]);
    chosen_drop(&d->before, a.of[k]);
    dropped = true;
  }
  return dropped ? both_ways_take(chosen, &d->candidates, &d->fit, job->model, why) : DONE;
}

static done_t fit_and_fly(const diagnose_job_t *job, diagnosis_t *d, const chosen_t *chosen, why_t *why) {
  model_t m;
  TRY(chosen_model(chosen, job->model, &m, why));
  TRY(loop_fit(&d->loop, &d->fit, &m, job->flown_by, job->seed + TRIAL_SEED, why));
  return fly_with(job, d, chosen, why);
}

// Called if nobody could fly with these names. With too small a thrust nobody takes off, so flies without
// those that change it, if any do.
static done_t fly_without_lift(const diagnose_job_t *job, diagnosis_t *d, const chosen_t *chosen,
                               why_t *why) {
  const closed_loop_t loop = d->loop;
  chosen_t without = *chosen;
  for (int i = chosen->n - 1; i >= 0; i--)
    if (chosen->use[i].fx->scales_thrust) chosen_drop(&without, chosen->of[i]);
  if (without.n == chosen->n) return DONE;
  TRY(fit_and_fly(job, d, &without, why));
  if (d->nominal_flew)
    d->before = without; // the first look was wrong: the next one begins without them
  else
    d->loop = loop, d->flown = *chosen;
  return DONE;
}

// Flies the nominal flights. A first look, without any, shows the effects and the noise beside them; both are
// then flown.
static done_t fly_nominal(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  found_t first;
  const done_t status = look_first(job, d, &first, why);
  chosen_t chosen = first.chosen;
  found_free(&first);
  TRY(status);
  TRY(both_ways_take(&chosen, &d->candidates, &d->fit, job->model, why));
  TRY(drop_own_work(job, d, &chosen, why));
  TRY(fit_and_fly(job, d, &chosen, why));
  return d->nominal_flew ? DONE : fly_without_lift(job, d, &chosen, why);
}

static done_t look_for_more(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  TRY(find_residual(d, &d->extended, why));
  scan_t scan;
  TRY(unknown_scan(&d->fit, &d->extended, d->residual, &scan, why));
  for (bool sure = false; !sure;) {
    unknown_judge(&scan, d->nominal.scan, d->nominal.n, d->nominal.misfit, &d->left);
    const cell_t cell = d->left.cell;
    TRY(unknown_measure(&d->fit, &d->extended, d->residual, &d->left.cell, why));
    sure = !d->left.found || unknown_is_sure(&d->left.cell);
    if (!sure) unknown_leave_out(&scan, &cell);
  }
  d->unknown = d->nominal_flew && d->left.found;
  if (!d->unknown) return DONE;
  for (int i = 0; i < GROUPS; i++) {
    const cell_t *const cell = unknown_by_flight(&scan, &d->left, i);
    if (cell)
      TRY(flights_differ_make(&d->differ[i], &d->fit, d->residual, job->model, &d->candidates,
                              &d->found.chosen, cell, why));
  }
  return for_a_time(&d->for_a_time, &d->fit, d->residual, job->model, &d->candidates, &d->found.chosen,
                    &d->left.cell, &d->left.also, why);
}

static done_t look(diagnosis_t *d, selection_t **selection, const model_t *m, bool last, bool *again,
                   why_t *why) {
  const select_job_t job = {&d->candidates, &d->fit, m, &d->timing, &d->nominal, &d->before};
  TRY(select_effects(selection, &job, &d->found, why));
  d->rounds += d->found.rounds;
  TRY(shapes_refine(&d->candidates, &d->fit, m, &d->found, why));
  d->before = d->found.chosen;
  *again = !last && chosen_other(&d->candidates, &d->flown, &d->found.chosen);
  if (*again) return DONE; // another look follows, so nobody needs rivals
  TRY(nominal_look(&d->nominal, m, why));
  return select_rivals(*selection, &d->found, why);
}

static done_t look_once(diagnosis_t *d, const model_t *m, bool last, bool *again, why_t *why) {
  selection_t *selection = NULL;
  const done_t status = look(d, &selection, m, last, again, why);
  select_close(selection);
  if (status == DONE) candidates_reshape(&d->candidates, &d->found.chosen);
  return status;
}

static void refute(diagnosis_t *d, const named_t *named, maker_t by) {
  candidate_t *const c = &d->candidates.candidate[named->candidate];
  if (d->n_refuted < NAMED_MAX)
    d->refuted[d->n_refuted++] = (refuted_t){c->use.fx, c->from, named->value[c->from], named->confirm, by};
  c->barred = true;
}

// Bars what is control's own work from further looks. What it hid was never looked for, so the next look
// begins with nothing (select.h).
static void bar_alike(diagnosis_t *d, const fx_t *fx) {
  for (int i = 0; i < d->candidates.n; i++)
    if (candidates_alike(d->candidates.candidate[i].use.fx, fx)) d->candidates.candidate[i].barred = true;
}

static done_t bar_own_work(const diagnose_job_t *job, diagnosis_t *d, bool *barred, why_t *why) {
  answers_t a;
  *barred = false;
  TRY(find_own_work(job, &d->found.chosen, d, false, &a, why));
  for (int k = 0; k < a.n; k++) {
    if (!a.own[k]) continue;
    for (int i = 0; i < d->found.n; i++)
      if (d->found.named[i].candidate == a.of[k]) refute(d, &d->found.named[i], MADE_BY_CONTROL);
    bar_alike(d, d->candidates.candidate[a.of[k]].use.fx);
    *barred = true;
  }
  if (*barred) found_free(&d->found);
  return DONE;
}

static done_t look_beyond_control(const diagnose_job_t *job, diagnosis_t *d, bool last, bool *again,
                                  why_t *why) {
  for (bool barred = true; barred;) {
    TRY(look_once(d, job->model, last, again, why));
    TRY(bar_own_work(job, d, &barred, why));
  }
  return DONE;
}

// Looks for names, and once more with the shapes that were found, because what a shape near the right one
// leaves hides the smaller names. Where another model was flown than was found, nominal flights are flown
// anew, if a pilot can fly it.
static done_t find_names(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  bool again;
  TRY(look_beyond_control(job, d, false, &again, why));
  if (!again) return DONE;
  const chosen_t flown = d->flown;
  const bool flew = d->nominal_flew;
  TRY(fly_with(job, d, &d->found.chosen, why));
  if (flew && !d->nominal_flew) {
    TRY(fly_with(job, d, &flown, why));
    d->before = flown;
  }
  found_free(&d->found);
  return look_beyond_control(job, d, true, &again, why);
}

// Bars the kind of a name that grows a channel, as another kind may be right: a drag at the hubs that
// held-out flights contradict may act at the centre of mass. A name of which they show next to nothing is not
// there in any kind. True: some were barred.
static bool bar_kinds(diagnosis_t *d) {
  candidate_t *const all = d->candidates.candidate;
  bool barred = false;
  for (int i = 0; i < d->withdrawn.n; i++) {
    const int which = d->withdrawn.name[i].candidate;
    int others = 0;
    for (int k = 0; k < d->candidates.n; k++)
      others += k != which && candidates_exclude(&all[k], &all[which]) && !all[k].barred;
    const bool kinds = all[which].use.fx->n_kind > 1 || candidate_is_numbered(&all[which]);
    if (!kinds || others == 0 || d->withdrawn.name[i].by_share) continue;
    barred = all[which].barred = true;
  }
  return barred;
}

static verify_job_t held_out(const diagnose_job_t *job, diagnosis_t *d) {
  return (verify_job_t){&d->held, &d->fit, job->model, &d->loop, &d->found, &d->turns, &d->own};
}

static done_t find_own(const diagnose_job_t *job, diagnosis_t *d, const model_t *m, why_t *why) {
  return own_find(&d->own, &d->fit, m, d->residual, &d->nominal, held_apart(job), why);
}

static done_t find_and_verify(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  const verify_job_t names = held_out(job, d);
  model_t m;
  for (bool again = false;; again = true) {
    if (again) found_free(&d->found);
    TRY(find_names(job, d, why));
    d->turns = (by_turns_t){1, {d->found.chosen}};
    if (!held_apart(job))
      TRY(by_turns_make(&d->turns, &d->candidates, &d->fit, job->model, &d->found.chosen, &d->timing, why));
    TRY(chosen_model(&d->found.chosen, job->model, &m, why));
    TRY(find_residual(d, &m, why));
    TRY(find_own(job, d, &m, why));
    TRY(verify_names(&names, &d->withdrawn, why));
    if (!bar_kinds(d)) return DONE;
  }
}

// Takes back what set points say of a timing that measured rotor speeds show: nothing else has a say in it.
static void believe_speeds(diagnosis_t *d) {
  for (int i = 0; i < d->found.n && d->timing.measured; i++)
    if (d->found.named[i].candidate == d->timing.candidate)
      d->found.named[i].confirm = (confirm_t){.answer = CONFIRM_NOT_TRIED};
}

// Bars the names that the set points refute, so that what they explained is looked at without them.
static bool bar_refuted(diagnosis_t *d) {
  bool refuted = false;
  for (int i = 0; i < d->found.n; i++) {
    const named_t *const named = &d->found.named[i];
    if (!confirm_refutes(&named->confirm) || d->n_refuted >= NAMED_MAX) continue;
    if (d->candidates.candidate[named->candidate].barred) continue; // it is withdrawn already
    refute(d, named, MADE_BY_FEEDBACK);
    candidates_bar(&d->candidates, named->candidate); // feedback makes the other kinds, too
    refuted = true;
  }
  return refuted;
}

// Bars scales of the turning that missed commands, or noise that is fed back, could have made, and in a log
// that misses commands scales of the thrust that only the turning shows.
static done_t bar_one_way(const diagnose_job_t *job, diagnosis_t *d, bool *barred, why_t *why) {
  const bool slow = candidates_slow(&d->fit);
  *barred = false;
  for (int i = 0; i < d->found.n; i++) {
    const named_t *const named = &d->found.named[i];
    candidate_t *const c = &d->candidates.candidate[named->candidate];
    const bool lifts = slow && candidates_by_turning(c->use.fx, &d->fit);
    if (!(c->use.fx->scales != FX_SCALES_NOTHING || lifts) || d->n_refuted >= NAMED_MAX) continue;
    bool stands = false;
    if (!lifts) TRY(both_ways(&d->fit, job->model, &d->found.chosen, c->use.fx, named, &stands, why));
    if (stands) continue;
    refute(d, named, slow ? MADE_BY_MISSED_COMMANDS : MADE_BY_NOISE);
    *barred = true;
  }
  return DONE;
}

static done_t find_what_stands(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  for (;;) {
    TRY(find_and_verify(job, d, why));
    TRY(confirm_names(&d->candidates, &d->fit, job->model, &d->loop, &d->found, &d->why_not_confirmed, why));
    believe_speeds(d);
    bool one_way;
    TRY(bar_one_way(job, d, &one_way, why));
    if (!bar_refuted(d) && !one_way) break;
    found_free(&d->found);
  }
  found_join_rivals(&d->found);
  return DONE;
}

static void tell(const diagnose_job_t *job, const char *what) {
  if (job->progress) job->progress(what);
}

done_t diagnose(const diagnose_job_t *job, diagnosis_t *d, why_t *why) {
  *d = (diagnosis_t){.nominal = {.n = 0}};
  tell(job, "replaying the logs");
  TRY(take_flights(job, d, why));
  TRY(candidates_make(&d->candidates, job->model, &d->fit, why));
  TRY(timing_find(&d->timing, &d->candidates, &d->fit, job->model, why));
  tell(job, "flying what feedback alone would show");
  TRY(fly_nominal(job, d, why));
  tell(job, "looking for missing effects");
  TRY(find_what_stands(job, d, why));
  TRY(chosen_model(&d->found.chosen, job->model, &d->extended, why));
  tell(job, "looking at what is left");
  TRY(look_for_more(job, d, why));
  TRY(find_own(job, d, &d->extended, why));
  for (int ch = 0; ch < CHANNELS; ch++) // names were spared a difference that is not told; the report is not
    if (d->differ[group_of(ch)].n == 0) d->own.may[ch] = 0.0;
  const verify_job_t names = held_out(job, d);
  return verify_held(&names, &d->nominal, &d->held_out, why);
}

void diagnosis_free(diagnosis_t *d) {
  for (int ch = 0; ch < CHANNELS; ch++) free(d->residual[ch]);
  set_free(&d->fit);
  set_free(&d->held);
  candidates_free(&d->candidates);
  nominal_free(&d->nominal);
  found_free(&d->found);
  for (int i = 0; i < GROUPS; i++) flights_differ_free(&d->differ[i]);
}
