// verify.c - held-out flights before and after, and the names that they contradict.
#include "gap/7_verify/verify.h"

#include <math.h>
#include <stdlib.h>

static double rms_of(const double *v, int n) {
  double squares = 0.0;
  for (int i = 0; i < n; i++) squares += v[i] * v[i];
  return n ? sqrt(squares / n) : 0.0;
}

// Returns the colour of what is left of a channel; not used where its rows are too few to judge it.
static color_t color_of(const set_t *s, int channel, const lines_t *left) {
  return residual_has(s, channel) ? color_fit(set_rows(s, channel), left->r[channel])
                                  : (color_t){.used = false};
}

#define ALL_TURNS (-1)

// Copies the rows whose turn it is.
static void take_turn(lines_t *l, const lines_t *own, const set_t *s, int turn) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    const rows_t *const r = set_rows(s, ch);
    for (int i = 0; i < r->n; i++)
      if (turn == ALL_TURNS || by_turns_at(&s->grid[r->flight[i]], r->point[i]) == turn)
        l->r[ch][i] = own->r[ch][i];
  }
}

// --- what a model leaves ----------------------------------------------------------------------------------

enum { ALL_NAMES = -1, NO_NAME = -2 }; // else a candidate: all names but this one

static done_t lines_of(const verify_job_t *d, set_t *s, int without, lines_t *l, why_t *why) {
  if (without == NO_NAME) return residual_lines(s, d->base, l, why);
  done_t status = lines_make(l, s, why);
  for (int k = 0; k < d->turns->n && status == DONE; k++) {
    chosen_t with = d->turns->of[k];
    model_t m;
    lines_t own = {.r = {NULL}};
    chosen_drop(&with, without);
    status = chosen_model(&with, d->base, &m, why);
    if (status == DONE) status = residual_lines(s, &m, &own, why);
    if (status == DONE) take_turn(l, &own, s, d->turns->n > 1 ? k : ALL_TURNS);
    lines_free(&own);
  }
  return status;
}

// --- what a flight has of its own --------------------------------------------------------------------------

