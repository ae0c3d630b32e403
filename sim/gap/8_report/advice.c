// advice.c - what to do now: what to use, what to add to the vehicle file, what to fly.
#include "gap/8_report/report.h"

#include "vehicle/frame_file.h"
#include <math.h>

static void advise_use(report_t *r) {
  if (r->n_finding == 0 && (r->study->diagnosis.unknown || report_adequacy_of_all(r) == LEFT_MORE))
    note(&r->to_do,
         "use: the vehicle file as it is, and mind that it leaves more than noise in these flights");
  else if (r->n_finding == 0)
    note(&r->to_do, "use: the vehicle file as it is; these flights add nothing to it");
  else
    note(&r->to_do,
         "use: model.toml, in the folder of --out (fly --vehicle model.toml): %s with the %s named",
         study_vehicle(r->study), r->n_finding > 1 ? "effects" : "effect");
}

static void advise_add(report_t *r) {
  char lacks[FRAME_LACKS];
  if (r->ceiling_suspected && isfinite(r->ceiling_seen_m))
    note(&r->to_do, "add: ceiling_m = %.2f to the vehicle file if that is the ceiling, and run this again",
         r->ceiling_seen_m);
  else if (r->ceiling_suspected)
    note(&r->to_do, "add: ceiling_m to the vehicle file, if there was a ceiling, and run this again");
  else if (!r->study->order.vehicle)
    note(&r->to_do, "add: a vehicle file of your own (--vehicle); the built-in one was taken");
  else if (frame_lacks(&r->study->vehicle, lacks)[0])
    note(&r->to_do, "add: what the vehicle file does not say and is a Crazyflie's: %s", lacks);
  else
    note(&r->to_do, "add: nothing more to the vehicle file");
}

// One can fly for more data at a place or in a state, but not at a time or for a line in the spectrum.
static void advise_place(report_t *r, const cell_t *cell) {
  char where[REPORT_PLACE];
  report_place(r, cell, where);
  if (cell->along == COORDINATE_TIME)
    note(
        &r->to_do,
        "fly: the same again, and see whether what is %s comes once more; what happens once may be a gust, a "
        "touch, or commands between two rows",
        where);
  else if (cell->along == NOWHERE)
    note(&r->to_do, "fly: the same again with another pilot or other gains, and see whether it stays %s",
         where);
  else if (cell->along == BY_FLIGHT)
    note(&r->to_do,
         "fly: twice with nothing touched in between, then with the battery strapped on anew, then "
         "started anew, then in still air: it differs by what is done where it changes; to know "
         "what one flight has, give it alone");
  else
    note(&r->to_do, "fly: the same again with more time %s, and as much beside it", where);
}

// True if held-out flights leave far more in some channel than noise, and than the fitted ones do.
static bool is_shown_by_held_alone(const report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  bool alone = false;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    const int n = set_rows(&d->fit, ch)->n;
    double squares = 0.0;
    for (int i = 0; d->residual[ch] && i < n; i++) squares += d->residual[ch][i] * d->residual[ch][i];
    const double fitted = n ? sqrt(squares / n) : 0.0;
    alone = alone || (p->used && p->after > LEFT_OVER * fmax(p->floor, fitted));
  }
  return alone && d->nominal_flew && d->withdrawn.n == 0;
}

// Says what tells a name (the largest share first) from its rivals; else what shows the unexplained residual
// best; else what shows an effect that these flights, or logs with so few rows, could not.
static void advise_fly(report_t *r) {
  for (int i = 0; i < r->n_finding; i++)
    if (r->finding[i].named->n_rival) {
      note(&r->to_do, "fly: %.280s", r->finding[i].fly);
      return;
    }
  if (r->study->diagnosis.unknown) {
    advise_place(r, &r->study->diagnosis.left.cell);
    return;
  }
  if (r->n_finding == 0 && !r->study->by_time && is_shown_by_held_alone(r)) {
    note(&r->to_do,
         "fly: nothing yet; hold out other flights (--hold-out LOG): what is held out now shows something "
         "that the fitted flights hardly do");
    return;
  }
  if (report_turning_missed(r)) {
    const double command_Hz = r->study->diagnosis.fit.grid[0].command_Hz;
    note(
        &r->to_do,
        "fly: the same again, logged %g times a second, for what turns the vehicle: these rows miss commands",
        command_Hz > 0.0 ? fmin(command_Hz, GAP_RATE_HZ) : GAP_RATE_HZ);
    return;
  }
  for (int i = 0; i < r->n_untested; i++)
    if (r->untested[i].flyable) {
      note(&r->to_do, "fly: %.200s, for %s", r->untested[i].fx->fly, r->untested[i].fx->name);
      return;
    }
  note(&r->to_do, "fly: nothing more for the effects that are known");
}

void report_advise(report_t *r) {
  advise_use(r);
  advise_add(r);
  advise_fly(r);
}
