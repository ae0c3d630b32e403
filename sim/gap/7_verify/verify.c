// verify.c - flights that were not fitted to, before and after; and names that they contradict.
#include "gap/7_verify/verify.h"

#include <math.h>

static double rms_of(const double *v, int n) {
  double squares = 0.0;
  for (int i = 0; i < n; i++) squares += v[i] * v[i];
  return n ? sqrt(squares / n) : 0.0;
}

// The channel's rows are enough to judge what is left of them.
static color_t color_of(const set_t *s, int channel, const lines_t *left) {
  return residual_has(s, channel) ? color_fit(set_rows(s, channel), left->r[channel])
                                  : (color_t){.used = false};
}

#define ALL_TURNS (-1)

// The rows whose turn it is.
static void take_turn(lines_t *l, const lines_t *own, const set_t *s, int turn) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    const rows_t *const r = set_rows(s, ch);
    for (int i = 0; i < r->n; i++)
      if (turn == ALL_TURNS || by_turns_at(&s->grid[r->flight[i]], r->point[i]) == turn)
        l->r[ch][i] = own->r[ch][i];
  }
}

// candidate: without it; below 0: with all names.
static done_t lines_without(set_t *s, const model_t *base, const by_turns_t *turns, int candidate, lines_t *l,
                            why_t *why) {
  done_t status = lines_make(l, s, why);
  for (int k = 0; k < turns->n && status == DONE; k++) {
    chosen_t with = turns->of[k];
    model_t m;
    lines_t own = {.r = {NULL}};
    chosen_drop(&with, candidate);
    status = chosen_model(&with, base, &m, why);
    if (status == DONE) status = residual_lines(s, &m, &own, why);
    if (status == DONE) take_turn(l, &own, s, turns->n > 1 ? k : ALL_TURNS);
    lines_free(&own);
  }
  return status;
}

done_t verify_lines(set_t *held, const model_t *base, const by_turns_t *turns, lines_t *l, why_t *why) {
  return lines_without(held, base, turns, -1, l, why);
}

done_t verify_held(const verify_job_t *job, const nominal_t *nominal, held_t *held, why_t *why) {
  set_t *const s = job->held;
  lines_t b, a = {.r = {NULL}};
  *held = (held_t){.left_before = 0.0};
  const bool judged = job->turns->n == 1 || by_turns_cover(s);
  done_t status = residual_lines(s, job->base, &b, why);
  if (status == DONE) status = verify_lines(s, job->base, job->turns, &a, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++) {
    gap_part_t *const p = &held->channel[ch];
    const rows_t *rows = set_rows(s, ch);
    const color_t color = color_of(s, ch, &a);
    *p = (gap_part_t){.used = judged && color.used, .floor = nominal->floor[ch]};
    if (!p->used) continue;
    p->before = rms_of(b.r[ch], rows->n);
    p->after = rms_of(a.r[ch], rows->n);
    p->jumps = ch < CH_SMOOTH ? residual_jumps(rows, a.r[ch]) : 0.0;
    held->left_before += color_left(rows, &color, b.r[ch]);
    held->left_after += color_left(rows, &color, a.r[ch]);
  }
  lines_free(&b);
  lines_free(&a);
  return status;
}

// --- names that held-out flights contradict ---------------------------------------------------------------

// The model with all names but one; below 0: with all.
static done_t model_without(const verify_job_t *d, int candidate, model_t *m, why_t *why) {
  chosen_t others = d->found->chosen;
  chosen_drop(&others, candidate);
  return chosen_model(&others, d->base, m, why);
}

