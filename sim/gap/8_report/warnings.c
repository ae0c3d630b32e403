// warnings.c - the notes beside the verdict.
#include "gap/8_report/report.h"

#include "base/constants.h"
#include "base/folder.h"
#include "vehicle/frame_file.h"
#include <math.h>
#include <string.h>

#define LIFT_MIN     1.1 // thrust over weight
#define LIFT_MAX     12.0
#define LATE_LEAST_S 1e-3 // of an attitude: less is within the error of rows at uneven times
#define LATE_SURE    4.0  // standard errors
// Largest difference between the velocity shifts of several flights. None is larger in 84 sets of two other
// simulators; in a published log, whose velocity follows the position, it is 40 ms.
#define MOVES_AGREE_S 0.01

#define warn(r, ...) note(&(r)->warnings, __VA_ARGS__)

static void warn_of_logs(report_t *r) {
  const study_t *const s = r->study;
  for (int i = 0; i < s->fit.n + s->held.n; i++) {
    const gap_flight_t *const f = &s->flight[i];
    for (int k = 0; k < f->n_note; k++) {
      const bool named = strncmp(f->note[k], f->name, strlen(f->name)) == 0;
      warn(r, "%s%s%s", named ? "" : report_log_name(r, f), named ? "" : ": ", f->note[k]);
    }
  }
}

// Warns if one log shows where the floor is and another does not.
static void warn_of_floors(report_t *r) {
  const study_t *const s = r->study;
  const gap_flight_t *lowered = NULL, *other = NULL;
  for (int i = 0; i < s->fit.n + s->held.n; i++) {
    if (s->flight[i].floor_m != 0.0) lowered = &s->flight[i];
    if (s->flight[i].v[SIG_Z] && !s->flight[i].floor_known) other = &s->flight[i];
  }
  if (lowered && other)
    warn(r,
         "heights of %s count from %.3g m, where it stood, and those of %s, which does not begin on the "
         "floor, "
         "from 0: rest_height_m in the columns file says it of all",
         report_log_name(r, lowered), lowered->floor_m, report_log_name(r, other));
}

// Warns, and returns true, if most of what is left of the held-out flights beyond the floor is a constant
// that the fitted ones do not have.
static bool warn_of_another(report_t *r, int ch) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const gap_part_t *const p = &d->held_out.channel[ch];
  const rows_t *const rows = set_rows(&d->held, ch);
  const double usual = rows_usual(set_rows(&d->fit, ch), d->residual[ch], d->fit.n_grid);
  of_flights_t which = {.n = 0};
  double squares = 0.0;
  if (r->study->by_time || set_rows(&d->fit, ch)->n == 0) return false;
  for (int f = 0; f < d->held.n_grid; f++) {
    const int n = rows_from(rows, f + 1) - rows_from(rows, f);
    const double is = rows_constant(rows, r->after.r[ch], f), more = is - usual;
    const double beside = fmin(fabs(is), fabs(more));
    squares += beside * beside * n / rows->n;
    if (beside > p->floor) report_add_flight(&which, r, ch, f, more + r->own[f * CHANNELS + ch]);
  }
  if (!which.n || !(squares > 0.5 * (p->after * p->after - p->floor * p->floor))) return false;
  warn(
      r,
      "%s: %.3g %s is left of what is held out, where noise and feedback alone leave %.3g, and most of it is "
      "there all the time: %s, other than in the fitted flights: something was changed in between",
      gap_channel[ch], p->after, gap_unit[ch], p->floor, which.text);
  return true;
}

static void warn_of_gap(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (p->used && p->after > 1.05 * p->before)
      warn(r, "%s: the gap grew on the held-out flights, %.3g to %.3g %s", gap_channel[ch], p->before,
           p->after, gap_unit[ch]);
  }
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (report_adequacy(r, ch) != LEFT_MORE) continue;
    if (p->after > LEFT_OVER * p->floor && warn_of_another(r, ch)) continue;
    if (p->after > LEFT_OVER * p->floor)
      warn(r,
           "%s: %.3g %s is left, where noise and feedback alone leave %.3g: more than can be named from so "
           "much flight",
           gap_channel[ch], p->after, gap_unit[ch], p->floor);
    else
      warn(r,
           "%s: %.3g %s is left, and most of its changes from row to row come by few jumps: something "
           "changed in flight, or was touched",
           gap_channel[ch], p->after, gap_unit[ch]);
  }
}

