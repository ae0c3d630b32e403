// test_drone.c - a simulated vehicle flown through its link, in simulated time.
#include "drone/drone.h"

#include "crazyflie/values.h"
#include "flight/guard.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static drone_t *drone(double ceiling_m, FILE *log, FILE *commands) {
  drone_t *const d = calloc(1, sizeof *d);
  scene_t scene;
  why_t why;
  CHECK_OK(scene_default(&scene, &why));
  scene.setup.model.ceiling_m = ceiling_m;
  CHECK_OK(drone_open(d, &scene, NULL, log, commands, &why));
  return d;
}

static void end(drone_t *d) {
  drone_close(d);
  free(d);
}

static void pass(drone_t *d, double s) {
  why_t why;
  packet_t packet;
  for (const uint32_t until_ms = drone_now_ms(d) + (uint32_t)(1e3 * s); drone_now_ms(d) < until_ms;) {
    CHECK_OK(drone_tick(d, &why));
    while (link_give(&d->link, &packet)) continue;
  }
}

static void set(drone_t *d, const char *name, double value) {
  const int i = firmware_param_find(&d->firmware, name);
  uint8_t packet[7] = {0x2e, (uint8_t)i, (uint8_t)(i >> 8)};
  const int type = firmware_param_row(&d->firmware, i).type;
  CHECK(i >= 0);
  values_put(type, packet + 3, value);
  drone_take(d, packet, 3 + link_param_bytes(type));
}

// Take off, or go to, within 2 s.
static void climb(drone_t *d, float height_m) {
  const float two_s = 2.0f;
  uint8_t packet[16] = {0x8c, 7};
  memcpy(packet + 3, &height_m, 4);
  packet[11] = 1;
  memcpy(packet + 12, &two_s, 4);
  drone_take(d, packet, sizeof packet);
}

static void land(drone_t *d) {
  uint8_t packet[16] = {0x8c, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0x40};
  drone_take(d, packet, sizeof packet);
}

static double log_of(drone_t *d, const char *name) {
  firmware_look(&d->firmware);
  return firmware_log(&d->firmware, firmware_log_find(&d->firmware, name));
}

