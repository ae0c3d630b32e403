// gusts.c - splits a force's residual into noise of the moment and forces that last for a while.
#include "gap/3_feedback/gusts.h"

#include "base/nth.h"
#include "base/random.h"
#include "gap/2_predict/residual.h"
#include <math.h>

enum {
  STRETCH_BLOCKS = 2,          // 4 s: a vehicle takes seconds to pass through something, and a gust less
  LAGS = (int)RESIDUAL_HZ + 1, // rows: up to a second
  SLOW_LAG = 2,                // rows: at smaller lags the filter correlates them
  TAUS = 5,     // one row, then twice as long each; of more than 16 rows a stretch has too little
  WHITE = TAUS, // the last trial
  TRIALS,
  ENOUGH_ROWS = 4000 // four flights of 40 s: a trial's own error then adds little to the log's
};

// --- covariances ------------------------------------------------------------------------------------------

// Covariances by channel, over the quieter half of the stretches.
typedef struct {
  double of[CH_FORCES][LAGS]; // sums of products of rows that far apart, over the number of all rows
  double changes[CH_FORCES];  // half the mean square of the changes from row to row
} lags_t;

// One stretch, about its mean.
typedef struct {
  double of[LAGS];
  double changes, pairs; // sum of squares of the changes from row to row, and their number
  double slow;           // sum of the products from SLOW_LAG on, per row
} stretch_t;

// Returns the end of the stretch that begins with row `from`.
static int stretch_end(const rows_t *r, int from) {
  int end = from;
  while (end < r->n && r->flight[end] == r->flight[from] && r->block[end] < r->block[from] + STRETCH_BLOCKS)
    end++;
  return end;
}

static stretch_t stretch_of(const rows_t *r, const double *v, int from, int end) {
  stretch_t s = {.slow = 0.0};
  double mean = 0.0;
  for (int i = from; i < end; i++) mean += v[i] / (end - from);
  for (int i = from, first = from; i < end; i++) {
    if (!r->follows[i]) first = i;
    for (int lag = 0; lag < LAGS && i - lag >= first; lag++) s.of[lag] += (v[i] - mean) * (v[i - lag] - mean);
    if (i == first) continue;
    s.changes += (v[i] - v[i - 1]) * (v[i] - v[i - 1]);
    s.pairs += 1.0;
  }
  for (int lag = SLOW_LAG; lag < LAGS; lag++) s.slow += s.of[lag] / (end - from);
  return s;
}

static done_t add_lags(const set_t *s, const double *v, double sum[LAGS], double *changes, why_t *why) {
  const rows_t *const r = &s->smooth;
  const size_t room = (size_t)s->n_block + 1;
  stretch_t *const stretch = malloc(room * sizeof *stretch);
  double *const slow = malloc(room * sizeof *slow), squares = 0.0, pairs = 0.0;
  int n = 0;
  for (int from = 0, end; stretch && slow && from < r->n; from = end, n++) {
    end = stretch_end(r, from);
    stretch[n] = stretch_of(r, v, from, end);
    slow[n] = stretch[n].slow;
  }
  const double most = n ? nth_smallest(slow, n, (n - 1) / 2) : 0.0;
  for (int k = 0; k < n; k++) {
    if (stretch[k].slow > most) continue;
    for (int lag = 0; lag < LAGS; lag++) sum[lag] += stretch[k].of[lag] / r->n;
    squares += stretch[k].changes;
    pairs += stretch[k].pairs;
  }
  *changes += pairs > 0.0 ? 0.5 * squares / pairs : 0.0;
  const bool good = stretch && slow;
  free(stretch);
  free(slow);
  return good ? DONE : error_failed(why, "out of memory");
}

static done_t add_forces(const set_t *s, double *const row[CHANNELS], lags_t *sum, why_t *why) {
  for (int ch = 0; ch < CH_FORCES; ch++)
    if (residual_has(s, ch)) TRY(add_lags(s, row[ch], sum->of[ch], &sum->changes[ch], why));
  return DONE;
}

// --- trials -----------------------------------------------------------------------------------------------

static double tau_of(int k) {
  return k == WHITE ? 0.0 : ldexp(GUST_QUICK_S, k);
}

// Draws one number per point of a flight: first-order Gauss-Markov of variance 1, white where tau_s is 0.
static void draw(const grid_t *g, double tau_s, random_t *random, double *v) {
  const double keep = tau_s > 0.0 ? exp(-g->period_s / tau_s) : 0.0, fresh = sqrt(1.0 - keep * keep);
  random_normals(random, g->n, v);
  for (int j = 1; j < g->n; j++) v[j] = keep * v[j - 1] + fresh * v[j];
}

// Turns noise of a velocity into that of the acceleration that is made of it.
static void differentiate(const grid_t *g, double *v) {
  double before = v[0];
  for (int j = 1; j + 1 < g->n; j++) {
    const double here = v[j];
    v[j] = (v[j + 1] - before) / (2.0 * g->period_s);
    before = here;
  }
  v[0] = v[g->n - 1] = 0.0;
}

// Draws rows: white noise as what is measured, lasting forces as what is predicted.
static done_t draw_rows(const set_t *s, double tau_s, unsigned long seed, double *const row[CHANNELS],
                        why_t *why) {
  random_t *const random = random_open(seed);
  flight_lines_t l = {.room = NULL};
  const bool good = random && flight_lines_make(&l, s);
  double *const forces[CHANNELS] = {row[CH_FX], row[CH_FY], row[CH_FZ]};
  for (int f = 0; good && f < s->n_grid; f++) {
    for (int ch = 0; ch < CH_FORCES; ch++) {
      draw(&s->grid[f], tau_s, random, l.base[ch]);
      if (tau_s == 0.0 && s->grid[f].acceleration_made) differentiate(&s->grid[f], l.base[ch]);
    }
    residual_rows(s, f, tau_s > 0.0 ? SERIES_PREDICTED : SERIES_RATE, (const double *const *)l.base,
                  l.scratch, forces);
  }
  free(l.room);
  random_close(random);
  return good ? DONE : error_failed(why, "out of memory");
}