// Returns what the vehicle file lacks that decides how much nominal flights shake; "": nothing.
static const char *tells_the_pilot(const study_t *s) {
  const bool pilot = s->flown_by.kind == FLOWN_BY_UNKNOWN,
             rotors = frame_lacks_key(&s->vehicle, "rotors", "inertia_kgm2");
  if (pilot && rotors)
    return "; [controller] and rotors.inertia_kgm2 in the vehicle file would tell more of it";
  if (pilot) return "; [controller] in the vehicle file would say who flew";
  return rotors ? "; rotors.inertia_kgm2 in the vehicle file would tell more of it" : "";
}

// Warns if the nominal flights shake more than the log.
static void warn_of_pilot(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  char where[REPORT_TEXT] = "";
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (p->used && d->nominal_flew && p->floor > LEFT_OVER * p->before)
      text_add(where, sizeof where, "%s%s %.3g, not %.3g %s", where[0] ? ", " : "", gap_channel[ch], p->floor,
               p->before, gap_unit[ch]);
  }
  if (where[0])
    warn(r,
         "flights of the model along these tracks shake more than who flew (%s): what is small there is not "
         "named%s",
         where, tells_the_pilot(r->study));
}

static void warn_of_instrument(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  if (d->why_not_confirmed) warn(r, "whether feedback makes a name is not known: %s", d->why_not_confirmed);
  for (int i = 0; i < d->found.n; i++) {
    const confirm_t *const a = &d->found.named[i].confirm;
    const char *const name = candidate_name(&d->candidates.candidate[d->found.named[i].candidate]);
    if (a->answer == CONFIRM_NO)
      warn(r, "%s may be made by feedback, by the set points as instrument, or they show too little of it",
           name);
    else if (a->apart)
      warn(r,
           "%s: the set points as instrument give another size than least squares (p %.1g): feedback or "
           "noise is "
           "in the size that is named",
           name, a->p_apart);
  }
}

static void warn_of_nominal(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  if (!d->nominal_flew)
    warn(r, "the model could not be flown along these tracks: what feedback alone would show is not known");
  else if (d->nominal.lost)
    warn(r,
         "%d of %d flights of the model along these tracks could not be flown: what feedback alone would "
         "show is known from the others",
         d->nominal.lost, d->nominal.lost + d->nominal.flown);
}

static void warn_of_contradicted(report_t *r, const withdrawn_t *w) {
  const char *const name = candidate_name(&r->study->diagnosis.candidates.candidate[w->candidate]);
  if (!w->by_share)
    warn(r,
         "%s is withdrawn: the fitted flights show it, but it grows %s of the held-out ones, %.3g to %.3g %s",
         name, gap_channel[w->channel], w->without, w->with, gap_unit[w->channel]);
  else
    warn(r,
         "%s is withdrawn: the fitted flights show it, but the held-out ones have %.2g +- %.1g of what it "
         "would add to them",
         name, w->share, w->stderr_);
}

static void warn_of_one_way(report_t *r, const refuted_t *f, const char *name) {
  warn(r, "%s is withdrawn: %s; %s", name,
       f->by == MADE_BY_NOISE
           ? "noise that is fed back, or a disturbance, may look like it"
           : "in so slow a log what commands did between two rows, or a gyro's noise that is "
             "fed back, looks like it",
       f->fx->scales != FX_SCALES_NOTHING
           ? "measured turning by predicted and predicted by measured do not both bear it out"
           : "with velocity or acceleration in the log a force along z would tell");
}

static void warn_of_withdrawn(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int i = 0; i < d->withdrawn.n; i++) warn_of_contradicted(r, &d->withdrawn.name[i]);
  for (int i = 0; i < d->n_refuted; i++) {
    const refuted_t *const f = &d->refuted[i];
    const fx_size_t *const size = &f->fx->size[f->number];
    const char *const name = f->number > 0 ? f->fx->apart_name : f->fx->name;
    const char *const unit = f->fx->param[size->param].unit;
    if (f->by == MADE_BY_CONTROL) {
      warn(
          r,
          "%s is withdrawn: the rows show %.3g%s%s, but control that answers a disturbance may make as much, "
          "as flights of the model without it show",
          name, f->value, text_gap(unit), unit);
      continue;
    }
    if (f->by == MADE_BY_MISSED_COMMANDS || f->by == MADE_BY_NOISE) {
      warn_of_one_way(r, f, name);
      continue;
    }
    warn(r,
         "%s is withdrawn: the rows show %.3g %s, but by the set points as instrument it is %.3g +- %.2g %s: "
         "feedback makes it",
         name, f->value, unit, f->by_set_points.value[f->number], f->by_set_points.stderr_[f->number], unit);
  }
}