TEST(a_client_takes_off_hovers_and_lands_with_each_controller) {
  static const struct {
    const char *what;
    double controller, shadow;
  } row[] = {{"the app", 6, 0},
             {"the stock PID in its place", 6, 1},
             {"the stock PID", 1, 1},
             {"the stock INDI", 3, 1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    drone_t *const d = drone(3.0, NULL, NULL);
    set(d, "stabilizer.controller", row[i].controller);
    set(d, "ceil.shadow", row[i].shadow);
    pass(d, 1.0);
    climb(d, 0.6f);
    pass(d, 8.0);
    CHECK_NEAR(d->seen.truth->pos_w_m.z - 0.017, 0.6, 0.05);
    CHECK(supervised_flies(&d->firmware.vehicle.supervised));
    land(d);
    pass(d, 7.0);
    CHECK_NEAR(d->seen.truth->pos_w_m.z - 0.017, 0.0, 0.01);
    CHECK(!supervised_flies(&d->firmware.vehicle.supervised));
    end(d);
  }
}

TEST(the_controller_can_be_changed_in_flight) {
  drone_t *const d = drone(3.0, NULL, NULL);
  pass(d, 1.0);
  climb(d, 0.6f);
  pass(d, 5.0);
  static const double order[] = {1, 6, 1};
  for (int i = 0; i < 3; i++) {
    set(d, "stabilizer.controller", order[i]);
    pass(d, 3.0);
    ROW("to %g", order[i]);
    CHECK_NEAR(log_of(d, "desk.z") - 0.017, 0.6, 0.08);
  }
  set(d, "stabilizer.controller", 2); // there is none
  pass(d, 0.1);
  CHECK_NEAR(d->firmware.params.stabilizer_controller, 1, 0);
  end(d);
}

TEST(set_points_that_stop_coming_end_the_flight) {
  drone_t *const d = drone(3.0, NULL, NULL);
  const float hover[] = {0.0f, 0.0f, 0.0f, 0.4f};
  uint8_t packet[18] = {0x7c, 10};
  memcpy(packet + 2, hover, sizeof hover);
  pass(d, 1.0);
  for (int i = 0; i < 40; i++) {
    drone_take(d, packet, sizeof packet);
    pass(d, 0.1);
  }
  CHECK_NEAR(log_of(d, "desk.z") - 0.017, 0.4, 0.05);
  pass(d, 1.0);
  CHECK(d->firmware.vehicle.supervised.state == SUPERVISED_LEVEL_OUT);
  pass(d, 1.5);
  CHECK(d->firmware.vehicle.supervised.state == SUPERVISED_LOCKED);
  set(d, "desk.restart", 1);
  pass(d, 1.0);
  CHECK(supervised_can_fly(&d->firmware.vehicle.supervised));
  end(d);
}

TEST(what_a_person_does_at_the_desk_is_felt) {
  drone_t *const d = drone(1.0, NULL, NULL);
  set(d, "ceil.shadow", 0);
  pass(d, 1.0);
  climb(d, 0.7f);
  pass(d, 6.0);
  CHECK_NEAR(log_of(d, "desk.gap"), 0.27, 0.02);
  CHECK(drone_set(d, "ceiling", 0.9) == NULL);
  pass(d, 0.5);
  CHECK_NEAR(log_of(d, "desk.gap"), 0.17, 0.02);
  const double x_m = log_of(d, "desk.x");
  CHECK(drone_set(d, "windX", 20.0) == NULL);
  pass(d, 0.5);
  CHECK(log_of(d, "desk.x") > x_m + 0.02);
  CHECK(drone_set(d, "windX", 0.0) == NULL);
  pass(d, 3.0);
  CHECK(drone_set(d, "cover", 1.0) == NULL);
  pass(d, 5.0);
  CHECK(d->firmware.vehicle.app.flight.guard.latched != 0);
  end(d);
}

TEST(what_may_not_be_done_at_the_desk_is_refused_with_its_range) {
  static const struct {
    const char *name;
    double value;
    const char *says;
  } row[] = {{"ceiling", 0.01, "desk.ceiling: allowed is 0.15 to 10 m"},
             {"cover", 2.0, "desk.cover: allowed is 0 to 1 "},
             {"windX", (double)NAN, "desk.windX: allowed is -100 to 100 mN"},
             {"wind", 0.0, "there is no such parameter in the group desk"}};
  drone_t *const d = drone(1.0, NULL, NULL);
  pass(d, 0.1);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].name);
    const char *const says = drone_set(d, row[i].name, row[i].value);
    CHECK_TEXT(says ? says : "", row[i].says);
  }
  // Over the link: echoed, put back, told.
  set(d, "desk.ceiling", 0.01);
  CHECK_NEAR(d->params.ceiling, 1.0, 1e-6);
  packet_t p;
  bool told = false;
  while (link_give(&d->link, &p)) told = told || (p.byte[0] == 0x2f && p.byte[1] == 1);
  CHECK(told);
  end(d);
}

// Flies with a client that writes, waits, comes and goes.
static void session(drone_t *d) {
  pass(d, 1.0);
  set(d, "ceil.shadow", 0);
  set(d, "ceil.commit", 1); // the parameter task waits until it is taken
  climb(d, 0.5f);
  pass(d, 2.5);
  set(d, "desk.restart", 1);
  pass(d, 1.0);
  uint8_t much[64];
  memset(much, 0xa5, sizeof much);
  drone_take(d, much, sizeof much); // none of ours: recorded, and dropped
  climb(d, 0.4f);
  set(d, "indiPos.kpz", 1.2);
  drone_left(d);
  pass(d, 1.0);
  land(d);
  pass(d, 1.0);
}

TEST(a_recorded_session_is_flown_anew_to_the_bit) {
  char first[512], again[512], commands[512];
  snprintf(first, sizeof first, "%s", scratch_path("first.csv"));
  snprintf(again, sizeof again, "%s", scratch_path("again.csv"));
  snprintf(commands, sizeof commands, "%s", scratch_path("commands"));
  FILE *log = fopen(first, "w"), *told = fopen(commands, "w");
  drone_t *d = drone(1.0, log, told);
  session(d);
  end(d);
  fclose(log);
  fclose(told);
  log = fopen(again, "w");
  told = fopen(commands, "r");
  d = drone(1.0, log, NULL);
  why_t why = {""};
  CHECK_OK(drone_replay(d, told, "commands", 1.0, &why));
  end(d);
  fclose(log);
  fclose(told);
  char *const a = scratch_text("first.csv"), *const b = scratch_text("again.csv");
  CHECK(strlen(a) > 100000 && strcmp(a, b) == 0);
  free(a);
  free(b);
}

