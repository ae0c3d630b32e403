// test_state.c - what the page is told of a vehicle.
#include "desk/state.h"

#include "rig/test.h"
#include <stdlib.h>
#include <string.h>

static double number(const cJSON *json, const char *name) {
  const cJSON *const of = cJSON_GetObjectItemCaseSensitive(json, name);
  return cJSON_IsNumber(of) ? of->valuedouble : (double)NAN;
}

static double element(const cJSON *json, const char *name, int i) {
  const cJSON *const of = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(json, name), i);
  return cJSON_IsNumber(of) ? of->valuedouble : (double)NAN;
}

static drone_t *standing(double ceiling_m) {
  drone_t *const d = calloc(1, sizeof *d);
  scene_t scene;
  why_t why;
  CHECK_OK(scene_default(&scene, &why));
  scene.setup.model.ceiling_m = ceiling_m;
  CHECK_OK(drone_open(d, &scene, NULL, NULL, NULL, &why));
  for (int i = 0; i < 500; i++) CHECK_OK(drone_tick(d, &why));
  return d;
}

static void end(drone_t *d) {
  why_t why;
  CHECK_OK(drone_close(d, &why));
  free(d);
}

TEST(state_tells_where_it_is_and_what_the_link_lost) {
  drone_t *const d = standing(1.2);
  const datagrams_t radio = {.has_client = true, .lost = 3, .dropped = 4};
  d->link.in = 5;
  d->link.out = 6;
  d->link.lost = 7;
  d->link.dropped = 8;
  const seen_as_t as = {"udp://here", &radio, 0.5};
  cJSON *const json = state_of(d, &as);
  const struct {
    const char *name;
    double want;
  } row[] = {{"clients", 1}, {"packets_in", 5}, {"packets_out", 6}, {"lost", 3},
             {"strays", 4},  {"no_room", 7},    {"dropped", 8},     {"ceiling_m", (double)1.2f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].name);
    CHECK_NEAR(number(json, row[i].name), row[i].want, 1e-9);
  }
  CHECK_NEAR(element(json, "pos_m", 1), d->seen.body->y[RIGID_POS_M + 1] + 0.5, 1e-9);
  CHECK_NEAR(number(json, "gap_m"), d->logs.gap, 1e-6);
  CHECK_NEAR(element(json, "motor", 0), 0.0, 1e-9);
  CHECK_TEXT(cJSON_GetObjectItemCaseSensitive(json, "uri")->valuestring, "udp://here");
  CHECK_TEXT(cJSON_GetObjectItemCaseSensitive(json, "controller")->valuestring, "stock PID (ceil.shadow 1)");
  cJSON_Delete(json);
  end(d);
}

TEST(state_has_every_parameter_of_the_desk_with_what_is_allowed_and_null_for_what_is_not_known) {
  drone_t *const d = standing(1.2);
  const datagrams_t radio = {.lost = 0};
  const seen_as_t as = {"udp://here", &radio, 0.0};
  cJSON *const json = state_of(d, &as);
  const cJSON *const desk = cJSON_GetObjectItemCaseSensitive(json, "desk");
  CHECK_NEAR(cJSON_GetArraySize(desk), desk_param_count, 0);
  for (int i = 0; i < desk_param_count; i++) {
    const cJSON *const one = cJSON_GetArrayItem(desk, i);
    ROW("%s", desk_param_rows[i].name);
    CHECK_TEXT(cJSON_GetObjectItemCaseSensitive(one, "name")->valuestring, desk_param_rows[i].name);
    CHECK(number(one, "value") >= number(one, "min") && number(one, "value") <= number(one, "max"));
    CHECK_TEXT(cJSON_GetObjectItemCaseSensitive(one, "kind")->valuestring,
               desk_ranges[i].is_switch ? "switch" : "number");
  }
  ROW("%s", "what is not known");
  CHECK(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(json, "setpoint_m")));
  cJSON_Delete(json);
  end(d);
}
