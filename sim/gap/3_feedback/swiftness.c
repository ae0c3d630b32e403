// swiftness.c - finds how swiftly a pilot turns a vehicle, by how much the vehicle turns.
//
// Noise, errors of estimates and disturbance pass through the pilot, and turn a hovering vehicle the more,
// the larger the pilot's gains are. Regressing commands on rates does not show this for a controller that
// filters, or feeds its own commands back: for the Crazyflie's INDI, which has 24 1/s, it reads 8, and a
// pilot with 8 turns the model a tenth as much as the log's vehicle turns, or falls over. In a manoeuvre the
// pilot that is tried also follows some of the log's turning, and too small a gain is found; so the gain that
// was read is taken where it is larger.
#include "gap/3_feedback/nominal.h"

#include "body/side_by_side.h"
#include <stdlib.h>

// Number of gains that are tried side by side, in equal ratios from what was read to the largest that is
// flown.
enum { TRIALS = 8 };

typedef struct {
  const closed_loop_t *loop;
  const set_t *set;
  const model_t *model;
  unsigned long seed;
  double log_radps;
  turned_t turned;
  gap_flights_t seen;
  done_t status;
  why_t why;
} trial_t;

// Returns the rms of roll and pitch rates, rad/s, over what a trial flies of each flight; 0: there are none.
// A trial in which the vehicle is lost is flown by a calmer pilot (nominal.c), and turns less.
static double turning_radps(const set_t *s) {
  double sum = 0.0, n = 0.0;
  for (int f = 0; f < s->n_grid; f++) {
    const grid_t part = nominal_part(&s->grid[f], TRIAL_S);
    for (int j = 0; j < part.n; j++) {
      const grid_point_t *const p = &part.point[j];
      const double square = p->rate_b_radps.x * p->rate_b_radps.x + p->rate_b_radps.y * p->rate_b_radps.y;
      if (!p->ok || !isfinite(square)) continue;
      sum += 0.5 * square;
      n += 1.0;
    }
  }
  return n > 0.0 ? sqrt(sum / n) : 0.0;
}

static void fly(void *trials, int i) {
  trial_t *const t = (trial_t *)trials + i;
  closed_loop_t loop = closed_loop_turning(t->loop, t->set, t->model, t->turned.gain);
  loop.unread = false; // its gain alone turns the vehicle, not the track
  t->seen.flight = calloc((size_t)t->set->n_grid + 1, sizeof(gap_flight_t));
  t->status = t->seen.flight
                  ? nominal_flights(&t->seen, NULL, t->set, t->model, &loop, TRIAL_S, t->seed, &t->why)
                  : error_failed(&t->why, "out of memory");
}

static void compare(trial_t *t) {
  set_t own = {.n_grid = 0};
  if (t->status == DONE) t->status = nominal_set(&own, &t->seen, false, t->model, &t->why);
  const double own_radps = t->status == DONE ? turning_radps(&own) : 0.0;
  t->turned.off = own_radps > 0.0 ? log(own_radps / t->log_radps) : (double)NAN;
  set_free(&own);
  for (int f = 0; t->seen.flight && f < t->set->n_grid; f++) gap_flight_free(&t->seen.flight[f]);
  free(t->seen.flight);
}

double closed_loop_gain(const turned_t *t, int n, bool believed) {
  double nearest = HUGE_VAL, gain = 0.0;
  int first = 0;
  for (int i = 1; i < n && !believed; i++)
    if (isnan(t[first].off) || t[i].off < t[first].off) first = i;
  if (t[first].off >= 0.0) return t[first].gain;
  for (int i = first; i + 1 < n; i++)
    if (t[i].off < 0.0 && t[i + 1].off >= 0.0)
      return t[i].gain * pow(t[i + 1].gain / t[i].gain, t[i].off / (t[i].off - t[i + 1].off));
  for (int i = first; i < n; i++)
    if (fabs(t[i].off) < nearest) nearest = fabs(t[i].off), gain = t[i].gain;
  return gain;
}

done_t closed_loop_match(closed_loop_t *w, const set_t *s, const model_t *m, unsigned long seed, why_t *why) {
  trial_t trial[TRIALS];
  const bool known = w->flown_by && w->flown_by->kind > FLOWN_BY_OTHER;
  const double log_radps = s->grid[0].has_rates ? turning_radps(s) : 0.0;
  const double read = fmin(w->rate_gain[0], w->rate_gain[1]);
  if (known || !(log_radps > 0.0) || !(read < w->rate_gain_most)) return DONE;
  for (int i = 0; i < TRIALS; i++)
    trial[i] = (trial_t){.loop = w,
                         .set = s,
                         .model = m,
                         .seed = seed,
                         .log_radps = log_radps,
                         .turned.gain = read * pow(w->rate_gain_most / read, i / (TRIALS - 1.0))};
  side_by_side_shared(TRIALS, fly, trial);
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < TRIALS; i++) compare(&trial[i]);
  turned_t turned[TRIALS];
  for (int i = 0; i < TRIALS; i++) {
    turned[i] = trial[i].turned;
    if (trial[i].status != FAILED) continue;
    *why = trial[i].why;
    return FAILED;
  }
  const double gain = closed_loop_gain(turned, TRIALS, !w->unread);
  if (gain > read) *w = closed_loop_turning(w, s, m, gain);
  return DONE;
}
