// test_shipped.c - scenarios fly the shipped parameters, except those that the head of their output prints.
//
// The app's own parameters after the flight are compared with params_default(): one that a scenario changes
// in any other way is in none of the lists below.
#include "flight/params.h"
#include "flight/scenario.h"
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define THESIS_LAW                                                                                           \
  " --set indiPos.kp=1 --set indiPos.kd=5 --set indiPos.kpz=1 --set indiPos.kdz=5 --set indiPos.quick=1"     \
  " --set indiPos.cutoff=8"
#define VERTICAL                                                                                             \
  THESIS_LAW                                                                                                 \
  " --set indiPos.tauMot=0.0625 --set indiPos.mass=0.032 --set indiPos.tMax=0.6 --set indiPos.biasPole=0"    \
  " --set ceil.law=0 --set ceil.min=0 --set ceil.hold=1 --set ceil.clip=0 --set rls.form=0 --set "           \
  "rls.lambda=0.5 --set rls.p0=1 --set rls.q=0"
#define CLOSE  " --set ceil.blindMax=60"
#define NOBODY NULL // the flight code does not fly

// Every scenario, and its exceptions.
static const struct {
  const char *scenario, *but;
  bool learns;     // from nothing: the controller brings the weights
  bool takes_long; // and has the same set-up as another row
} SCENARIO[] = {
    {"appendix-a", VERTICAL, false, false},
    {"bias-hover", " --set indiPos.biasPole=0", false, true},
    {"ceiling-gap", NOBODY, false, false},
    {"channel", " --set ceil.min=0.01 --set ceil.blindMax=60 --set ground.mode=1", true, false},
    {"close-flight", CLOSE, false, false},
    {"closest-hover", VERTICAL, false, true},
    {"hand-held", NOBODY, false, false},
    {"in-passing", " --set ceil.min=0.01 --set ceil.blindMax=60", true, true},
    {"inner-loop", "", false, false},
    {"learning-1d", VERTICAL, true, false},
    {"learning-flight", CLOSE, true, false},
    {"ols-sweep", VERTICAL, true, true},
    {"pid-tables", NOBODY, false, true},
    {"rls-sweep", VERTICAL, true, true},
    {"nearest-flight", " --set ceil.min=0.01 --set ceil.blindMax=120", false, true},
    {"test-flight", CLOSE, false, false},
    {"touch-and-go", " --set ceil.min=0 --set ceil.blindMax=60", false, true},
    {"uneven-floor", "", false, false},
};

#define SCENARIOS (sizeof SCENARIO / sizeof *SCENARIO)

static bool fly(const char *scenario, const fly_kind_t *kind, result_t *result) {
  why_t why;
  const request_t request = {.integrate =
                                 strcmp(scenario, "hand-held") == 0 ? INTEGRATE_SUNDIALS : INTEGRATE_RK4,
                             .kind = kind,
                             .seed = 1};
  return CHECK_OK(result_init(result, &why)) &&
         CHECK_OK(scenario_find(scenario)->run(&request, result, &why));
}

// Lists the differences as the head prints them, from the flown parameters alone. `brought`: beginnings of
// the names that the controller sets.
static void differences(const float *flew, const char *const *brought, char *text, size_t size) {
  flight_param_t shipped;
  params_default(&shipped);
  size_t used = 0;
  text[0] = '\0';
  for (int i = 0; flew && i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    bool known = flew[i] == params_get(&shipped, row);
    for (const char *const *b = brought; *b; b++) known = known || strncmp(row->name, *b, strlen(*b)) == 0;
    if (known) continue;
    used += (size_t)snprintf(text + used, size - used, " --set %s=%.7g", row->name, (double)flew[i]);
    if (!CHECK(used < size)) return;
  }
}

static void check(const char *scenario, const fly_kind_t *kind, const char *but, const char *const *brought) {
  result_t result;
  char flew[2000], printed[2000] = "";
  if (!fly(scenario, kind, &result)) return;
  differences(result.record.param, brought, flew, sizeof flew);
  const cJSON *const set = cJSON_GetObjectItem(result.json, "set");
  CHECK((set == NULL) == (but == NOBODY) && (result.record.param == NULL) == (but == NOBODY));
  const cJSON *item;
  cJSON_ArrayForEach(item, set) {
    const size_t used = strlen(printed);
    snprintf(printed + used, sizeof printed - used, " --set %s=%s", item->string, item->valuestring);
  }
  CHECK_TEXT(printed, but ? but : "");
  CHECK_TEXT(flew, but ? but : "");
  result_free(&result);
}

TEST(scenarios_fly_what_ships_but_for_what_their_head_prints) {
  static const char *const mode[] = {"ceil.mode", NULL}, *const learning[] = {"ceil.mode", "ceil.w",
                                                                              "ground.w", NULL};
  CHECK((int)SCENARIOS == scenario_count);
  for (unsigned i = 0; i < SCENARIOS; i++) {
    ROW("%s", SCENARIO[i].scenario);
    if (SCENARIO[i].takes_long && !test_long()) continue;
    check(SCENARIO[i].scenario, NULL, SCENARIO[i].but, SCENARIO[i].learns ? learning : mode);
  }
}

TEST(controllers_bring_their_curve_and_no_other_parameter) {
  static const struct {
    fly_kind_t kind;
    const char *brought[3];
  } row[] = {
      {FLY_INDI, {"ceil.mode"}},
      {FLY_INDI_THEORY, {"ceil.mode"}},
      {FLY_INDI_RBF, {NULL}},
      {FLY_INDI_LEARNED, {"ceil.w"}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", fly_name[row[i].kind]);
    check("test-flight", &row[i].kind, CLOSE, row[i].brought);
  }
}

TEST(fly_prints_what_it_flew_with_as_it_is_typed) {
  static const struct {
    const char *command, *says;
  } row[] = {
      {"fly test-flight --controller indi-rbf --integrator rk4",
       "parameters as shipped, but for --set ceil.blindMax=60\n"},
      {"fly test-flight --controller indi-rbf --integrator rk4 --set indiPos.kp=0.123456789 --seeds 2",
       "parameters as shipped, but for --set indiPos.kp=0.12345679 --set ceil.blindMax=60\n"},
      {"fly test-flight --controller indi-rbf --integrator rk4 --set ceil.blindMax=3",
       "parameters as shipped\n"},
      {"fly test-flight --controller indi-rbf --integrator rk4 --thesis-law --set ceil.blindMax=3",
       "parameters as shipped, but for" THESIS_LAW " --set ceil.law=0 --set ceil.hold=1\n"},
      {"fly test-flight --controller stock-pid --integrator rk4", "segments\n"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].command);
    char command[200], text[4000];
    snprintf(command, sizeof command, "%s | head -n 1", row[i].command);
    CHECK(program_run(command, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK_TEXT(text, row[i].says);
  }
}

// Below the range sensor's floor for longer than ceil.blindMax the app retreats: hence the scenario's
// exception.
TEST(close_flight_to_the_letter_of_the_shipped_set_retreats) {
  char text[4000];
  CHECK(program_run(
            "fly close-flight --controller indi-rbf --integrator rk4 --set ceil.blindMax=3 --json $S/r.json "
            ">$S/r.txt && sed -n '/mean_error_mm/s/[^0-9.-]//gp' $S/r.json | tail -n 1",
            STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strtod(text, NULL) < -100.0); // at the 2 cm step it has gone down to guard.safeGap
}
