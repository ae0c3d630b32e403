// flights.c - short ways to fly in a test.
#include "rig/flights.h"

#include "rig/test.h"

setup_t flights_appendix_a(fly_kind_t kind, float cutoff_Hz, float lead_s, bool ceiling) {
  setup_t setup;
  why_t why = {""};
  CHECK_OK(scenario_appendix_a_setup(&setup, kind, &why));
  const request_t nothing = {.integrate = INTEGRATE_RK4, .no_effects = !ceiling};
  CHECK_OK(setup_apply(&setup, &nothing, &why));
  CHECK_TEXT(why.text, "");
  setup.flight.cutoff_Hz = cutoff_Hz;
  setup.flight.pos.lead_s = lead_s;
  return setup;
}

segment_t flights_last(const setup_t *setup, int *contacts) {
  flown_t flown;
  why_t why;
  if (!CHECK_OK(setup_fly(setup, &flown, &why))) return (segment_t){.contacts = -1};
  CHECK(flown.outcome.finite);
  if (contacts) *contacts = flown.outcome.contacts;
  const segment_t last = flown.segment[flown.n_segment - 1];
  flown_free(&flown);
  return last;
}

segment_t flights_last_by(const setup_t *setup, const pilot_t *pilot, int *contacts) {
  record_t record = {0};
  outcome_t outcome;
  why_t why;
  segment_t segment[WAYPOINTS_MAX];
  if (!CHECK_OK(loop_fly(&setup->plan, &setup->model, pilot, &record, &outcome, &why)))
    return (segment_t){.contacts = -1};
  if (contacts) *contacts = outcome.contacts;
  const int n = segments_of(&record, &setup->plan, segment);
  record_free(&record);
  return segment[n - 1];
}
