// effectiveness.c - control effectiveness by least squares.
#include "logs/effectiveness.h"

#include "base/lowpass.h"
#include "base/lsq.h"
#include "logs/effectiveness_log.h"
#include <math.h>
#include <string.h>

#define TICK_MS (1e3 * EFFECTIVENESS_PERIOD_S)

#define DELAY_MAX 64 // ticks, more than EFFECTIVENESS_DELAY_S

// A signal through both sections of the filter, and its last three values.
typedef struct {
  lowpass_t section[2];
  double now, last, before;
} signal_t;

// Sums of products of d u, d u' and d w'; for normal equations, so that a log may have any length.
typedef struct {
  double uu, uv, vv, uy, vy, yy;
} sums_t;

typedef struct {
  const effectiveness_job_t *job;
  effectiveness_log_t log;
  double last[COLUMNS];      // row before
  bool moved[COLUMNS];       // between any two rows
  double lagged[3];          // motors
  double sent[DELAY_MAX][3]; // the newest commands, by tick
  signal_t rate[3], motor[3];
  long since_start; // ticks; < 0: no row yet
  sums_t sums[3];
  effectiveness_t *result;
} pass_t;

effectiveness_job_t effectiveness_default(void) {
  return (effectiveness_job_t){
      .lag_s = 0.0625, .cutoff_Hz = 4.0, .poles = 4, .thrust_min = 10000.0, .motor_max_N = 0.12};
}

effectiveness_job_t effectiveness_stock(void) {
  return (effectiveness_job_t){
      .lag_s = 0.0617, .cutoff_Hz = 4.0, .poles = 4, .as_stock = true, .motor_max_N = 0.12};
}

// --- signals ------------------------------------------------------------------------------------------

static void signal_start(signal_t *s, const effectiveness_job_t *job, double value) {
  const double rate_Hz = 1.0 / EFFECTIVENESS_PERIOD_S, pi = acos(-1.0);
  const int sections = job->poles / 2;
  for (int i = 0; i < sections; i++)
    lowpass_init_q(&s->section[i], job->cutoff_Hz, rate_Hz, 2.0 * cos(pi * (2 * i + 1) / (4.0 * sections)),
                   value);
  s->now = s->last = s->before = value;
}

static void signal_step(signal_t *s, const effectiveness_job_t *job, double x) {
  for (int i = 0; i < job->poles / 2; i++) x = lowpass_step(&s->section[i], x);
  s->before = s->last;
  s->last = s->now;
  s->now = x;
}

static void start(pass_t *p, const double row[COLUMNS]) {
  for (int i = 0; i < 3; i++) {
    const bool rest = p->job->as_stock;
    p->lagged[i] = rest ? 0.0 : row[COMMAND + i];
    signal_start(&p->rate[i], p->job, rest ? 0.0 : row[RATE + i]);
    signal_start(&p->motor[i], p->job, p->lagged[i]);
    for (int k = 0; k < DELAY_MAX; k++) p->sent[k][i] = p->lagged[i];
  }
  p->since_start = 0;
  p->result->starts++;
}

static void sum(pass_t *p, int axis) {
  const double h = EFFECTIVENESS_PERIOD_S;
  const signal_t *w = &p->rate[axis], *u = &p->motor[axis];
  const double y = (w->now - 2.0 * w->last + w->before) / (h * h);
  const double v = (u->now - 2.0 * u->last + u->before) / (h * h);
  const double du = p->job->as_stock ? (u->now - u->last) / h : (u->now - u->before) / (2.0 * h);
  sums_t *const s = &p->sums[axis];
  s->uu += du * du;
  s->uv += du * v;
  s->vv += v * v;
  s->uy += du * y;
  s->vy += v * y;
  s->yy += y * y;
}

// One tick of 2 ms; `before` is the one before it.
static void tick(pass_t *p, const double before[COLUMNS], const double row[COLUMNS]) {
  const effectiveness_job_t *job = p->job;
  const double gain = 1.0 - exp(-EFFECTIVENESS_PERIOD_S / job->lag_s);
  const double *command = (job->as_stock ? row : before) + COMMAND;
  const long delay = lround(job->delay_s / EFFECTIVENESS_PERIOD_S), at = p->since_start % DELAY_MAX;
  memcpy(p->sent[at], command, sizeof p->sent[at]);
  const double *acting = p->sent[(at + DELAY_MAX - delay) % DELAY_MAX];
  for (int i = 0; i < 3; i++) {
    p->lagged[i] += gain * (acting[i] - p->lagged[i]);
    signal_step(&p->rate[i], job, row[RATE + i]);
    signal_step(&p->motor[i], job, p->lagged[i]);
  }
  p->since_start++;
  const bool settled = (double)p->since_start * EFFECTIVENESS_PERIOD_S >= EFFECTIVENESS_SETTLE_S;
  const bool flies = p->log.column[THRUST] < 0 || row[THRUST] >= job->thrust_min;
  if (!job->as_stock && !(settled && flies)) return;
  p->result->used++;
  for (int i = 0; i < 3; i++) sum(p, i);
}

// --- the log ------------------------------------------------------------------------------------------