static done_t add_trial(const set_t *s, int k, unsigned long seed, lags_t *sum, why_t *why) {
  lines_t l;
  done_t status = lines_make(&l, s, why);
  if (status == DONE) status = draw_rows(s, tau_of(k), seed, l.r, why);
  if (status == DONE) status = add_forces(s, l.r, sum, why);
  lines_free(&l);
  return status;
}

// Makes all trials: of each the mean over as many draws as give ENOUGH_ROWS.
static done_t try_all(const set_t *s, unsigned long seed, lags_t trial[TRIALS], why_t *why) {
  const int times = 1 + (ENOUGH_ROWS - 1) / (s->smooth.n > 0 ? s->smooth.n : ENOUGH_ROWS);
  done_t status = DONE;
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < TRIALS; k++) {
    why_t own;
    done_t each = DONE;
    trial[k] = (lags_t){.changes = {0.0}};
    for (int i = 0; i < times && each == DONE; i++)
      each = add_trial(s, k, seed + (unsigned long)i, &trial[k], &own);
    for (int ch = 0; ch < CH_FORCES; ch++) {
      trial[k].changes[ch] /= times;
      for (int lag = 0; lag < LAGS; lag++) trial[k].of[ch][lag] /= times;
    }
    if (each == DONE) continue;
#pragma omp critical
    {
      status = each;
      *why = own;
    }
  }
  return status;
}

// --- the log's covariances as a sum of both ---------------------------------------------------------------

static double product(const double a[LAGS], const double b[LAGS]) {
  double sum = 0.0;
  for (int lag = 0; lag < LAGS; lag++) sum += a[lag] * b[lag];
  return sum;
}

// Variances by least squares, none below 0.
typedef struct {
  double lasting, white;
  double left; // share of the sum of squares
} fit_t;

static fit_t fit(const double log[LAGS], const double lasting[LAGS], const double white[LAGS]) {
  const double aa = product(lasting, lasting), ab = product(lasting, white), bb = product(white, white),
               al = product(lasting, log), bl = product(white, log), ll = product(log, log),
               det = aa * bb - ab * ab;
  fit_t f = {.left = 1.0};
  if (!(ll > 0.0 && det > 0.0)) return f;
  f.lasting = (al * bb - bl * ab) / det;
  f.white = (bl * aa - al * ab) / det;
  if (f.lasting < 0.0 || f.white < 0.0) {
    const bool only_white = bl > 0.0 && (al <= 0.0 || bl * bl * aa >= al * al * bb);
    f.lasting = only_white ? 0.0 : fmax(al, 0.0) / aa;
    f.white = only_white ? bl / bb : 0.0;
  }
  f.left = 1.0 - (f.lasting * al + f.white * bl) / ll;
  return f;
}

// Moving air pushes along all axes alike: what one axis has beyond the median of the axes is no gust.
static void take_gusts(const set_t *s, const double sd[CH_FORCES], gusts_t *to) {
  double of[CH_FORCES];
  int n = 0;
  for (int ch = 0; ch < CH_FORCES; ch++)
    if (residual_has(s, ch)) of[n++] = sd[ch];
  const double middle = n ? nth_smallest(of, n, (n - 1) / 2) : 0.0;
  for (int ch = 0; ch < CH_FORCES; ch++) to->force_mps2[ch] = fmin(sd[ch], middle);
}

// Finds what changes from row to row beyond the gusts and the noise of two sensor samples.
static void find_quick(const set_t *s, const lags_t *log, const lags_t trial[TRIALS], const lags_t *lasting,
                       const double white[CH_FORCES], gusts_t *to) {
  const double every = s->grid[0].every; // a point is the mean of so many samples
  for (int ch = 0; ch < CH_FORCES; ch++) {
    const double of_white = trial[WHITE].changes[ch] / every;
    const double left = log->changes[ch] - to->force_mps2[ch] * to->force_mps2[ch] * lasting->changes[ch] -
                        white[ch] * white[ch] * of_white;
    to->quick_mps2[ch] = to->velocity_mps[ch] = 0.0;
    if (!(left > 0.0 && of_white > 0.0)) continue;
    if (s->grid[0].acceleration_made)
      to->velocity_mps[ch] = sqrt(left / of_white);
    else
      to->quick_mps2[ch] = sqrt(left / trial[0].changes[ch]);
  }
}

done_t gusts_of(const set_t *s, double *const residual[CHANNELS], const double white[CH_FORCES],
                unsigned long seed, gusts_t *to, why_t *why) {
  lags_t trial[TRIALS], log = {.changes = {0.0}};
  double least = HUGE_VAL;
  *to = (gusts_t){.tau_s = GUST_QUICK_S};
  TRY(add_forces(s, residual, &log, why));
  TRY(try_all(s, seed, trial, why));
  for (int k = 0; k < TAUS; k++) {
    double left = 0.0, sd[CH_FORCES];
    for (int ch = 0; ch < CH_FORCES; ch++) {
      const fit_t f = fit(log.of[ch], trial[k].of[ch], trial[WHITE].of[ch]);
      left += f.left;
      sd[ch] = sqrt(f.lasting);
    }
    if (!(left < least)) continue;
    least = left;
    to->tau_s = tau_of(k);
    take_gusts(s, sd, to);
    find_quick(s, &log, trial, &trial[k], white, to);
  }
  return DONE;
}
