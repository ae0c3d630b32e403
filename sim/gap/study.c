// study.c - the workflow from log files on.
#define _POSIX_C_SOURCE 200809L // strdup
#include "gap/study.h"

#include "pilots/controller_file.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define VEHICLE_BYTES 1000000

static void tell(const study_t *s, const char *what) {
  if (s->order.progress) s->order.progress(what);
}

const char *study_vehicle(const study_t *s) {
  return s->order.vehicle ? s->order.vehicle : "the built-in vehicle " STUDY_VEHICLE;
}

// --- the vehicle ------------------------------------------------------------------------------------------

static done_t read_text(const char *path, char **text, why_t *why) {
  *text = calloc(VEHICLE_BYTES, 1);
  if (!*text) return error_failed(why, "out of memory");
  FILE *const file = fopen(path, "rb");
  const size_t n = file ? fread(*text, 1, VEHICLE_BYTES - 1, file) : 0;
  const bool good = file && !ferror(file) && n < VEHICLE_BYTES - 1;
  if (file) fclose(file);
  return good ? DONE : error_set(why, "%.300s: cannot be read; allowed: a vehicle file below 1 MB", path);
}

static done_t take_vehicle(study_t *s, why_t *why) {
  if (s->order.vehicle) {
    TRY(model_read(s->order.vehicle, &s->vehicle, why)); // says if it is a folder, a device or no file
    TRY(read_text(s->order.vehicle, &s->vehicle_text, why));
    TRY(model_read_text(s->order.vehicle, s->vehicle_text, &s->vehicle, why));
    return controller_read(s->order.vehicle, s->vehicle_text, &s->vehicle, &s->flown_by, why);
  }
  TRY(model_builtin(STUDY_VEHICLE, &s->vehicle, why));
  for (int i = 0; i < vehicle_count; i++)
    if (strcmp(vehicle_table[i].name, STUDY_VEHICLE) == 0) s->vehicle_text = strdup(vehicle_table[i].text);
  return s->vehicle_text ? DONE : error_failed(why, "out of memory");
}

// --- the logs ---------------------------------------------------------------------------------------------

static bool same_file(const char *a, const char *b) {
  struct stat x, y;
  if (strcmp(a, b) == 0) return true;
  return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

static bool among(const char *log, const char *const *list, int n) {
  for (int i = 0; i < n; i++)
    if (same_file(log, list[i])) return true;
  return false;
}

// Orders the logs: those to fit to, then those held out. A flight that is fitted to twice would hide what
// differs between flights.
static done_t order_logs(const study_order_t *o, const char **path, int *n_fit, int *n_held, why_t *why) {
  *n_fit = *n_held = 0;
  for (int i = 0; i < o->n_log; i++) {
    if (among(o->log[i], o->log, i)) return error_set(why, "%.300s: given twice; allowed: once", o->log[i]);
    if (!among(o->log[i], o->hold_out, o->n_hold_out)) path[(*n_fit)++] = o->log[i];
  }
  if (*n_fit == 0) return error_set(why, "every log is held out; allowed: one LOG or more to fit to");
  for (int i = 0; i < o->n_hold_out; i++) {
    if (among(o->hold_out[i], o->hold_out, i))
      return error_set(why, "--hold-out %.300s: given twice; allowed: once", o->hold_out[i]);
    path[*n_fit + (*n_held)++] = o->hold_out[i];
  }
  if (*n_held || *n_fit < 3) return DONE;
  *n_held = *n_fit / 3;
  *n_fit -= *n_held;
  return DONE;
}

static done_t read_logs(study_t *s, why_t *why) {
  const study_order_t *o = &s->order;
  const int n = o->n_log + o->n_hold_out;
  const char **path = calloc((size_t)n + 1, sizeof *path);
  s->flight = calloc((size_t)n + 1, sizeof *s->flight);
  int n_fit = 0, n_held = 0;
  done_t status =
      path && s->flight ? order_logs(o, path, &n_fit, &n_held, why) : error_failed(why, "out of memory");
  s->fit = (gap_flights_t){s->flight, n_fit};
  s->held = (gap_flights_t){s->flight + n_fit, n_held};
  s->by_time = n_held == 0;
  for (int i = 0; i < n_fit + n_held && status == DONE; i++) {
    char what[80];
    snprintf(what, sizeof what, "reading log %d of %d", i + 1, n_fit + n_held);
    tell(s, what);
    status = gap_read(&s->flight[i], path[i], &s->columns, &s->vehicle, why);
  }
  free(path);
  return status;
}

// --- the whole --------------------------------------------------------------------------------------------

done_t study_make(study_t *s, const study_order_t *order, why_t *why) {
  *s = (study_t){.order = *order, .columns = columns_crazyflie()};
  TRY(take_vehicle(s, why));
  if (order->columns) TRY(columns_read(order->columns, &s->columns, why));
  TRY(read_logs(s, why));
  const diagnose_job_t job = {.fit = &s->fit,
                              .held = s->by_time ? NULL : &s->held,
                              .model = &s->vehicle,
                              .flown_by = &s->flown_by,
                              .seed = order->seed,
                              .progress = order->progress};
  TRY(diagnose(&job, &s->diagnosis, why));
  tell(s, "flying the held-out flight again");
  const diagnosis_t *d = &s->diagnosis;
  return resimulate(&d->held, &s->vehicle, &d->turns, &d->loop, &s->resimulation, why);
}

void study_free(study_t *s) {
  resimulation_free(&s->resimulation);
  diagnosis_free(&s->diagnosis);
  for (int i = 0; s->flight && i < s->fit.n + s->held.n; i++) gap_flight_free(&s->flight[i]);
  free(s->flight);
  free(s->vehicle_text);
  *s = (study_t){.flight = NULL};
}