static void warn_of_diagnosis(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  if (!report_has_residual(r))
    warn(r, r->study->by_time && !by_turns_cover(&d->held)
                ? "nothing is held out: these flights are shorter than three stretches of 2 s"
                : "no residual can be formed: these logs have neither acceleration nor rates beside commands "
                  "that "
                  "explain them");
  if (report_contradicted(r))
    warn(r, "the held-out flights speak against what is named: all channels together they are explained no "
            "better than before");
  warn_of_withdrawn(r);
  warn_of_nominal(r);
  for (int ch = 0; ch < CHANNELS; ch++)
    if (d->fit.excluded[ch])
      warn(r,
           ch == CH_WZ && d->fit.spins_other
               ? "%s is left out: it goes against the commands, and follows them with the other sign of "
                 "`spin` in the vehicle file"
               : "%s is left out: the logged commands say too little of it (%s)",
           gap_channel[ch],
           report_turning_missed(r) ? "rows miss commands: log faster"
                                    : "logged more slowly than given, or motors in another order?");
  if (d->found.aligned)
    warn(r,
         "commands act %.1f ms later than the model has it: below %.3g ms this is what feedback alone or "
         "instruments that are late look like, and it is not named",
         1e3 * d->found.aligned_s, 1e3 * candidates_least(d->found.aligned, &d->fit));
}

// Bound on the new model's height error when flown again, over the old model's: a model that fits every row
// may fly worse. On an outside examiner's logs right names gave at most 1.4, and an accelerometer's scale
// that was named mass 3 to 8; the names of the recorded ground flights, whose file is another vehicle's, 6.
#define WORSE 2.0

static void warn_of_flight_again(report_t *r) {
  const resimulation_t *const again = &r->study->resimulation;
  char before[REPORT_LENGTH], after[REPORT_LENGTH];
  if (!again->flew) warn(r, "the held-out flight is not flown again: %s", again->why_not);
  if (again->before.lost || again->after.lost)
    warn(r,
         "flown again, the vehicle was put back when it was more than %.0f m off the measured track; times "
         "with the old "
         "model: %d, with the new one: %d",
         RESIMULATE_LOST_M, again->before.lost, again->after.lost);
  else if (again->flew && r->n_finding && again->after.height_m > WORSE * again->before.height_m)
    warn(r,
         "flown again with what is named, the vehicle is further off the measured height than without, %s to "
         "%s: predict no heights with model.toml before it is known why; an instrument's scale or bias that "
         "is "
         "told as mass does this",
         report_length(again->before.height_m, before), report_length(again->after.height_m, after));
}

// Warns that a range bias may be half as large. The range is compared with the log's own height. If that
// comes from the downward sensor, it has this sensor's bias, and the upward sensor adds its own; the log
// cannot tell this from a bias of one sensor alone, unless it shows the vehicle on the floor.
static void warn_of_names(report_t *r) {
  const set_t *const s = &r->study->diagnosis.fit;
  bool open = false;
  for (int f = 0; f < s->n_grid; f++) open = open || (s->grid[f].range_up && !s->grid[f].flight->floor_known);
  for (int i = 0; i < r->n_finding; i++)
    if (r->finding[i].fx->in_height && open)
      warn(r,
           "%s: where the log's height comes from a range sensor with the same error (a flow deck's), "
           "it is half of the %.3g m, and the log cannot tell",
           r->finding[i].fx->name, fx_use_size(r->finding[i].use, 0));
}

// Warns of wrong units with which it still flies (grams for kilograms, newton of one motor for newton of
// all), and of what the vehicle file lacks.
static void warn_of_vehicle(report_t *r) {
  const model_t *const m = &r->study->vehicle;
  const double lift = m->thrust_max_N / (m->mass_kg * G_MPS2);
  if (lift < LIFT_MIN || lift > LIFT_MAX)
    warn(r,
         "%s: thrust_max_N lifts %.3g times the weight of mass_kg; quadrotors lift %g to %g times theirs (is "
         "mass_kg in kg, and thrust_max_N that of all motors in N?)",
         folder_file(study_vehicle(r->study)), lift, LIFT_MIN, LIFT_MAX);
  char lacks[FRAME_LACKS];
  if (frame_lacks(m, lacks)[0])
    warn(r, "%s does not say %s: those of a Crazyflie are taken, scaled to this mass and radius",
         folder_file(study_vehicle(r->study)), lacks);
}