done_t own_find(own_t *own, const set_t *fit, const model_t *m, double *const residual[CHANNELS],
                const nominal_t *nominal, bool apart, why_t *why) {
  cell_t cell[CHANNELS];
  *own = (own_t){.may = {0.0}};
  if (nominal->n == 0) return DONE;
  TRY(unknown_differ(fit, m, residual, nominal->scan, nominal->n, nominal->misfit, cell, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    if (cell[ch].statistic > 0.0)
      own->may[ch] = apart ? cell[ch].size * limits_another(cell[ch].flights) : HUGE_VAL;
  return DONE;
}

static bool has_own(const own_t *own) {
  bool has = false;
  for (int ch = 0; ch < CHANNELS; ch++) has = has || own->may[ch] > 0.0;
  return has;
}

// Returns how much of a held-out flight's constant is its own: the part beyond the interval from 0 to the
// fitted flights' constant, at most `may`. By turns (`may` is infinite) the whole difference.
static double own_of(double is, double usual, double may) {
  if (isinf(may)) return is - usual;
  const double off = is - fmin(fmax(0.0, fmin(is, usual)), fmax(is, usual));
  return fmin(fmax(off, -may), may);
}

// Takes out what flights have of their own. its_own: gets it, of flight f and channel ch [f * CHANNELS + ch];
// may be null.
static void take_own(const verify_job_t *d, const lines_t *fitted, lines_t *l, double *its_own) {
  for (int i = 0; i < d->held->n_grid * CHANNELS; i++) {
    const int ch = i % CHANNELS, flight = i / CHANNELS;
    const rows_t *const r = set_rows(d->held, ch);
    if (!(d->own->may[ch] > 0.0)) continue;
    const double own =
        own_of(rows_constant(r, l->r[ch], flight),
               rows_usual(set_rows(d->fit, ch), fitted->r[ch], d->fit->n_grid), d->own->may[ch]);
    rows_take(r, l->r[ch], flight, own);
    if (its_own) its_own[i] = own;
  }
}

// --- flights that were not fitted to -----------------------------------------------------------------------

static done_t lines_without(const verify_job_t *d, int without, lines_t *l, double *its_own, why_t *why) {
  lines_t fitted = {.r = {NULL}};
  done_t status = lines_of(d, d->held, without, l, why);
  if (status == DONE && has_own(d->own)) {
    status = lines_of(d, d->fit, without, &fitted, why);
    if (status == DONE) take_own(d, &fitted, l, its_own);
  }
  lines_free(&fitted);
  return status;
}

done_t verify_lines(const verify_job_t *job, lines_t *before, lines_t *after, double *its_own, why_t *why) {
  *after = (lines_t){.r = {NULL}};
  TRY(lines_without(job, NO_NAME, before, NULL, why));
  return lines_without(job, ALL_NAMES, after, its_own, why);
}

// True if something is held out: by turns flights may be too short for it.
static bool is_judged(const verify_job_t *job) {
  return job->turns->n == 1 || by_turns_cover(job->held);
}

done_t verify_held(const verify_job_t *job, const nominal_t *nominal, held_t *held, why_t *why) {
  set_t *const s = job->held;
  lines_t b, a = {.r = {NULL}};
  *held = (held_t){.left_before = 0.0};
  const bool judged = is_judged(job);
  const done_t status = verify_lines(job, &b, &a, NULL, why);
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

// Makes the model with all names but one; candidate below 0: with all.
static done_t model_without(const verify_job_t *d, int candidate, model_t *m, why_t *why) {
  chosen_t others = d->found->chosen;
  chosen_drop(&others, candidate);
  return chosen_model(&others, d->base, m, why);
}

// Finds the rms of what a model leaves, by channel; 0 where the rows are too few.
static void measure(const set_t *s, const lines_t *left, double rms[CHANNELS]) {
  for (int ch = 0; ch < CHANNELS; ch++)
    rms[ch] = color_of(s, ch, left).used ? rms_of(left->r[ch], set_rows(s, ch)->n) : 0.0;
}

// Returns the sum over the channels of the logarithm of the factor by which the rms grows.
static double balance(const double with[CHANNELS], const double without[CHANNELS]) {
  double sum = 0.0;
  for (int ch = 0; ch < CHANNELS; ch++)
    if (with[ch] > 0.0 && without[ch] > 0.0) sum += log(with[ch] / without[ch]);
  return sum;
}

// l: gets what the name adds to each row of a set.
static done_t contribution(set_t *s, const model_t *with, const model_t *without, lines_t *l, why_t *why) {
  lines_t left = {.r = {NULL}};
  done_t status = residual_lines(s, without, l, why);
  if (status == DONE) status = residual_lines(s, with, &left, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    for (int i = 0; i < set_rows(s, ch)->n; i++) l->r[ch][i] -= left.r[ch][i];
  lines_free(&left);
  return status;
}

// blur: gets the rms by which errors of sensors and estimates change what the name adds. white: the same of
// whitened rows, in the colours of what these flights have left.
static done_t errors_of(along_t *a, const own_t *own, const model_t *with, const model_t *without,
                        const color_t color[CHANNELS], double blur[CHANNELS], double white[CHANNELS],
                        why_t *why) {
  lines_t seen = {.r = {NULL}}, is = {.r = {NULL}};
  done_t status = contribution(&a->seen, with, without, &seen, why);
  if (status == DONE) status = contribution(&a->is, with, without, &is, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++) {
    const int n = set_rows(&a->seen, ch)->n;
    if (n != set_rows(&a->is, ch)->n) continue; // errors move some rows out of sight
    for (int i = 0; i < n; i++) seen.r[ch][i] -= is.r[ch][i];
    if (own->may[ch] > 0.0) rows_center(set_rows(&a->seen, ch), seen.r[ch]);
    blur[ch] = rms_of(seen.r[ch], n);
    if (!color[ch].used) continue;
    color_whiten(&color[ch], set_rows(&a->seen, ch), seen.r[ch], is.r[ch]);
    white[ch] = rms_of(is.r[ch], n);
  }
  lines_free(&seen);
  lines_free(&is);
  return status;
}

// Finds the rms that errors of the log and feedback may make of a right name, on flights of the model along
// the held-out tracks; 0 where it cannot fly.
static done_t blur_of(const verify_job_t *d, int candidate, const color_t color[CHANNELS],
                      double blur[CHANNELS], double white[CHANNELS], why_t *why) {
  model_t with, without;
  along_t a;
  done_t status;
  for (int ch = 0; ch < CHANNELS; ch++) blur[ch] = white[ch] = 0.0;
  TRY(model_without(d, -1, &with, why));
  TRY(model_without(d, candidate, &without, why));
  status = nominal_along(&a, d->held, &with, d->loop, 1, why);
  if (status == DONE) status = errors_of(&a, d->own, &with, &without, color, blur, white, why);
  along_free(&a);
  return status == FAILED ? FAILED : DONE;
}

// Returns the channel that a name grows most, if that is by more than it may and the others do not gain as
// much; -1: none.
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

// How much whitened held-out rows show of what a name adds to them.
typedef struct {
  double has, adds; // products of this: with rows without the name; with itself, less its inputs' errors
  double squares;   // with itself, with these
} share_t;

// What all names leave of the held-out rows, and its colours.
typedef struct {
  lines_t lines;
  color_t color[CHANNELS];
} with_all_t;

// blur: rms of these errors in whitened rows, by channel; null: they do not count.
static done_t share_of(const set_t *s, const with_all_t *with, const lines_t *without, const double *blur,
                       share_t *share, why_t *why) {
  double *const x = malloc(3 * set_most_rows(s) * sizeof(double));
  *share = (share_t){.adds = 0.0};
  if (!x) return error_failed(why, "out of memory");
  double *const adds = x + set_most_rows(s), *const there = adds + set_most_rows(s);
  for (int ch = 0; ch < CHANNELS; ch++) {
    const rows_t *const rows = set_rows(s, ch);
    const color_t *const color = &with->color[ch];
    double squares = 0.0;
    if (!color->used) continue;
    for (int i = 0; i < rows->n; i++) x[i] = without->r[ch][i] - with->lines.r[ch][i];
    color_whiten(color, rows, x, adds);
    color_whiten(color, rows, without->r[ch], there);
    for (int i = 0; i < rows->n; i++) {
      share->has += adds[i] * there[i];
      squares += adds[i] * adds[i];
    }
    share->squares += squares;
    share->adds += fmax(squares - (blur ? rows->n * blur[ch] * blur[ch] : 0.0), 0.0);
  }
  free(x);
  return DONE;
}

// True if the rows show less than half of what the name adds, and miss all of it by more than allowed by
// their noise, not quite white, and by the error of its size (relative).
static bool contradicts(const share_t *s, double relative) {
  const double error = SCORE_ERRORS * SCORE_CLUSTER * hypot(sqrt(s->squares), relative * s->adds);
  return s->adds > 0.0 && s->has < 0.5 * s->adds && s->adds - s->has > error;
}

// Returns the relative error of the size of a name that is known best.
static double relative_error(const named_t *name) {
  double least = HUGE_VAL;
  for (int k = 0; k < FX_SIZE_MAX; k++)
    if (name->stderr_[k] > 0.0 && name->value[k] != 0.0)
      least = fmin(least, name->stderr_[k] / fabs(name->value[k]));
  return isfinite(least) ? least : 0.0;
}

static int grows_most(const double with[CHANNELS], const double without[CHANNELS]) {
  int most = -1;
  for (int ch = 0; ch < CHANNELS; ch++)
    if (without[ch] > 0.0 && (most < 0 || with[ch] * without[most] > with[most] * without[ch])) most = ch;
  return most;
}

// Finds whether these flights contradict a name, and how. grows: the factor by which it grows a channel; 1:
// they do, though none grows by more than it may; 0: they do not. Sets the name's held_share.
static done_t try_name(const verify_job_t *d, named_t *name, const with_all_t *with, const lines_t *without,
                       withdrawn_t *so, double *grows, why_t *why) {
  static const double none[CHANNELS] = {0.0};
  double after[CHANNELS], before[CHANNELS], blur[CHANNELS], white[CHANNELS];
  double first = VERIFY_GROWS, most = VERIFY_GROWS;
  const double relative = relative_error(name);
  share_t whole, share;
  *grows = 0.0;
  measure(d->held, &with->lines, after);
  measure(d->held, without, before);
  TRY(share_of(d->held, with, without, NULL, &whole, why));
  name->held_share = whole.adds > 0.0 ? whole.has / whole.adds : (double)NAN;
  const bool worse = balance(after, before) > 0.0 && contradicts(&whole, relative); // by both measures
  if (grown(after, before, none, &first) < 0 && !worse) return DONE;
  TRY(blur_of(d, name->candidate, with->color, blur, white, why));
  TRY(share_of(d->held, with, without, white, &share, why));
  const int ch = grown(after, before, blur, &most);
  const bool lacks = worse && contradicts(&share, relative);
  const int shown = ch < 0 ? grows_most(after, before) : ch;
  if ((ch < 0 && !lacks) || shown < 0) return DONE;
  *grows = ch < 0 ? 1.0 : most;
  *so = (withdrawn_t){.fx = found_use(d->found, name)->fx,
                      .candidate = name->candidate,
                      .channel = shown,
                      .without = before[shown],
                      .with = after[shown],
                      .by_share = ch < 0,
                      .share = lacks ? share.has / share.adds : 1.0,
                      .stderr_ = lacks ? hypot(sqrt(share.squares) / share.adds, relative) : 0.0};
  return DONE;
}

// Finds the name that they contradict most; -1: none.
static done_t find_worst(const verify_job_t *d, int *worst, withdrawn_t *why_so, why_t *why) {
  with_all_t with;
  lines_t without = {.r = {NULL}};
  double most = 0.0;
  *worst = -1;
  done_t status = lines_without(d, ALL_NAMES, &with.lines, NULL, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++) with.color[ch] = color_of(d->held, ch, &with.lines);
  for (int i = 0; i < d->found->n && status == DONE; i++) {
    named_t *const name = &d->found->named[i];
    withdrawn_t so;
    double grows = 0.0;
    status = lines_without(d, name->candidate, &without, NULL, why);
    if (status == DONE) status = try_name(d, name, &with, &without, &so, &grows, why);
    lines_free(&without);
    if (status != DONE || !(grows > most || (grows == most && grows > 0.0 && so.share < why_so->share)))
      continue;
    most = grows;
    *worst = i;
    *why_so = so;
  }
  lines_free(&with.lines);
  return status;
}

done_t verify_names(const verify_job_t *d, withdrawn_list_t *withdrawn, why_t *why) {
  int worst = 0;
  withdrawn->n = 0;
  while (is_judged(d) && d->found->n > 0) {
    TRY(find_worst(d, &worst, &withdrawn->name[withdrawn->n], why));
    if (worst < 0) return DONE;
    by_turns_drop(d->turns, withdrawn->name[withdrawn->n++].candidate);
    found_withdraw(d->found, worst);
  }
  return DONE;
}