// What that model leaves of every channel; 0 where the rows are too few.
static done_t measure(const verify_job_t *d, int without, double rms[CHANNELS], why_t *why) {
  lines_t l;
  const done_t status = lines_without(d->held, d->base, d->turns, without, &l, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    rms[ch] = color_of(d->held, ch, &l).used ? rms_of(l.r[ch], set_rows(d->held, ch)->n) : 0.0;
  lines_free(&l);
  return status;
}

// Sum over the channels of the logarithm of what the rms is multiplied by.
static double balance(const double with[CHANNELS], const double without[CHANNELS]) {
  double sum = 0.0;
  for (int ch = 0; ch < CHANNELS; ch++)
    if (with[ch] > 0.0 && without[ch] > 0.0) sum += log(with[ch] / without[ch]);
  return sum;
}

// l: what the name adds to each row of a set.
static done_t contribution(set_t *s, const model_t *with, const model_t *without, lines_t *l, why_t *why) {
  lines_t left = {.r = {NULL}};
  done_t status = residual_lines(s, without, l, why);
  if (status == DONE) status = residual_lines(s, with, &left, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    for (int i = 0; i < set_rows(s, ch)->n; i++) l->r[ch][i] -= left.r[ch][i];
  lines_free(&left);
  return status;
}

static done_t errors_of(along_t *a, const model_t *with, const model_t *without, double blur[CHANNELS],
                        why_t *why) {
  lines_t seen = {.r = {NULL}}, is = {.r = {NULL}};
  done_t status = contribution(&a->seen, with, without, &seen, why);
  if (status == DONE) status = contribution(&a->is, with, without, &is, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++) {
    const int n = set_rows(&a->seen, ch)->n;
    if (n != set_rows(&a->is, ch)->n) continue; // errors move some rows out of sight
    for (int i = 0; i < n; i++) seen.r[ch][i] -= is.r[ch][i];
    blur[ch] = rms_of(seen.r[ch], n);
  }
  lines_free(&seen);
  lines_free(&is);
  return status;
}

// The rms that a right name may bring, by errors of the log and by feedback: on flights of the model along
// the held-out tracks. 0 where it cannot fly.
static done_t blur_of(const verify_job_t *d, int candidate, double blur[CHANNELS], why_t *why) {
  model_t with, without;
  along_t a;
  done_t status;
  for (int ch = 0; ch < CHANNELS; ch++) blur[ch] = 0.0;
  TRY(model_without(d, -1, &with, why));
  TRY(model_without(d, candidate, &without, why));
  status = nominal_along(&a, d->held, &with, d->loop, 1, why);
  if (status == DONE) status = errors_of(&a, &with, &without, blur, why);
  along_free(&a);
  return status == FAILED ? FAILED : DONE;
}

// The channel that a name grows most, if it is by more than it may and the others do not gain as much; -1:
// none.
static int grown(const double with[CHANNELS], const double without[CHANNELS], const double blur[CHANNELS],
                 double *most) {
  const double total = balance(with, without);
  int worst = -1;
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (!(without[ch] > 0.0) || total < -log(with[ch] / without[ch])) continue;
    const double sharp = sqrt(fmax(with[ch] * with[ch] - blur[ch] * blur[ch], 0.0)) / without[ch];
    if (!(sharp > *most)) continue;
    *most = sharp;
    worst = ch;
  }
  return worst;
}

// The name that does so most; -1: none.
static done_t find_worst(const verify_job_t *d, int *worst, withdrawn_t *why_so, why_t *why) {
  static const double none[CHANNELS] = {0.0};
  double with[CHANNELS], without[CHANNELS], blur[CHANNELS], most = VERIFY_GROWS;
  *worst = -1;
  TRY(measure(d, -1, with, why));
  for (int i = 0; i < d->found->n; i++) {
    const named_t *const name = &d->found->named[i];
    double first = most;
    TRY(measure(d, name->candidate, without, why));
    if (grown(with, without, none, &first) < 0) continue;
    TRY(blur_of(d, name->candidate, blur, why));
    const int ch = grown(with, without, blur, &most);
    if (ch < 0) continue;
    *worst = i;
    *why_so = (withdrawn_t){found_use(d->found, name)->fx, name->candidate, ch, without[ch], with[ch]};
  }
  return DONE;
}

done_t verify_names(const verify_job_t *d, withdrawn_list_t *withdrawn, why_t *why) {
  int worst = 0;
  withdrawn->n = 0;
  while (d->found->n > 0) {
    TRY(find_worst(d, &worst, &withdrawn->name[withdrawn->n], why));
    if (worst < 0) return DONE;
    by_turns_drop(d->turns, withdrawn->name[withdrawn->n++].candidate);
    found_withdraw(d->found, worst);
  }
  return DONE;
}
