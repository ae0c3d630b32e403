// bench_gap.c - how the time of a diagnosis grows with the log and with the candidates.
#define _POSIX_C_SOURCE 200809L
#include "bench_gap.h"

#include "flight/setup.h"
#include "gap/diagnose.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#define RUNS    3
#define RATE    500.0
#define LONG_S  120.0
#define SHORT_S 30.0 // in 15 s nothing is named, in more two effects: no measure of growth
#define ROUNDS  12
#define ROUND_S (LONG_S / ROUNDS)
#define START_S 5.0 // by then it flies where it was told to be

typedef struct {
  int candidates, named, rounds;
} count_t;

// Wall-clock time, and the time of all processors together.
typedef struct {
  double wall_s, processors_s;
} took_t;

static double clock_s(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static took_t now(void) {
  return (took_t){clock_s(CLOCK_MONOTONIC), clock_s(CLOCK_PROCESS_CPUTIME_ID)};
}

// Returns the number of cores that may be used: as many threads as OMP_NUM_THREADS says, else all of the
// machine.
static int cores(void) {
  const long there = sysconf(_SC_NPROCESSORS_ONLN);
  const char *const wanted = getenv("OMP_NUM_THREADS");
  const int threads = wanted ? atoi(wanted) : 0;
  return threads > 0 && threads < there ? threads : (int)there;
}

// Writes the flight as a log, and reads it as any other.
static done_t write_log(const record_t *record, gap_flight_t *log, const model_t *vehicle, why_t *why) {
  const char *const folder = getenv("O");
  char path[4096];
  snprintf(path, sizeof path, "%s/bench-XXXXXX", folder && folder[0] ? folder : "out");
  columns_t columns;
  TRY(columns_read("tools/columns/fly.toml", &columns, why));
  const int fd = mkstemp(path);
  FILE *const file = fd < 0 ? NULL : fdopen(fd, "w");
  if (!file) return error_failed(why, "%s: cannot be written", path);
  record_write(record, file);
  fclose(file);
  const done_t status = gap_read(log, path, &columns, vehicle, why);
  unlink(path);
  return status;
}

// Equal rounds, down to 4 cm below the ceiling, so that a longer log has more of the same flight. The part
// that is fitted, two thirds, holds whole rounds in every log.
static void plan_rounds(const setup_t *setup, plan_t *plan) {
  static const double gap_m[] = {0.20, 0.04};
  enum { STEPS = sizeof gap_m / sizeof *gap_m };
  _Static_assert(ROUNDS * STEPS <= WAYPOINTS_MAX, "every round has room");
  plan->n_way = ROUNDS * STEPS;
  for (int i = 0; i < plan->n_way; i++)
    plan->way[i] = (waypoint_t){ROUND_S / STEPS * i, setup->model.ceiling_m - gap_m[i % STEPS]};
  plan->end_s = START_S + LONG_S + 1.0;
}

static done_t fly_log(const model_t *vehicle, gap_flight_t *log, why_t *why) {
  static const double start_m[] = {0.20};
  setup_t setup;
  flown_t flown;
  TRY(setup_thesis(&setup, FLY_INDI_THEORY, why));
  const request_t request = {.integrate = INTEGRATE_RK4, .seed = 1, .log = true, .log_500_Hz = true};
  TRY(setup_apply(&setup, &request, why));
  setup_ladder(&setup, start_m, 1, 0.0);
  plan_rounds(&setup, &setup.plan);
  TRY(setup_fly(&setup, &flown, why));
  const done_t status = write_log(&flown.record, log, vehicle, why);
  flown_free(&flown);
  return status;
}

// Returns span_s of a log, from START_S on.
static gap_flight_t part_of(const gap_flight_t *log, double span_s) {
  gap_flight_t part = *log;
  int from = 0;
  while (from < log->n - 1 && log->t_s[from] - log->t_s[0] < START_S) from++;
  part.n -= from;
  part.t_s += from;
  for (int i = 0; i < SIG_COUNT; i++)
    if (part.v[i]) part.v[i] += from;
  if (part.saturated) part.saturated += from;
  if (part.segment) part.segment += from;
  while (part.n > 1 && part.t_s[part.n - 1] - part.t_s[0] > span_s) part.n--;
  return part;
}

static done_t time_one(const gap_flight_t *log, double span_s, const model_t *m, took_t *best, count_t *count,
                       why_t *why) {
  gap_flight_t part = part_of(log, span_s);
  const gap_flights_t fit = {&part, 1};
  const diagnose_job_t job = {.fit = &fit, .model = m, .seed = 1};
  *best = (took_t){HUGE_VAL, HUGE_VAL};
  done_t status = DONE;
  for (int run = 0; run < RUNS && status == DONE; run++) {
    diagnosis_t d;
    const took_t from = now();
    status = diagnose(&job, &d, why);
    const took_t to = now();
    best->wall_s = fmin(best->wall_s, to.wall_s - from.wall_s);
    best->processors_s = fmin(best->processors_s, to.processors_s - from.processors_s);
    *count = (count_t){d.candidates.n, d.found.n, d.rounds};
    diagnosis_free(&d);
  }
  return status;
}

// Adds every effect of the table from the `keep`-th on to the model, with size 0, so that it is no candidate.
static done_t with_fewer(const model_t *vehicle, int keep, model_t *m, why_t *why) {
  *m = *vehicle;
  for (int i = 0, kept = 0; i < fx_count; i++) {
    if (fx_table[i]->n_size == 0 || kept++ < keep) continue;
    fx_use_t use = fx_use(fx_table[i]);
    for (int k = 0; k < use.fx->n_size; k++) use.p[use.fx->size[k].param] = 0.0;
    TRY(model_add_fx(m, &use, why));
  }
  return DONE;
}

static done_t by_length(const gap_flight_t *log, const model_t *vehicle, why_t *why) {
  double first_s = 0.0;
  for (double span_s = SHORT_S; span_s <= LONG_S; span_s *= 2.0) {
    took_t took;
    count_t n;
    TRY(time_one(log, span_s, vehicle, &took, &n, why));
    if (span_s == SHORT_S) first_s = took.wall_s;
    printf("diagnosis of %3.0f s at %.0f Hz, %2d candidates, %d named in %2d rounds: %5.2f s on %d cores "
           "(%5.2f s "
           "of processors), %4.0f x real time; log x %2.0f, time x %4.1f\n",
           span_s, RATE, n.candidates, n.named, n.rounds, took.wall_s, cores(), took.processors_s,
           span_s / took.wall_s, span_s / SHORT_S, took.wall_s / first_s);
    fflush(stdout);
  }
  return DONE;
}

static done_t by_candidates(const gap_flight_t *log, const model_t *vehicle, why_t *why) {
  static const int keep[] = {13, 17, FX_MAX};
  double first_s = 0.0;
  int first_n = 1;
  for (unsigned i = 0; i < sizeof keep / sizeof *keep; i++) {
    model_t m;
    took_t took;
    count_t n;
    TRY(with_fewer(vehicle, keep[i], &m, why));
    TRY(time_one(log, 60.0, &m, &took, &n, why));
    if (i == 0) first_s = took.wall_s, first_n = n.candidates;
    printf(
        "diagnosis of  60 s at %.0f Hz, %2d candidates, %d named in %2d rounds: %5.2f s on %d cores (%5.2f s "
        "of processors); candidates x %4.2f, time x %4.2f\n",
        RATE, n.candidates, n.named, n.rounds, took.wall_s, cores(), took.processors_s,
        (double)n.candidates / first_n, took.wall_s / first_s);
    fflush(stdout);
  }
  return DONE;
}

done_t bench_gap(why_t *why) {
  model_t vehicle;
  gap_flight_t log = {.n = 0};
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  vehicle.n_fx = 0;
  vehicle.ceiling_m = 0.5;
  TRY(fly_log(&vehicle, &log, why));
  done_t status = by_length(&log, &vehicle, why);
  if (status == DONE) status = by_candidates(&log, &vehicle, why);
  gap_flight_free(&log);
  return status;
}
