// slot.c - the air garage's hover between a deck and a ceiling.
#include "flight/slot.h"

#include "base/by_size.h"
#include "base/constants.h"
#include "base/csv.h"
#include "vehicle/effect_spec.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdlib.h>

#define WEIGHT_SD     0.03
#define HOVER_S       15.0
#define STEPS         20
#define MARKER_DOWN_M 0.003 // below the propellers
#define MOVED_M       0.002 // farther from its place: the motors shake it

// Measured on the real flights, in the order of labels.csv. The take-off's trajectory lasts height over
// speed, 0.8 m at 0.1 or 0.5 m/s: tracks of flights with the same delay of 15 s differ in length by as much.
static const struct {
  const char *file;
  double tilt_deg[2], take_off_s;
} real[SLOT_FLIGHTS] = {
    {"20240823_17_47_21.csv", {3.1, 1.0}, 8.0},   {"20240823_19_27_09.csv", {-5.8, -1.3}, 8.0},
    {"20240823_19_37_29.csv", {-3.2, -4.3}, 8.0}, {"20240827_18_45_10.csv", {-6.5, -3.4}, 1.6},
    {"20240827_18_46_05.csv", {3.4, -1.1}, 1.6},  {"20240827_18_48_44.csv", {2.0, 2.1}, 1.6},
    {"20240827_18_49_29.csv", {-1.1, 3.3}, 1.6},  {"20240827_18_56_52.csv", {2.9, 5.8}, 1.6},
};

const char *slot_real(int k, double *ceiling_m) {
  *ceiling_m = 0.8349;
  return real[k].file;
}

int slot_late(int k) {
  return real[k].take_off_s < 2.0;
}

done_t slot_vehicle(model_t *model, why_t *why) {
  return model_builtin("cf21_air_garage", model, why);
}

static done_t add_effect(model_t *model, const char *spec, why_t *why) {
  fx_use_t use;
  TRY(effect_parse(spec, &use, why));
  return model_add_fx(model, &use, why);
}

// Varies the weight. Real flights of one day and set point, over the open deck or 86 mm and more under a
// plate, differ in lift-off by 9 % (5 flights), 14 % (6) and 8 % (4), simulated ones by 2 to 3 % without
// this. From the effect of a gram on the lift-off, that is roughly 3 % of weight over thrust (battery,
// propellers).
static done_t spread_weight(model_t *model, uint64_t seed, why_t *why) {
  random_t *const random = random_open(seed);
  if (!random) return error_failed(why, "out of memory");
  model->mass_kg *= 1.0 + WEIGHT_SD * random_normal(random);
  random_close(random);
  return DONE;
}

// Plans the high-level commander's way to rise_m above rest, in steps, and a hover.
static void plan_way(setup_t *setup, double rise_m, double take_off_s) {
  plan_t *const plan = &setup->plan;
  setup->plan.take_off_s = SLOT_TAKEOFF_S;
  plan->n_way = STEPS + 1;
  for (int i = 0; i <= STEPS; i++) {
    const double s = (double)i / STEPS;
    const double share = s * s * s * s * (35.0 + s * (-84.0 + s * (70.0 - s * 20.0)));
    plan->way[i] = (waypoint_t){i == 0 ? 0.0 : SLOT_TAKEOFF_S + s * take_off_s,
                                setup->model.frame.rotor_above_feet_m + share * rise_m};
  }
  plan->end_s = SLOT_TAKEOFF_S + take_off_s + HOVER_S;
}

done_t slot_setup(setup_t *setup, uint64_t seed, bool ceiling, double rise_m, why_t *why) {
  TRY(setup_thesis(setup, FLY_STOCK_PID, why));
  TRY(slot_vehicle(&setup->model, why));
  TRY(spread_weight(&setup->model, seed, why));
  const double rest_m = setup->model.frame.rotor_above_feet_m;
  setup->model.ceiling_m = ceiling ? rest_m + SLOT_REST_M : HUGE_VAL;
  if (ceiling) TRY(add_effect(&setup->model, SLOT_CEILING, why));
  TRY(add_effect(&setup->model, SLOT_GROUND, why));
  setup->stock_pid.power = setup->air_garage.pid.power = stock_power_2022();
  // The air garage's heights are those of the marker, as is its position, which here is 0 at rest.
  setup->air_garage.ceiling_m = SLOT_REST_M + MARKER_DOWN_M;
  setup->air_garage.ground_m = MARKER_DOWN_M - rest_m;
  const unsigned k = (unsigned)(seed % SLOT_FLIGHTS);
  setup->plan.mocap = (mocap_param_t){.period_s = 0.018, .late_s = 0.010, .sd_m = 5e-5, .sd_rad = 1e-3};
  for (int i = 0; i < 2; i++) setup->plan.mocap.tilt_rad[i] = RAD_PER_DEG * real[k].tilt_deg[i];
  setup->plan.seed = seed;
  plan_way(setup, rise_m, real[k].take_off_s);
  return DONE;
}