// Returns by how much the attitude is late, s (below 0: early), with its standard error. The attitude turns
// an acceleration that is logged in world axes, or made from the velocity, into body axes. If it is late, a
// lateral force shows: g, the thrust over mass, times the rotation during the delay.
static double attitude_late_s(const report_t *r, double *stderr_s) {
  const set_t *const held = &r->study->diagnosis.held;
  double rr = 0.0, fr = 0.0, ff = 0.0;
  for (int i = 0; i < held->smooth.n; i++) {
    const grid_t *const g = &held->grid[held->smooth.flight[i]];
    const d3_t rate = g->point[held->smooth.point[i]].rate_b_radps;
    const double fx = r->after.r[CH_FX][i], fy = r->after.r[CH_FY][i];
    rr += rate.x * rate.x + rate.y * rate.y;
    fr += fx * rate.y - fy * rate.x;
    ff += fx * fx + fy * fy;
  }
  const double slope = rr > 0.0 ? fr / rr : 0.0;
  *stderr_s = rr > 0.0 ? sqrt(fmax(ff - slope * fr, 0.0) / (2.0 * held->smooth.n) / rr) / G_MPS2 : 0.0;
  return slope / G_MPS2;
}

// Returns the late_ms to write into the columns file: what it says now, or the shift that was made because it
// says nothing, plus late_s.
static double late_ms_told(const study_t *s, double late_s) {
  const column_t *const of = s->columns.of;
  const double said_s = of[SIG_QW].late_said ? of[SIG_QW].late_s : of[SIG_ROLL].late_s;
  return 1e3 * (said_s + s->flight[0].attitude_late_s + late_s);
}

// Warns, and returns true, if the flights' velocities were shifted by different times. Each is shifted by its
// delay against the accelerometer, which is the same in all flights of one logger.
static bool warn_of_moves(report_t *r) {
  const study_t *const s = r->study;
  double least_s = HUGE_VAL, most_s = -HUGE_VAL;
  for (int f = 0; f < s->fit.n + s->held.n; f++) {
    if (s->flight[f].velocity_late_s == 0.0) continue; // no sure delay was seen
    least_s = fmin(least_s, s->flight[f].velocity_late_s);
    most_s = fmax(most_s, s->flight[f].velocity_late_s);
  }
  if (!(most_s - least_s > MOVES_AGREE_S)) return false;
  warn(r,
       "against the accelerometer the velocity of one flight was moved by %.3g ms, of another by %.3g: one "
       "logger's is late by one time; write it as late_ms at vx, vy, vz (0 if it is not late), for the names "
       "depend on it",
       1e3 * least_s, 1e3 * most_s);
  return true;
}

static void warn_of_attitude(report_t *r) {
  const study_t *const s = r->study;
  const grid_t *const g = s->diagnosis.held.grid;
  const gap_part_t *const part = s->diagnosis.held_out.channel;
  // A lateral force at a place or a time is not a late attitude, though it goes with the turn rates, too.
  const cell_t *const unknown = &s->diagnosis.left.cell;
  const bool lies = unknown->along >= 0 && unknown->along < COORDINATES &&
                    (coordinate_is_place(unknown->along) || unknown->along == COORDINATE_TIME);
  if (s->diagnosis.unknown && unknown->channel < CH_FZ && lies) return;
  const bool turned = g && (g->acceleration_made || s->columns.acc != ACC_BODY);
  if (!turned || !g->has_rates || !g->has_attitude || !part[CH_FX].used || !part[CH_FY].used) return;
  double stderr_s;
  const double late_s = attitude_late_s(r, &stderr_s);
  if (fabs(late_s) < LATE_LEAST_S || fabs(late_s) < LATE_SURE * stderr_s) return;
  warn(r,
       "what is left of force_x and force_y goes with the turn rates, as if the attitude were %.2g +- %.1g "
       "ms %s against the velocities; if it is (a simulator's own step, an estimator), write late_ms = %.1f "
       "at its columns",
       1e3 * fabs(late_s), 1e3 * stderr_s, late_s > 0.0 ? "late" : "early", late_ms_told(s, late_s));
}

static void warn_of_bumps(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const set_t *const sets[] = {&d->fit, r->study->by_time ? NULL : &d->held};
  for (int i = 0; i < 2; i++)
    for (int f = 0; sets[i] && f < sets[i]->n_grid; f++) {
      const grid_t *const g = &sets[i]->grid[f];
      if (g->bumps)
        warn(r,
             "%s: it touched the ceiling, at about %.1f s for the first time; what was measured then is left "
             "out",
             report_log_name(r, g->flight), g->bump_s);
    }
}

void report_warn(report_t *r) {
  warn_of_vehicle(r);
  if (!warn_of_moves(r)) warn_of_attitude(r); // a wrong shift would look like a late attitude
  warn_of_names(r);
  warn_of_diagnosis(r);
  warn_of_bumps(r);
  warn_of_flight_again(r);
  warn_of_instrument(r);
  warn_of_floors(r);
  warn_of_gap(r);
  report_warn_of_own(r);
  warn_of_pilot(r);
  warn_of_logs(r);
}
