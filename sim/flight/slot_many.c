// slot_many.c - many hovers in the gap.
#include "flight/slot_many.h"

#include "base/by_size.h"
#include "vehicle/effect_spec.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Medians of the captured flights.
typedef struct {
  double *median_m;
  slot_many_t *sum;
} tally_t;

static done_t tally_open(tally_t *t, slot_many_t *m, int flights, why_t *why) {
  *m = (slot_many_t){
      .low_m = (double)NAN, .high_m = (double)NAN, .median_m = (double)NAN, .free_m = (double)NAN};
  *t = (tally_t){.median_m = malloc(sizeof(double) * (size_t)flights), .sum = m};
  return t->median_m ? DONE : error_failed(why, "out of memory");
}

static void tally_add(tally_t *t, int like, const slot_seen_t *seen) {
  slot_many_t *const m = t->sum;
  m->flights++;
  if (seen->captured) {
    m->captured_as[like]++;
    t->median_m[m->captured++] = seen->median_m;
  } else
    m->free_m = fmin(m->free_m, seen->closest_m); // fmin ignores NaN
}

static void tally_close(tally_t *t) {
  slot_many_t *const m = t->sum;
  if (m->captured > 0) {
    qsort(t->median_m, (size_t)m->captured, sizeof *t->median_m, by_size);
    m->low_m = t->median_m[0];
    m->median_m = t->median_m[m->captured / 2];
    m->high_m = t->median_m[m->captured - 1];
  }
  free(t->median_m);
}

static double peak_m(const record_t *r) {
  double high_m = 0.0;
  for (int i = 0; i < r->n; i++) high_m = fmax(high_m, r->sample[i].z_m - r->sample[0].z_m);
  return high_m;
}

static done_t make(const slot_case_t *c, int seed, setup_t *setup, why_t *why) {
  model_t file;
  TRY(slot_setup(setup, (uint64_t)seed, c->ceiling, c->rise_m, why));
  TRY(slot_vehicle(&file, why));
  if (c->mass_kg > 0.0) setup->model.mass_kg *= c->mass_kg / file.mass_kg; // keeps the random deviation
  setup->kind = c->kind;
  setup->plan.integrate = INTEGRATE_RK4; // takes a tenth of the time; checked elsewhere
  if (!c->effect) return DONE;
  fx_use_t use;
  TRY(effect_parse(c->effect, &use, why));
  return model_add_fx(&setup->model, &use, why);
}

static done_t fly_one(const slot_case_t *c, int seed, tally_t *t, why_t *why) {
  setup_t setup;
  flown_t flown;
  slot_seen_t seen;
  const int like = seed % SLOT_FLIGHTS;
  TRY(make(c, seed, &setup, why));
  TRY(setup_fly(&setup, &flown, why));
  done_t status = slot_judge_flight(&flown, &setup.model, &seen, why);
  if (!flown.outcome.finite) status = error_failed(why, "seed %d: not finite", seed);
  if (status == DONE) {
    tally_add(t, like, &seen);
    t->sum->lift_s[slot_late(like)] += seen.lift_s;
    t->sum->peak_m += peak_m(&flown.record) / c->seeds;
  }
  flown_free(&flown);
  return status;
}

done_t slot_fly_many(const slot_case_t *c, slot_many_t *m, why_t *why) {
  tally_t tally;
  TRY(tally_open(&tally, m, c->seeds, why));
  int n[2] = {0, 0};
  done_t status = DONE;
  for (int seed = 1; seed <= c->seeds && status == DONE; seed++) {
    status = fly_one(c, seed, &tally, why);
    n[slot_late(seed % SLOT_FLIGHTS)]++;
  }
  for (int i = 0; i < 2; i++) m->lift_s[i] /= n[i];
  tally_close(&tally);
  return status;
}

done_t slot_real_many(const char *folder, slot_many_t *m, why_t *why) {
  tally_t tally;
  TRY(tally_open(&tally, m, SLOT_FLIGHTS, why));
  done_t status = DONE;
  for (int k = 0; k < SLOT_FLIGHTS && status == DONE; k++) {
    char path[1024];
    slot_seen_t seen;
    double ceiling_m;
    snprintf(path, sizeof path, "%s/ceiling_gap/%s", folder, slot_real(k, &ceiling_m));
    status = slot_judge_file(path, ceiling_m, &seen, why);
    if (status == DONE) tally_add(&tally, k, &seen);
  }
  tally_close(&tally);
  return status;
}