done_t slot_judge(const slot_point_t *point, int n, double start_s, slot_seen_t *seen, why_t *why) {
  double *const near_m = malloc(sizeof *near_m * (size_t)(n > 0 ? n : 1));
  if (!near_m || n < 2) {
    free(near_m);
    return n < 2 ? error_set(why, "a track without points") : error_failed(why, "out of memory");
  }
  *seen = (slot_seen_t){.median_m = (double)NAN, .closest_m = HUGE_VAL, .lift_s = (double)NAN};
  int caught = 0;
  double caught_s = 0.0;
  for (int i = 1; i < n; i++) {
    seen->closest_m = fmin(seen->closest_m, point[i].gap_m);
    if (isnan(seen->lift_s) && point[i].t_s > start_s && point[i].gap_m < point[0].gap_m - SLOT_LIFT_M)
      seen->lift_s = point[i].t_s - start_s;
    if (!(point[i].gap_m < SLOT_NEAR_M)) continue;
    near_m[caught++] = point[i].gap_m;
    caught_s += point[i].t_s - point[i - 1].t_s;
  }
  qsort(near_m, (size_t)caught, sizeof *near_m, by_size);
  seen->captured = caught_s >= SLOT_CAUGHT_S;
  if (caught > 0) seen->median_m = near_m[caught / 2];
  free(near_m);
  return DONE;
}

// --- recorded tracks --------------------------------------------------------------------------------------

#define POINTS_MAX 8192

typedef struct {
  slot_point_t point[POINTS_MAX];
  int n;
  double x_m, y_m, start_s; // where it rested; when it moved first
} track_t;

static done_t read_rows(csv_file_t *file, double ceiling_m, track_t *t, why_t *why) {
  static const char *const name[] = {"t", "x", "y", "z"};
  int column[4];
  for (int i = 0; i < 4; i++) {
    column[i] = csv_find(file, name[i]);
    if (column[i] < 0) return csv_refuse(file, -1, why, "no column %s; needed: t, x, y, z", name[i]);
  }
  for (bool more = true;;) {
    double cell[4];
    TRY(csv_next(file, &more, why));
    if (!more) return DONE;
    if (t->n == POINTS_MAX) return csv_refuse(file, -1, why, "too long; allowed: %d rows", POINTS_MAX);
    for (int i = 0; i < 4; i++) TRY(csv_number(file, column[i], CSV_GAP_REFUSED, &cell[i], why));
    if (t->n == 0) {
      t->x_m = cell[1];
      t->y_m = cell[2];
    }
    const bool moved = fabs(cell[1] - t->x_m) + fabs(cell[2] - t->y_m) > MOVED_M;
    if (moved && isnan(t->start_s)) t->start_s = cell[0];
    t->point[t->n++] = (slot_point_t){cell[0], ceiling_m - cell[3] - MARKER_DOWN_M};
  }
}

done_t slot_judge_file(const char *path, double ceiling_m, slot_seen_t *seen, why_t *why) {
  track_t *const t = calloc(1, sizeof *t);
  if (!t) return error_failed(why, "out of memory");
  t->start_s = (double)NAN;
  csv_file_t *file;
  done_t status = csv_open(&file, path, why);
  if (status == DONE) status = read_rows(file, ceiling_m, t, why);
  csv_close(file);
  if (status == DONE) status = slot_judge(t->point, t->n, t->start_s, seen, why);
  free(t);
  return status;
}

// --- flown tracks -----------------------------------------------------------------------------------------

done_t slot_judge_flight(const flown_t *flown, const model_t *model, slot_seen_t *seen, why_t *why) {
  const record_t *record = &flown->record;
  slot_point_t *const point = malloc(sizeof *point * (size_t)(record->n > 0 ? record->n : 1));
  if (!point) return error_failed(why, "out of memory");
  const double ceiling_m = model->frame.rotor_above_feet_m + SLOT_REST_M; // also over the open deck
  for (int i = 0; i < record->n; i++)
    point[i] = (slot_point_t){record->sample[i].t_s, ceiling_m - record->sample[i].z_m};
  const done_t status = slot_judge(point, record->n, SLOT_TAKEOFF_S, seen, why);
  free(point);
  return status;
}
