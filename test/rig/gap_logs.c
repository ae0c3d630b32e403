// gap_logs.c - flights of the exam as log files.
#include "rig/gap_logs.h"

#include "exam/plan.h"
#include "rig/scratch.h"
#include "rig/usd_bytes.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
  signal_id_t signal;
  const char *name;
  double factor; // unit of the cell per SI unit
} COLUMN[] = {
    {SIG_X, "stateEstimate.x", 1.0},   {SIG_Y, "stateEstimate.y", 1.0},   {SIG_Z, "stateEstimate.z", 1.0},
    {SIG_VX, "stateEstimate.vx", 1.0}, {SIG_VY, "stateEstimate.vy", 1.0}, {SIG_VZ, "stateEstimate.vz", 1.0},
    {SIG_AX, "acc.x", 1.0 / 9.81},     {SIG_AY, "acc.y", 1.0 / 9.81},     {SIG_AZ, "acc.z", 1.0 / 9.81},
    {SIG_QW, "stateEstimate.qw", 1.0}, {SIG_QX, "stateEstimate.qx", 1.0}, {SIG_QY, "stateEstimate.qy", 1.0},
    {SIG_QZ, "stateEstimate.qz", 1.0}, {SIG_GX, "gyro.x", 57.29577951},   {SIG_GY, "gyro.y", 57.29577951},
    {SIG_GZ, "gyro.z", 57.29577951},   {SIG_M1, "indi.m1", 1.0},          {SIG_M2, "indi.m2", 1.0},
    {SIG_M3, "indi.m3", 1.0},          {SIG_M4, "indi.m4", 1.0},          {SIG_VBAT, "pm.vbat", 1.0},
    {SIG_RANGE, "range.up", 1000.0}};
// If the flight has them.
static const struct {
  signal_id_t signal;
  const char *name;
} TOLD[] = {{SIG_SET_X, "ctrltarget.x"}, {SIG_SET_Y, "ctrltarget.y"}, {SIG_SET_Z, "ctrltarget.z"}};
#define COLUMNS (sizeof COLUMN / sizeof *COLUMN)

// Delayed as the Crazyflie's filters delay the signal.
static double cell(const gap_flight_t *f, const columns_t *columns, unsigned k, int i) {
  const double *const v = f->v[COLUMN[k].signal];
  const double at = fmax(i - columns->of[COLUMN[k].signal].late_s * f->rate_Hz, 0.0), part = at - floor(at);
  const int j = (int)at;
  return COLUMN[k].factor * (part > 0.0 ? (1.0 - part) * v[j] + part * v[j + 1] : v[j]);
}

void gap_log_write(const gap_flight_t *f, const char *path) {
  FILE *const file = fopen(path, "w");
  if (!file) abort();
  const columns_t columns = columns_crazyflie();
  fputs("timestamp", file);
  for (unsigned k = 0; k < COLUMNS; k++) fprintf(file, ",%s", COLUMN[k].name);
  for (int k = 0; k < 3 && f->v[SIG_SET_X]; k++) fprintf(file, ",%s", TOLD[k].name);
  fputc('\n', file);
  for (int i = 0; i < f->n; i++) {
    fprintf(file, "%.3f", 1e3 * f->t_s[i]);
    for (unsigned k = 0; k < COLUMNS; k++) {
      const double v = cell(f, &columns, k, i);
      if (isnan(v))
        fputs(",nan", file);
      else
        fprintf(file, ",%.8g", v);
    }
    for (int k = 0; k < 3 && f->v[SIG_SET_X]; k++) fprintf(file, ",%.8g", f->v[TOLD[k].signal][i]);
    fputc('\n', file);
  }
  if (fclose(file) != 0) abort();
}

void gap_log_write_usd(const gap_flight_t *f, const char *path) {
  const columns_t columns = columns_crazyflie();
  usd_bytes_t b = {0};
  usd_put(&b, 0xBC, 1);
  usd_put(&b, 2, 2);
  usd_put(&b, 1, 2);
  usd_put(&b, 0, 2);
  usd_put_name(&b, "fixedFrequency");
  usd_put(&b, COLUMNS, 2);
  for (unsigned k = 0; k < COLUMNS; k++) {
    char name[60];
    snprintf(name, sizeof name, "%s(f)", COLUMN[k].name);
    usd_put_name(&b, name);
  }
  for (int i = 0; i < f->n; i++) {
    usd_put(&b, 0, 2);
    usd_put(&b, (uint64_t)llround(1e6 * f->t_s[i]), 8);
    for (unsigned k = 0; k < COLUMNS; k++) usd_put_float(&b, (float)cell(f, &columns, k, i));
  }
  usd_put_crc(&b);
  FILE *const file = fopen(path, "wb");
  if (!file || fwrite(b.byte, 1, b.n, file) != b.n || fclose(file) != 0) abort();
  usd_bytes_free(&b);
}

// Writes the file of sim/vehicle/vehicles without its effects, in a room with a ceiling.
static void write_vehicle(void) {
  for (int i = 0; i < vehicle_count; i++) {
    if (strcmp(vehicle_table[i].name, "cf21_legacy") != 0) continue;
    const char *const text = vehicle_table[i].text, *const effect = strstr(text, "[[effect]]");
    FILE *const file = fopen(scratch_path("room.toml"), "w");
    if (!file) abort();
    fprintf(file, "ceiling_m = %g\n%.*s", EXAM_CEILING_M, (int)(effect ? effect - text : (long)strlen(text)),
            text);
    if (fclose(file) != 0) abort();
  }
}

bool gap_logs_fly(const char *name, int n, const fx_use_t *hidden) {
  model_t truth;
  why_t why;
  bool good = exam_vehicle(&truth, &why) == DONE && (!hidden || model_add_fx(&truth, hidden, &why) == DONE);
  write_vehicle();
  for (int i = 0; i < n && good; i++) {
    gap_flight_t f = {.n = 0};
    char file[60];
    const exam_flight_t job = {.truth = &truth, .seed = 77u + (unsigned long)i};
    snprintf(file, sizeof file, "%s%d.csv", name, i);
    good = exam_fly(&job, &f, &why) == DONE;
    if (good) gap_log_write(&f, scratch_path(file));
    snprintf(file, sizeof file, "%s%d.bin", name, i);
    if (good) gap_log_write_usd(&f, scratch_path(file));
    gap_flight_free(&f);
  }
  return good;
}

bool gap_logs_fly_one(const char *file, unsigned long seed, bool indi, const fx_use_t *hidden) {
  model_t truth;
  why_t why;
  gap_flight_t f = {.n = 0};
  const exam_flight_t job = {.truth = &truth, .seed = seed, .indi = indi};
  write_vehicle();
  const bool good = exam_vehicle(&truth, &why) == DONE &&
                    (!hidden || model_add_fx(&truth, hidden, &why) == DONE) &&
                    exam_fly(&job, &f, &why) == DONE;
  if (good) gap_log_write(&f, scratch_path(file));
  gap_flight_free(&f);
  return good;
}