// As on a vehicle whose battery is changed; a replay leaves the file as it is.
TEST(what_a_client_stores_is_there_after_a_restart_and_a_replay_stores_nothing) {
  char path[512], commands[512];
  snprintf(path, sizeof path, "%s", scratch_file("storage", "indiPos.kdz = 2\n", -1));
  snprintf(commands, sizeof commands, "%s", scratch_path("commands"));
  FILE *told = fopen(commands, "w");
  for (int replayed = 0; replayed < 2; replayed++) {
    ROW("%s", replayed ? "flown anew" : "by the client");
    drone_t *const d = calloc(1, sizeof *d);
    scene_t scene;
    why_t why;
    CHECK_OK(scene_default(&scene, &why));
    CHECK_OK(drone_open(d, &scene, replayed ? path : NULL, NULL, replayed ? NULL : told, &why));
    const int i = firmware_param_find(&d->firmware, "indiPos.kpz");
    if (replayed) {
      told = fopen(commands, "r");
      CHECK_OK(drone_replay(d, told, "commands", 0.1, &why));
      CHECK_NEAR(firmware_param(&d->firmware, firmware_param_find(&d->firmware, "indiPos.kdz")), 2.0, 0);
    } else {
      set(d, "indiPos.kpz", 1.25);
      drone_take(d, (uint8_t[]){0x2f, 3, (uint8_t)i, (uint8_t)(i >> 8)}, 4);
      set(d, "indiPos.kpz", 1.5);
      set(d, "desk.restart", 1);
      pass(d, 0.1);
    }
    CHECK_NEAR(firmware_param(&d->firmware, i), 1.25, 0);
    end(d);
    fclose(told);
  }
  char *const stored = scratch_text("storage");
  CHECK_TEXT(stored, "indiPos.kdz = 2\n");
  free(stored);
}

TEST(a_recording_that_is_none_is_refused_with_its_line) {
  static const struct {
    const char *text, *says;
  } row[] = {{"# made by hand\n12 fd00\nfoo\n", "it:3: allowed is"},
             {"12 fd00\nfoo\n", "it:2: allowed is `MS HEX`, or `MS`, in the order of time"},
             {"12 fd00\n4 fd00\n", "it:2: allowed is"},
             {"12 fdxx\n", "it:1: allowed is"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    FILE *const told = fopen(scratch_file("commands", row[i].text, -1), "r");
    drone_t *const d = drone(1.0, NULL, NULL);
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, drone_replay(d, told, "it", 0.0, &why));
    CHECK(strncmp(why.text, row[i].says, strlen(row[i].says)) == 0);
    end(d);
    fclose(told);
  }
}

TEST(a_scene_is_what_its_file_says) {
  static const char text[] =
      "vehicle = \"cf21_plus\"\nnoise = \"flown\"\nseed = 7\nceiling_m = 0.8\nbattery = 0.5\n"
      "[[effect]]\nis = \"mass:add=0.003,start=20\"\n";
  scene_t scene;
  why_t why = {""};
  CHECK_OK(scene_default(&scene, &why));
  CHECK_OK(scene_read(scratch_file("scene.toml", text, -1), &scene, &why));
  CHECK_TEXT(why.text, "");
  CHECK_NEAR(scene.setup.model.ceiling_m, 0.8, 0);
  CHECK_NEAR(scene.battery, 0.5, 0);
  CHECK(scene.seed == 7);
  CHECK(model_fx(&scene.setup.model, fx_find("mass")) != NULL);
  CHECK(scene.setup.plan.noise.vary.mass > 0.0);
}

TEST(a_scene_that_is_none_is_refused_with_its_line) {
  static const struct {
    const char *text, *says;
  } row[] = {{"celing_m = 1.0\n", "celing_m"},
             {"ceiling_m = -1.0\n", "scene.toml:1: ceiling_m"},
             {"\nnoise = \"loud\"\n", "scene.toml:2: noise"},
             {"vehicle = \"cf99\"\n", "vehicle: cf99: allowed is one of sim/vehicle/vehicles"},
             {"[[effect]]\nis = \"magic\"\n", "scene.toml:2: is"},
             {"battery = 2\n", "battery"},
             {"battery\n", "scene.toml:1"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    scene_t scene;
    why_t why = {""};
    CHECK_OK(scene_default(&scene, &why));
    CHECK_STATUS(BAD_INPUT, scene_read(scratch_file("scene.toml", row[i].text, -1), &scene, &why));
    if (!CHECK(strstr(why.text, row[i].says) != NULL)) CHECK_TEXT(why.text, row[i].says);
  }
}