// Ticks since the row before: 1, or more in a gap.
static done_t ticks_since(const pass_t *p, const double row[COLUMNS], long *n, why_t *why) {
  const double passed_ms = row[TIME] - p->last[TIME];
  *n = 1;
  if (!(passed_ms > 0.0))
    return table_refuse(&p->log.table, 0, p->log.column[TIME], why, "%g after %g; allowed: rising", row[TIME],
                        p->last[TIME]);
  if (p->job->as_stock) return DONE;
  if (passed_ms > 1e3 * EFFECTIVENESS_GAP_S) {
    *n = 0;
    return DONE;
  }
  *n = lround(passed_ms / TICK_MS);
  if (fabs(passed_ms - TICK_MS * (double)*n) > 0.5)
    return table_refuse(&p->log.table, 0, p->log.column[TIME], why,
                        "%g ms after the row before; allowed: multiples of %g ms", passed_ms, TICK_MS);
  return DONE;
}

static void bridge(pass_t *p, const double row[COLUMNS], long n) {
  double at[COLUMNS], before[COLUMNS];
  memcpy(before, p->last, sizeof before);
  for (long k = 1; k <= n; k++) {
    for (int i = 0; i < COLUMNS; i++)
      at[i] = k == n ? row[i] : p->last[i] + (row[i] - p->last[i]) * (double)k / (double)n;
    tick(p, before, at);
    memcpy(before, at, sizeof before);
  }
  if (n > 1) p->result->bridged += n - 1;
}

static done_t take_rows(pass_t *p, why_t *why) {
  double row[COLUMNS];
  long even = 0;
  for (bool more;;) {
    TRY(table_next(&p->log.table, &more, why));
    if (!more && even > 0 && p->result->rows == 0)
      return table_refuse(
          &p->log.table, 0, p->log.column[TIME], why,
          "even in all rows; allowed: those of odd steps, in which the inner loop runs, or of every call");
    if (!more) return DONE;
    TRY(effectiveness_log_row(&p->log, row, why));
    // Every call was logged: the inner loop runs in the odd ones.
    const bool is_even = p->log.own && fmod(row[TIME], 2.0) < 1.0;
    even += is_even;
    if (is_even) continue;
    p->result->rows++;
    long n = 0;
    if (p->since_start >= 0) TRY(ticks_since(p, row, &n, why));
    for (int i = 0; i < COLUMNS && p->since_start >= 0; i++)
      p->moved[i] = p->moved[i] || row[i] != p->last[i];
    if (n == 0) start(p, row);
    if (n == 0 && p->job->as_stock) tick(p, row, row);
    bridge(p, row, n);
    memcpy(p->last, row, sizeof row);
  }
}

// --- the fit ------------------------------------------------------------------------------------------

static done_t solve(const pass_t *p, int axis, why_t *why) {
  const sums_t *s = &p->sums[axis];
  effectiveness_t *const r = p->result;
  const int n = axis == 2 ? 2 : 1;
  if (r->used == 0 && p->log.column[THRUST] >= 0)
    return error_set(why,
                     "%s: no row counts; allowed: controller.cmd_thrust of %g and more (--thrust-min), "
                     "%g s after a start",
                     p->log.table.path, p->job->thrust_min, EFFECTIVENESS_SETTLE_S);
  // Filters round: a constant signal leaves a little that is no movement.
  const bool commanded = p->moved[COMMAND + axis] && s->uu > 0.0 && (n == 1 || s->vv > 0.0);
  if (!commanded || !p->moved[RATE + axis] || !(s->yy > 0.0))
    return error_set(why,
                     "%s: column %s: never moves while it counts (%ld ticks); allowed: a flight that turns",
                     p->log.table.path, effectiveness_names[(commanded ? RATE : COMMAND) + axis], r->used);
  // Regressors are scaled by the roots of their sums of squares, so that the matrix is well scaled.
  const double ku = sqrt(s->uu), kv = n == 2 ? sqrt(s->vv) : 1.0;
  const double A[4] = {1.0, s->uv / (ku * kv), s->uv / (ku * kv), 1.0}, b[2] = {s->uy / ku, s->vy / kv};
  double x[2] = {0.0, 0.0};
  lsq_solve(n, n, A, b, x);
  r->g1[axis] = x[0] / ku;
  if (n == 2) r->g2 = x[1] / kv;
  r->explained[axis] = (x[0] * b[0] + x[1] * b[1] * (n == 2)) / s->yy;
  if (isfinite(r->g1[axis]) && isfinite(r->g2) && isfinite(r->explained[axis])) return DONE;
  return error_set(why, "%s: columns %s, %s: too large to be fitted; allowed: rad/s and 16-bit units",
                   p->log.table.path, effectiveness_names[RATE + axis], effectiveness_names[COMMAND + axis]);
}

static done_t fit(pass_t *p, why_t *why) {
  TRY(effectiveness_log_find(&p->log, why));
  TRY(take_rows(p, why));
  if (p->result->bridged > p->result->rows)
    return error_set(why, "%s: %ld rows and %ld ticks missing between them; allowed: a log at 500 Hz",
                     p->log.table.path, p->result->rows, p->result->bridged);
  for (int i = 0; i < 3; i++) TRY(solve(p, i, why));
  return DONE;
}

done_t effectiveness_fit(const char *path, const effectiveness_job_t *job, effectiveness_t *result,
                         why_t *why) {
  effectiveness_t found = {.rows = 0};
  pass_t p = {.job = job, .log = {.motor_max_N = job->motor_max_N}, .since_start = -1, .result = &found};
  TRY(table_open(&p.log.table, path, why));
  const done_t status = fit(&p, why);
  table_close(&p.log.table);
  if (status == DONE) *result = found;
  return status;
}
