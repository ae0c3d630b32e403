// nominal.c - flies the model itself along a track, nothing hidden.
#include "gap/3_feedback/nominal.h"

#include "gap/2_predict/lift.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CALMER     4  // times that a flight is tried again with less disturbance
#define POINTS_MIN 50 // a shorter flight tells nothing

grid_t nominal_part(const grid_t *g, double most_s) {
  grid_t part = *g;
  const int most = (int)(most_s / g->period_s);
  int from = 0;
  while (from < g->n && !g->point[from].ok) from++;
  if (part.n > from + most) part.n = from + most;
  return part;
}

// Gives a vehicle that was lost in the log's disturbance less of it, less noise, and moderate gains.
static void calm(closed_loop_t *w) {
  for (int i = 0; i < 3; i++) {
    w->force_mps2[i] *= 0.5;
    w->quick_mps2[i] *= 0.5;
    w->turn_radps2[i] *= 0.5;
    w->acc_mps2[i] *= 0.7;
    w->gyro_radps[i] *= 0.7;
  }
  for (int i = 0; i < 2; i++) w->rate_gain[i] = 15.0;
  w->tilt_gain = 50.0;
}

done_t nominal_flights(gap_flights_t *to, gap_flights_t *truth, const set_t *s, const model_t *m,
                       const closed_loop_t *w, double most_s, unsigned long seed, why_t *why) {
  for (int f = 0; f < s->n_grid; f++) {
    const grid_t part = nominal_part(&s->grid[f], most_s);
    if (part.n < POINTS_MIN) continue;
    const unsigned long own = seed * 2654435761u + (unsigned long)f * 97u;
    closed_loop_t calmer = *w;
    gap_flight_t *const is = truth ? &truth->flight[to->n] : NULL;
    done_t status = nominal_fly(&part, m, w, own, &to->flight[to->n], is, why);
    for (int k = 0; k < CALMER && status == BAD_INPUT; k++) {
      calm(&calmer);
      status = nominal_fly(&part, m, &calmer, own, &to->flight[to->n], is, why);
    }
    if (status == FAILED) return status;
    if (status != DONE) continue;
    to->n++;
    if (truth) truth->n++;
  }
  return to->n ? DONE : error_set(why, "none of these tracks can be flown");
}

done_t nominal_set(set_t *s, const gap_flights_t *flown, bool several, const model_t *m, why_t *why) {
  grid_t *const grid = calloc((size_t)flown->n + 1, sizeof(grid_t));
  if (!grid) return error_failed(why, "out of memory");
  done_t status = DONE;
  for (int f = 0; f < flown->n && status == DONE; f++)
    status = grid_make(&grid[f], &flown->flight[f], 0, flown->flight[f].n, m, why);
  if (status == DONE) {
    TRY(set_make(s, grid, flown->n, why));
    return several ? lift_find(s, m, why) : DONE;
  }
  for (int f = 0; f < flown->n; f++) grid_free(&grid[f]);
  free(grid);
  return status;
}

done_t nominal_along(along_t *a, const set_t *like, const model_t *m, const closed_loop_t *loop,
                     unsigned long seed, why_t *why) {
  const size_t n = (size_t)like->n_grid + 1;
  *a = (along_t){.seen_flights = {.flight = calloc(n, sizeof(gap_flight_t))},
                 .is_flights = {.flight = calloc(n, sizeof(gap_flight_t))}};
  if (!a->seen_flights.flight || !a->is_flights.flight) return error_failed(why, "out of memory");
  TRY(nominal_flights(&a->seen_flights, &a->is_flights, like, m, loop, NOMINAL_S, seed, why));
  TRY(nominal_set(&a->seen, &a->seen_flights, like->n_grid > 1, m, why));
  TRY(nominal_set(&a->is, &a->is_flights, like->n_grid > 1, m, why));
  memcpy(a->seen.excluded, like->excluded, sizeof a->seen.excluded);
  memcpy(a->is.excluded, like->excluded, sizeof a->is.excluded);
  return DONE;
}

void along_free(along_t *a) {
  set_free(&a->seen);
  set_free(&a->is);
  for (int f = 0; f < a->seen_flights.n; f++) {
    gap_flight_free(&a->seen_flights.flight[f]);
    gap_flight_free(&a->is_flights.flight[f]);
  }
  free(a->seen_flights.flight);
  free(a->is_flights.flight);
}
