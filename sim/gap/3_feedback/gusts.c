// gusts.c - splits a force's residual into noise of the moment and forces that last for a while.
#include "gap/3_feedback/gusts.h"

#include "base/nth.h"
#include "base/random.h"
#include "gap/2_predict/residual.h"
#include "gap/3_feedback/stirs.h"
#include <math.h>

enum {
  TAUS = 5,     // one row, then twice as long each; of more than 16 rows a stretch has too little
  WHITE = TAUS, // the last trial
  TRIALS,
  ENOUGH_ROWS = 4000 // four flights of 40 s: a trial's own error then adds little to the log's
};

// --- covariances ------------------------------------------------------------------------------------------

// Covariances by channel.
typedef struct {
  stirs_t of[CH_FORCES];
} lags_t;

static done_t add_forces(const set_t *s, double *const row[CHANNELS], lags_t *sum, why_t *why) {
  for (int ch = 0; ch < CH_FORCES; ch++)
    if (residual_has(s, ch)) TRY(stirs_add(&sum->of[ch], s, row[ch], why));
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
    trial[k] = (lags_t){.of = {{.changes = 0.0}}};
    for (int i = 0; i < times && each == DONE; i++)
      each = add_trial(s, k, seed + (unsigned long)i, &trial[k], &own);
    for (int ch = 0; ch < CH_FORCES; ch++) {
      trial[k].of[ch].changes /= times;
      trial[k].of[ch].share /= times;
      trial[k].of[ch].level /= times;
      for (int lag = 0; lag < STIRS_LAGS; lag++) trial[k].of[ch].lag[lag] /= times;
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

static double product(const double a[STIRS_LAGS], const double b[STIRS_LAGS]) {
  double sum = 0.0;
  for (int lag = 0; lag < STIRS_LAGS; lag++) sum += a[lag] * b[lag];
  return sum;
}

// Variances by least squares, none below 0.
typedef struct {
  double lasting, white;
  double left; // share of the sum of squares
} fit_t;

static fit_t fit(const double log[STIRS_LAGS], const double lasting[STIRS_LAGS],
                 const double white[STIRS_LAGS]) {
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
    const double of_white = trial[WHITE].of[ch].changes / every;
    const double left = log->of[ch].changes -
                        to->force_mps2[ch] * to->force_mps2[ch] * lasting->of[ch].changes -
                        white[ch] * white[ch] * of_white;
    to->quick_mps2[ch] = to->velocity_mps[ch] = 0.0;
    if (!(left > 0.0 && of_white > 0.0)) continue;
    if (s->grid[0].acceleration_made)
      to->velocity_mps[ch] = sqrt(left / of_white);
    else
      to->quick_mps2[ch] = sqrt(left / trial[0].of[ch].changes);
  }
}

done_t gusts_of(const set_t *s, double *const residual[CHANNELS], const double white[CH_FORCES],
                unsigned long seed, gusts_t *to, why_t *why) {
  lags_t trial[TRIALS], log = {.of = {{.changes = 0.0}}};
  double least = HUGE_VAL;
  *to = (gusts_t){.tau_s = GUST_QUICK_S};
  TRY(add_forces(s, residual, &log, why));
  TRY(try_all(s, seed, trial, why));
  for (int k = 0; k < TAUS; k++) {
    double left = 0.0, sd[CH_FORCES];
    for (int ch = 0; ch < CH_FORCES; ch++) {
      const fit_t f = fit(log.of[ch].lag, trial[k].of[ch].lag, trial[WHITE].of[ch].lag);
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
