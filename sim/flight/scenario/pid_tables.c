// pid_tables.c - the thesis's tables 4.2 to 4.5: sixteen tuned PIDs under a ceiling, and which of them touch
// it. "segments" has the continuous ones; "discrete" the same with a controller period of 18 and 20.2 ms, on
// either side of the derivative filter's limit of stability.
#include "flight/scenario.h"

#include "base/constants.h"
#include "vehicle/model_file.h"

#define CONTINUOUS_S 2e-4

typedef struct {
  const char *table;
  fly_kind_t kind;
  double ceiling_m, setpoint_m, p, i, d;
} row_t;

static const row_t rows[] = {
    {"4.2", FLY_PID, 0.5, 0.40, 35, 5, 8},      {"4.2", FLY_PID, 0.5, 0.45, 150, 15, 25},
    {"4.2", FLY_PID, 0.5, 0.48, 200, 15, 35},   {"4.2", FLY_PID, 0.5, 0.49, 275, 15, 20},
    {"4.3", FLY_PID, 0.2, 0.10, 10, 2, 5},      {"4.3", FLY_PID, 0.2, 0.15, 45, 5, 10},
    {"4.3", FLY_PID, 0.2, 0.18, 150, 15, 25},   {"4.3", FLY_PID, 0.2, 0.19, 250, 20, 25},
    {"4.4", FLY_PID_FF, 0.5, 0.40, 0.25, 0, 1}, {"4.4", FLY_PID_FF, 0.5, 0.45, 0.5, 0, 2},
    {"4.4", FLY_PID_FF, 0.5, 0.48, 2, 0, 2},    {"4.4", FLY_PID_FF, 0.5, 0.49, 2, 0, 2},
    {"4.5", FLY_PID_FF, 0.2, 0.10, 1, 0, 1},    {"4.5", FLY_PID_FF, 0.2, 0.15, 1, 0, 1.5},
    {"4.5", FLY_PID_FF, 0.2, 0.18, 1, 0, 2},    {"4.5", FLY_PID_FF, 0.2, 0.19, 1, 0, 2},
};

static done_t fly(const row_t *row, const request_t *request, double period_s, flown_t *flown, why_t *why) {
  setup_t setup = {
      .kind = row->kind,
      .learn_from = {{1.0f}},
      .plan = {.vertical_only = true,
               .period_s = period_s,
               .way = {{0.0, row->setpoint_m}},
               .n_way = 1,
               .end_s = row->kind == FLY_PID ? 20.0 : 40.0},
      .pid = {.p = row->p, .i = row->i, .d = row->d, .n_per_s = 100.0, .limit_N = 10.0, .ratio_max = 1.6},
  };
  params_default(&setup.flight);
  TRY(model_builtin("thesis_pid", &setup.model, why));
  request_t own = *request;
  own.kind = NULL; // the table says which controller flies
  TRY(setup_apply(&setup, &own, why));
  setup.model.ceiling_m = row->ceiling_m; // also for another vehicle
  setup.plan.start_thrust_N = setup.model.mass_kg * G_MPS2;
  return setup_fly(&setup, flown, why);
}

static bool asked_for(const row_t *row, const request_t *request) {
  return !request->kind || *request->kind == row->kind;
}

static done_t add_continuous(const request_t *request, result_t *result, why_t *why) {
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    if (!asked_for(&rows[i], request)) continue;
    flown_t flown;
    TRY(fly(&rows[i], request, CONTINUOUS_S, &flown, why));
    char label[48];
    snprintf(label, sizeof label, "table %s, %.2f m", rows[i].table, rows[i].setpoint_m);
    result_add_segment(result, &flown, 0, label);
  }
  return DONE;
}

static done_t add_discrete(const request_t *request, double period_s, result_t *result, why_t *why) {
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    if (!asked_for(&rows[i], request)) continue;
    flown_t flown;
    TRY(fly(&rows[i], request, period_s, &flown, why));
    cJSON *row = result_add_row(result, "discrete");
    cJSON_AddStringToObject(row, "table", rows[i].table);
    cJSON_AddNumberToObject(row, "setpoint_m", rows[i].setpoint_m);
    cJSON_AddNumberToObject(row, "period_s", period_s);
    cJSON_AddNumberToObject(row, "contacts", flown.outcome.contacts);
    flown_free(&flown);
  }
  return DONE;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  if (request->kind && *request->kind != FLY_PID && *request->kind != FLY_PID_FF)
    return error_set(why, "--controller: pid-tables flies pid and pid-ff");
  if (request->n_set > 0) return error_set(why, "--set: the flight code does not fly in pid-tables");
  TRY(add_continuous(request, result, why));
  TRY(add_discrete(request, 0.018, result, why));
  return add_discrete(request, 0.0202, result, why);
}

const scenario_t scenario_pid_tables = {
    .name = "pid-tables",
    .brief = "the sixteen PIDs of thesis tables 4.2-4.5, continuous and discrete: which touch the ceiling",
    .run = run,
};
