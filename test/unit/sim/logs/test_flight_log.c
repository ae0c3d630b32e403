// test_outer_log.c - logs of any rate on the 100 Hz grid; gaps, sparse sensors, and what contradicts itself.
#include "logs/flight_log.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

static const model_t NEWTON = {.name = "newton", .thrust_max_N = 0.5};
#define NAMES                                                                                                \
  "timestamp,stateEstimate.z,stateEstimate.vz,stateEstimate.qw,stateEstimate.qx,stateEstimate.qy,"           \
  "stateEstimate.qz,"                                                                                        \
  "acc.x,acc.y,acc.z,indi.thrust,range.up\n"

typedef struct {
  int ticks, splits, range_new;
  double z_last, error_max; // of z against `z_at`
  flight_log_count_t count;
} seen_t;

// A climb of 0.1 m/s from 0.5 m at t = 1 s.
static double z_at(double t_s) {
  return 0.5 + 0.1 * (t_s - 1.0);
}

static done_t see(const char *path, double late_s, seen_t *s, why_t *why) {
  const columns_t c = columns_crazyflie();
  const signals_t need = SIGNAL_BIT(SIG_Z) | SIGNAL_BIT(SIG_THRUST);
  *s = (seen_t){0};
  flight_log_t *log;
  flight_tick_t tick;
  bool more;
  done_t status;
  TRY(flight_log_open(&log, path, &c, &NEWTON, need, why));
  while ((status = flight_log_next(log, &tick, &more, why)) == DONE && more) {
    s->ticks++;
    s->splits += tick.split;
    s->range_new += tick.range_new;
    s->z_last = tick.v[SIG_Z];
    const double error = fabs(tick.v[SIG_Z] - z_at(tick.v[SIG_TIME] - (tick.split ? 0.0 : late_s)));
    s->error_max = error > s->error_max ? error : s->error_max;
  }
  s->count = flight_log_count(log);
  flight_log_close(log);
  return status;
}

// A climbing flight of `n` rows that are dt_ms apart; the scales make units wrong. A range sample every 100
// ms.
typedef struct {
  double dt_ms, time, z, vz, acc;
  int n, gap_from, gap_rows; // rows left out
  int nan_row;               // z is a gap
} made_t;

static const char *write_flight(const made_t *f) {
  char text[400000];
  size_t used = (size_t)snprintf(text, sizeof text, NAMES);
  for (int i = 0; i < f->n && used < sizeof text - 200; i++) {
    if (i >= f->gap_from && i < f->gap_from + f->gap_rows) continue;
    const double t_ms = 1000.0 + f->dt_ms * i;
    char z[32];
    snprintf(z, sizeof z, "%.9f", f->z * z_at(1e-3 * t_ms));
    used += (size_t)snprintf(text + used, sizeof text - used, "%.4f,%s,%.4f,1,0,0,0,0,0,%.6f,0.3,%d\n",
                             f->time * t_ms, f->nan_row > 0 && i == f->nan_row ? "nan" : z, 0.1 * f->vz,
                             f->acc, 500 - (int)(t_ms / 100.0));
  }
  return scratch_file("f.csv", text, -1);
}

