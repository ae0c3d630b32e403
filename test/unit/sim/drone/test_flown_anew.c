// test_flown_anew.c - sessions of clients, recorded and flown again.
#include "rig/desk_drone.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include <stdlib.h>
#include <string.h>

// Flies with a client that writes, waits, comes and goes.
static void session(drone_t *d) {
  desk_pass(d, 1.0);
  desk_set(d, "ceil.shadow", 0);
  desk_set(d, "ceil.commit", 1); // the parameter task waits until it is taken
  desk_climb(d, 0.5f);
  desk_pass(d, 2.5);
  desk_set(d, "desk.restart", 1);
  desk_pass(d, 1.0);
  uint8_t much[64];
  memset(much, 0xa5, sizeof much);
  drone_take(d, much, sizeof much); // none of ours: recorded, and dropped
  desk_climb(d, 0.4f);
  desk_set(d, "indiPos.kpz", 1.2);
  drone_left(d);
  desk_pass(d, 1.0);
  desk_land(d);
  desk_pass(d, 1.0);
}

TEST(a_recorded_session_is_flown_anew_to_the_bit) {
  char first[512], again[512], commands[512];
  snprintf(first, sizeof first, "%s", scratch_path("first.csv"));
  snprintf(again, sizeof again, "%s", scratch_path("again.csv"));
  snprintf(commands, sizeof commands, "%s", scratch_path("commands"));
  FILE *log = fopen(first, "w"), *told = fopen(commands, "w");
  drone_t *d = desk_drone(1.0, log, told);
  session(d);
  desk_end(d);
  fclose(log);
  fclose(told);
  log = fopen(again, "w");
  told = fopen(commands, "r");
  d = desk_drone(1.0, log, NULL);
  why_t why = {""};
  CHECK_OK(drone_replay(d, told, "commands", 1.0, &why));
  desk_end(d);
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
      desk_set(d, "indiPos.kpz", 1.25);
      drone_take(d, (uint8_t[]){0x2f, 3, (uint8_t)i, (uint8_t)(i >> 8)}, 4);
      desk_set(d, "indiPos.kpz", 1.5);
      desk_set(d, "desk.restart", 1);
      desk_pass(d, 0.1);
    }
    CHECK_NEAR(firmware_param(&d->firmware, i), 1.25, 0);
    desk_end(d);
    fclose(told);
  }
  char *const stored = scratch_text("storage");
  CHECK_TEXT(stored, "indiPos.kdz = 2\n");
  free(stored);
}

TEST(a_recording_that_is_none_is_refused_with_its_line) {
  static const struct {
    const char *text, *says;
  } row[] = {{"13 fd00\n13 fd00\n12 fd00\n", "it:3: allowed is"},
             {"# made by hand\n12 fd00\nfoo\n", "it:3: allowed is"},
             {"12 fd00\nfoo\n", "it:2: allowed is `MS HEX`, or `MS`, in the order of time"},
             {"12 fd00\n4 fd00\n", "it:2: allowed is"},
             {"12 fdxx\n", "it:1: allowed is"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    FILE *const told = fopen(scratch_file("commands", row[i].text, -1), "r");
    drone_t *const d = desk_drone(1.0, NULL, NULL);
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, drone_replay(d, told, "it", 0.0, &why));
    CHECK(strncmp(why.text, row[i].says, strlen(row[i].says)) == 0);
    desk_end(d);
    fclose(told);
  }
}
