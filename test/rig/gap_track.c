// gap_track.c - see gap_track.h.
#include "rig/gap_track.h"

#include "gap/2_predict/lines.h"
#include <stdlib.h>
#include <string.h>

done_t gap_track_make(gap_track_t *t, const gap_track_job_t *job, why_t *why) {
  grid_t *const grid = calloc(2, sizeof *grid);
  lines_t left = {.r = {NULL}};
  if (!grid) abort();
  memset(t, 0, sizeof *t);
  TRY(exam_vehicle(&t->vehicle, why));
  for (int i = 0; i < 2; i++) {
    const exam_flight_t flown = {
        .truth = &t->vehicle, .hover_only = job->hover, .indi = job->indi, .seed = 22100 + (unsigned long)i};
    TRY(exam_fly(&flown, &t->flight[i], why));
  }
  if (job->spoil) job->spoil(t);
  for (int i = 0; i < 2; i++) TRY(grid_make(&grid[i], &t->flight[i], 0, t->flight[i].n, &t->vehicle, why));
  TRY(set_make(&t->set, grid, 2, why));
  TRY(lines_make(&left, &t->set, why));
  TRY(residual_of(&t->set, &t->vehicle, left.r, why));
  TRY(closed_loop_of(&t->loop, &t->set, &t->vehicle, NULL, left.r, why));
  lines_free(&left);
  return DONE;
}

void gap_track_free(gap_track_t *t) {
  set_free(&t->set);
  for (int i = 0; i < 2; i++) gap_flight_free(&t->flight[i]);
}

void gap_track_thin(gap_track_t *t, int every) {
  for (int f = 0; f < 2; f++) {
    gap_flight_t *const to = &t->flight[f];
    to->n /= every;
    to->rate_Hz /= every;
    for (int i = 0; i < to->n; i++) {
      to->t_s[i] = to->t_s[every * i];
      for (int s = 0; s < SIG_COUNT; s++)
        if (to->v[s]) to->v[s][i] = to->v[s][every * i];
    }
  }
}

static void average(double *v, int n, int every, bool range) {
  for (int i = 0; v && i < n; i++) {
    double sum = 0.0;
    for (int k = 0; k < every; k++) sum += v[every * i + k];
    v[i] = range ? v[every * i + every / 2] : sum / every;
  }
}

void gap_track_average(gap_track_t *t, int every) {
  for (int f = 0; f < 2; f++) {
    gap_flight_t *const log = &t->flight[f];
    log->n /= every;
    log->rate_Hz /= every;
    log->rows_are_means = true;
    average(log->t_s, log->n, every, false);
    for (int s = 0; s < SIG_COUNT; s++)
      average(log->v[s], log->n, every, s == SIG_RANGE || s == SIG_RANGE_DOWN);
  }
}