TEST(outer_log_brings_every_rate_to_its_grid) {
  static const struct {
    const char *what;
    made_t f;
    double late_s; // a mean over the rows of a tick's period is as old as their middle
    seen_t want;
  } row[] = {
      {"100 Hz", {10.0, 1, 1, 1, 1, 200, 0, 0, 0}, 0.0, {.ticks = 200, .splits = 1, .range_new = 20}},
      {"101.2 Hz", {9.88, 1, 1, 1, 1, 203, 0, 0, 0}, 0.0, {.ticks = 200, .splits = 1, .range_new = 20}},
      {"500 Hz", {2.0, 1, 1, 1, 1, 1001, 0, 0, 0}, 0.004, {.ticks = 201, .splits = 1, .range_new = 21}},
      {"25 Hz", {40.0, 1, 1, 1, 1, 51, 0, 0, 0}, 0.0, {.ticks = 201, .splits = 1, .range_new = 21}},
      {"a short gap", {10.0, 1, 1, 1, 1, 200, 50, 10, 0}, 0.0, {.ticks = 200, .splits = 1, .range_new = 19}},
      {"a long gap", {10.0, 1, 1, 1, 1, 200, 50, 30, 0}, 0.0, {.ticks = 170, .splits = 2, .range_new = 17}},
      {"a row without z",
       {10.0, 1, 1, 1, 1, 200, 0, 0, 7},
       0.0,
       {.ticks = 200, .splits = 1, .range_new = 20, .count = {.gaps = 1}}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    seen_t s;
    why_t why = {""};
    CHECK_OK(see(write_flight(&row[i].f), row[i].late_s, &s, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(s.ticks, row[i].want.ticks, 0);
    CHECK_NEAR(s.splits, row[i].want.splits, 0);
    CHECK_NEAR(s.range_new, row[i].want.range_new, 0);
    CHECK_NEAR(s.count.gaps, row[i].want.count.gaps, 0);
    CHECK_NEAR(s.error_max, 0.0, 1e-8);
  }
}

static const struct {
  const char *what;
  made_t f;
  const char *want;
} contradicting[] = {
    {"time in s",
     {10.0, 1e-3, 1, 1, 1, 200, 0, 0, 0},
     "f.csv:201: column timestamp: rows are apart by 1e-05 s over the whole flight; allowed: 0.0001 to "
     "0.15 s; the unit s "
     "would fit (factor 1000)"},
    {"time in us",
     {10.0, 1e3, 1, 1, 1, 200, 0, 0, 0},
     "f.csv:201: column timestamp: rows are apart by 10 s over the whole flight; allowed: 0.0001 to 0.15 "
     "s; the unit us would "
     "fit (factor 0.001)"},
    {"acceleration in m/s2",
     {10.0, 1, 1, 1, 9.81, 200, 0, 0, 0},
     "f.csv:201: column acc.z: mean |acceleration| 96.2 m/s2 over the whole flight; allowed: 4.905 to "
     "30.41 m/s2; the unit "
     "m/s2 would fit (factor 0.1019)"},
    {"gravity taken out",
     {10.0, 1, 1, 1, 0.01, 200, 0, 0, 0},
     "f.csv:201: column acc.z: mean |acceleration| 0.0981 m/s2 over the whole flight; allowed: 4.905 to "
     "30.41 m/s2"},
    {"z too small",
     {10.0, 1, 1e-3, 1, 1, 200, 0, 0, 0},
     "f.csv:201: column stateEstimate.z: moves 0.001 times as far as column stateEstimate.vz says over the "
     "whole flight; "
     "allowed: 0.05 to 20"},
    {"z down",
     {10.0, 1, 1, -1, 1, 200, 0, 0, 0},
     "f.csv:201: column stateEstimate.z: moves -1 times as far as column stateEstimate.vz says over the "
     "whole flight; "
     "allowed: 0.05 to 20"},
    {"time stands",
     {0.0, 1, 1, 1, 1, 200, 0, 0, 0},
     "f.csv:3: column timestamp: 1 s after 1 s; allowed: time that increases from row to row"},
    {"time runs back",
     {-10.0, 1, 1, 1, 1, 50, 0, 0, 0},
     "f.csv:3: column timestamp: 0.99 s after 1 s; allowed: time that increases from row to row"},
};

TEST(outer_log_refuses_what_contradicts_itself) {
  for (unsigned i = 0; i < sizeof contradicting / sizeof *contradicting; i++) {
    ROW("%s", contradicting[i].what);
    seen_t s;
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, see(write_flight(&contradicting[i].f), 0.0, &s, &why));
    CHECK_TEXT(scratch_short(why.text), contradicting[i].want);
  }
}
