// test_link.c - the link's packets: what is asked and what is answered, to the byte.
#include "link/link.h"

#include "base/random.h"
#include "crazyflie/param.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  firmware_t firmware;
  storage_t storage;
  link_t link;
} rig_t;

static rig_t *rig_open(const char *path) {
  rig_t *const r = calloc(1, sizeof *r);
  model_t model;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &model, &why));
  CHECK_OK(firmware_open(&r->firmware, &model, &why));
  CHECK_OK(storage_open(&r->storage, path, &r->firmware, &why));
  firmware_start(&r->firmware);
  link_init(&r->link, &r->firmware, &r->storage);
  return r;
}

static void rig_close(rig_t *r) {
  storage_close(&r->storage);
  firmware_close(&r->firmware);
  free(r);
}

// The controller takes what was written.
static void turn(rig_t *r) {
  const pilot_in_t in = {.acc_b_mps2 = {0.0, 0.0, 9.81}, .q_wb = {1.0, 0.0, 0.0, 0.0}, .vbat_V = 4.0};
  double motor_N[PILOT_MOTORS];
  for (int ms = 0; ms < 20; ms++) firmware_ms(&r->firmware, &in, motor_N);
}

// The answer to bytes in hex, in hex; "" for none.
static const char *ask(rig_t *r, const char *hex) {
  static char text[2 * 31 + 1];
  uint8_t bytes[64];
  int n = 0;
  for (unsigned byte; sscanf(hex + 2 * n, "%2x", &byte) == 1;) bytes[n++] = (uint8_t)byte;
  link_take(&r->link, bytes, n);
  packet_t p;
  text[0] = '\0';
  if (link_give(&r->link, &p))
    for (int i = 0; i < p.size; i++) sprintf(text + 2 * i, "%02x", p.byte[i]);
  return text;
}

static const char *ask_about(rig_t *r, const char *head, const char *param, const char *tail) {
  char hex[80];
  const int i = firmware_param_find(&r->firmware, param);
  CHECK(i >= 0);
  snprintf(hex, sizeof hex, "%s%02x%02x%s", head, i & 255, i >> 8, tail);
  return ask(r, hex);
}

static bool nothing_waits(rig_t *r) {
  packet_t p;
  return !link_give(&r->link, &p);
}

static const struct {
  const char *what, *asked, *answered;
} ANSWERS[] = {
    {"a scan", "ff", "ff"},
    {"an echo", "fc010203", "fc010203"},
    {"the source", "fd00", "fd42697463726170652043726179666c6965"},
    {"the protocol's version", "dd00", "dd000c000000"},
    {"one version too many", "dd07", ""},
    {"a log number beyond the last", "5c02ffff", "5c02"},
    {"a parameter beyond the last", "2c02ffff", "2c02"},
    {"a value of none", "2dffff", "2dffff02"},
    {"a write to none", "2effff01", "2effff02"},
    {"how many memories", "4c01", "4c0101"},
    {"the memory", "4c0200", "4c020012001000000000000000000000"},
    {"reset of the logs", "5d05", "5d050000"},
    {"a block that is not there is started", "5d030a0a", "5d030a02"},
    {"a command of logs that is none", "5d630a", "5d630a08"},
    {"all about the supervisor", "9c0c", "9c8c0402"},
    {"to recover without a crash", "9d02", "9d820101"},
    {"to arm before the checks", "9d0101", "9d810000"},
    {"a take-off while blocked", "8c07000000803f000000000100000040", "8c07000000"},
    {"a place of motion capture", "6c00000000", ""},
    {"a request of a value's state, cut", "2f04", ""},
    {"a block deleted without its number", "5d02", ""},
    {"a block started without its period", "5d0307", ""},
    {"to arm, or not?", "9d01", ""},
    {"an unknown port", "ac0102", ""},
    {"a port of another kind", "bc00", ""},
};

TEST(link_answers_as_the_firmware_does) {
  rig_t *const r = rig_open(NULL);
  for (unsigned i = 0; i < sizeof ANSWERS / sizeof *ANSWERS; i++) {
    ROW("%s", ANSWERS[i].what);
    const char *const got = ask(r, ANSWERS[i].asked);
    const bool padded = strncmp(ANSWERS[i].asked, "fd", 2) == 0; // with zeros, to 30 bytes
    if (padded)
      CHECK(strncmp(got, "fd42697463726179", 12) == 0 && strlen(got) == 62);
    else
      CHECK_TEXT(got, ANSWERS[i].answered);
    CHECK(nothing_waits(r));
  }
  rig_close(r);
}

TEST(link_lists_every_log_and_parameter_once_with_names_that_fit) {
  rig_t *const r = rig_open(NULL);
  const firmware_t *const f = &r->firmware;
  CHECK(firmware_params(f) > 150 && firmware_logs(f) > 200);
  for (int kind = 0; kind < 2; kind++) {
    const int n = kind ? firmware_logs(f) : firmware_params(f);
    for (int i = 0; i < n; i++) {
      const firmware_row_t row = kind ? firmware_log_row(f, i) : firmware_param_row(f, i);
      char full[64], hex[16];
      snprintf(full, sizeof full, "%s.%s", row.group, row.name);
      ROW("%s", full);
      CHECK(strlen(full) <= 27);
      CHECK((kind ? firmware_log_find(f, full) : firmware_param_find(f, full)) == i);
      snprintf(hex, sizeof hex, "%s02%02x%02x", kind ? "5c" : "2c", i & 255, i >> 8);
      CHECK(strlen(ask(r, hex)) == 2 * (1 + 4 + strlen(full) + 1));
    }
  }
  rig_close(r);
}

static firmware_row_t of_list[2];
static firmware_row_t row_of_list(const firmware_t *f, int i) {
  (void)f;
  return of_list[i];
}
static uint8_t type_in_list(const firmware_row_t *row) {
  return (uint8_t)row->type;
}

// Else a client would go by the list that it kept of another build.
TEST(the_sum_of_a_list_changes_with_each_name_type_and_place) {
  static const firmware_row_t other[][2] = {
      {{"ceil", "w1", 6}, {"ceil", "w2", 6}}, {{"ceil", "w1", 6}, {"ceil", "w3", 6}},
      {{"seil", "w1", 6}, {"ceil", "w2", 6}}, {{"ceil", "w1", 8}, {"ceil", "w2", 6}},
      {{"ceil", "w2", 6}, {"ceil", "w1", 6}}, {{"ceilw", "1", 6}, {"ceil", "w2", 6}}};
  const link_list_t list = {.n = 2, .row = row_of_list, .type = type_in_list};
  const link_t l = {0};
  uint32_t sum[6];
  for (int i = 0; i < 6; i++) {
    memcpy(of_list, other[i], sizeof of_list);
    sum[i] = link_list_crc(&l, &list);
    for (int k = 0; k < i; k++) CHECK(sum[i] != sum[k]);
  }
}

TEST(link_writes_what_may_be_written_and_tells_what_the_app_put_back) {
  rig_t *const r = rig_open(NULL);
  firmware_t *const f = &r->firmware;
  const int kpz = firmware_param_find(f, "indiPos.kpz"), flow = firmware_param_find(f, "deck.bcFlow2");
  const double was = firmware_param(f, kpz);
  CHECK(strlen(ask_about(r, "2e", "indiPos.kpz", "0000c03f")) > 0); // 1.5
  CHECK_NEAR(firmware_param(f, kpz), 1.5, 0);
  CHECK(nothing_waits(r));
  turn(r);
  CHECK(strlen(ask_about(r, "2e", "indiPos.kpz", "0000c8c2")) > 0); // -100: echoed first,
  packet_t p;
  CHECK(link_give(&r->link, &p) && p.byte[0] == 0x2f && p.byte[1] == 1); // then told
  CHECK_NEAR(firmware_param(f, kpz), 1.5, 0);
  CHECK_TEXT(ask_about(r, "2e", "deck.bcFlow2", "00"), "");
  CHECK_NEAR(firmware_param(f, flow), 1, 0);
  CHECK(was != 1.5);
  CHECK_TEXT(ask_about(r, "2e", "indiPos.kpz", "0000"), ""); // cut short
  CHECK_NEAR(firmware_param(f, kpz), 1.5, 0);
  rig_close(r);
}

TEST(link_tells_of_a_parameter_what_there_is_to_tell) {
  static const struct {
    const char *what, *head, *param, *ends;
    size_t bytes;
  } row[] = {{"kept for good?", "2f07", "indiPos.kpz", "0001", 6},
             {"not kept for good", "2f07", "stabilizer.controller", "02", 5},
             {"its default", "2f08", "stabilizer.controller", "0006", 6},
             {"the default of what is read alone", "2f08", "deck.bcFlow2", "02", 5}};
  rig_t *const r = rig_open(NULL);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const char *const got = ask_about(r, row[i].head, row[i].param, "");
    CHECK(strlen(got) == 2 * row[i].bytes);
    CHECK_TEXT(got + strlen(got) - strlen(row[i].ends), row[i].ends);
  }
  rig_close(r);
}

TEST(link_writes_by_name) {
  rig_t *const r = rig_open(NULL);
  // "pm" 0 "lowVoltage" 0 float 3.5
  CHECK_TEXT(ask(r, "2f00706d006c6f77566f6c746167650006000060400a"), "2f00706d006c6f77566f6c7461676500"
                                                                     "00");
  CHECK_NEAR(r->firmware.params.pm_lowVoltage, 3.5, 0);
  CHECK_TEXT(ask(r, "2f00706d006c6f77566f6c7461676500080a"), "2f00706d006c6f77566f6c7461676500"
                                                             "16");
  CHECK_TEXT(ask(r, "2f00706d006c6f77566f6c746167"), "2f00706d006c6f77566f6c7461670002"); // no such name
  rig_close(r);
}

TEST(link_sends_the_blocks_that_it_was_asked_for) {
  rig_t *const r = rig_open(NULL);
  firmware_t *const f = &r->firmware;
  const int vbat = firmware_log_find(f, "pm.vbat"), info = firmware_log_find(f, "supervisor.info");
  char hex[64];
  snprintf(hex, sizeof hex, "5d060707%02x%02x05%02x%02x", vbat & 255, vbat >> 8, info & 255, info >> 8);
  CHECK_TEXT(ask(r, hex), "5d060700");
  CHECK_TEXT(ask(r, hex), "5d060711"); // it is there
  snprintf(hex, sizeof hex,
           "5d0707"
           "07%02x%02x07%02x%02x07%02x%02x07%02x%02x07%02x%02x07%02x%02x",
           vbat & 255, vbat >> 8, vbat & 255, vbat >> 8, vbat & 255, vbat >> 8, vbat & 255, vbat >> 8,
           vbat & 255, vbat >> 8, vbat & 255, vbat >> 8);
  CHECK_TEXT(ask(r, hex), "5d070707");          // 26 bytes hold six and a half
  CHECK_TEXT(ask(r, "5d08070100"), "5d080700"); // every ms
  CHECK_TEXT(ask(r, "5d030701"), "5d030700");   // every 10 ms
  f->vehicle.around.battery_V = 3.75f;
  int packets = 0;
  packet_t p;
  for (int ms = 0; ms < 100; ms++) {
    f->vehicle.around.clock_ms++;
    link_ms(&r->link);
    while (link_give(&r->link, &p)) packets += p.byte[0] == 0x5e;
  }
  CHECK_NEAR(packets, 10, 0);
  CHECK(p.byte[1] == 7 && p.byte[2] == f->vehicle.around.clock_ms);
  float volt;
  memcpy(&volt, p.byte + 5, 4);
  CHECK_NEAR(volt, 3.75, 0);
  CHECK_TEXT(ask(r, "5d0407"), "5d040700");
  CHECK_TEXT(ask(r, "5d0207"), "5d020700");
  CHECK_TEXT(ask(r, "5d0207"), "5d020702");
  rig_close(r);
}

TEST(link_packs_numbers_as_they_are_asked_for) {
  static const struct {
    const char *type, *want;
    double value;
  } row[] = {
      {"01", "03", 3.9},        {"01", "fd", -3.0},           {"02", "0f27", 9999.0}, {"03", "a0860100", 1e5},
      {"06", "fdffffff", -3.9}, {"07", "00007040", 3.75},     {"08", "8043", 3.75},   {"08", "007c", 1e9},
      {"08", "00fc", -1e9},     {"08", "0100", 5.9604645e-8}, {"08", "00bc", -1.0},   {"05", "18fc", -1000.0},
  };
  rig_t *const r = rig_open(NULL);
  firmware_t *const f = &r->firmware;
  const int log = firmware_log_find(f, "ctrltarget.x");
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g as %s", row[i].value, row[i].type);
    char hex[64];
    snprintf(hex, sizeof hex, "5d0603%s%02x%02x", row[i].type, log & 255, log >> 8);
    CHECK_TEXT(ask(r, hex), "5d060300");
    CHECK_TEXT(ask(r, "5d030300"), "5d030300"); // once
    f->vehicle.setpoint.position.x = (float)row[i].value;
    link_ms(&r->link);
    packet_t p;
    char got[64] = "";
    CHECK(link_give(&r->link, &p));
    for (int k = 5; k < p.size; k++) sprintf(got + 2 * (k - 5), "%02x", p.byte[k]);
    CHECK_TEXT(got, row[i].want);
    CHECK_TEXT(ask(r, "5d0203"), "5d020300");
  }
  rig_close(r);
}

TEST(link_reads_and_writes_the_trajectories_memory_within_it) {
  rig_t *const r = rig_open(NULL);
  CHECK_TEXT(ask(r, "4e0010000000aabbcc"), "4e001000000000");
  CHECK_TEXT(ask(r, "4d001000000003"), "4d001000000000aabbcc");
  CHECK_TEXT(ask(r, "4d00fd0f000004"), "4d00fd0f000005"); // 4093 + 4
  CHECK_TEXT(ask(r, "4d00ffffffff04"), "4d00ffffffff05");
  CHECK_TEXT(ask(r, "4e00ff0f0000aabb"), "4e00ff0f000005");
  CHECK_TEXT(ask(r, "4d010000000004"), "4d010000000005"); // another memory
  CHECK_TEXT(ask(r, "4d00"), "");
  rig_close(r);
}

TEST(link_stores_parameters_in_a_file_and_finds_them_again) {
  char path[512];
  snprintf(path, sizeof path, "%s", scratch_path("storage"));
  rig_t *r = rig_open(path);
  CHECK(strlen(ask_about(r, "2e", "indiPos.kpz", "0000c03f")) > 0);
  CHECK(strstr(ask_about(r, "2f03", "indiPos.kpz", ""), "00") != NULL);
  const char *const state = ask_about(r, "2f04", "indiPos.kpz", "");
  CHECK(strlen(state) == 2 * 13 && strncmp(state + 8, "01", 2) == 0 && strcmp(state + 18, "0000c03f") == 0);
  const int sum = firmware_param_find(&r->firmware, "ceil.wSum"); // of weights, to its last bit
  firmware_param_put(&r->firmware, sum, 2212620261.0);
  CHECK(strlen(ask_about(r, "2f03", "ceil.wSum", "")) > 0);
  rig_close(r);
  r = rig_open(path);
  CHECK_NEAR(r->storage.value[sum], 2212620261.0, 0);
  CHECK_NEAR(firmware_param(&r->firmware, firmware_param_find(&r->firmware, "indiPos.kpz")), 1.5, 0);
  CHECK(strlen(ask_about(r, "2f05", "indiPos.kpz", "")) > 0);
  CHECK(strlen(ask_about(r, "2f04", "indiPos.kpz", "")) == 2 * 9);
  const char *const refused = ask_about(r, "2f03", "stabilizer.controller", "");
  CHECK_TEXT(refused + strlen(refused) - 2, "02"); // not one that can be stored
  rig_close(r);
}

TEST(a_storage_that_is_none_is_refused_with_its_line) {
  static const struct {
    const char *text, *says;
  } row[] = {
      {"indiPos.kpz 3\n", ":1: allowed is `group.name = value`"},
      {"# that\nindiPos.kpz = three\n", ":2: allowed is `group.name = value`"},
      {NULL, "/: a folder; allowed: a file"},
  };
  rig_t *const r = rig_open(NULL);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text ? row[i].text : "a folder");
    const char *const path = row[i].text ? scratch_file("bad", row[i].text, -1) : "/";
    storage_t s;
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, storage_open(&s, path, &r->firmware, &why));
    if (!CHECK(strstr(why.text, row[i].says) != NULL)) CHECK_TEXT(why.text, row[i].says);
  }
  rig_close(r);
}

TEST(what_another_firmware_stored_is_left_out) {
  static const char *const row[] = {"no.such = 3\nindiPos.kpz = 1.5\n",
                                    "deck.bcFlow2 = 0\nindiPos.kpz = 1.5\n"};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i]);
    rig_t *const r = rig_open(scratch_file("old", row[i], -1));
    CHECK_NEAR(firmware_param(&r->firmware, firmware_param_find(&r->firmware, "indiPos.kpz")), 1.5, 0);
    CHECK_NEAR(firmware_param(&r->firmware, firmware_param_find(&r->firmware, "deck.bcFlow2")), 1, 0);
    CHECK(strstr(r->firmware.vehicle.around.console, "cannot be stored, and is left out") != NULL);
    rig_close(r);
  }
}

TEST(every_stock_parameter_begins_with_its_default) {
  rig_t *const r = rig_open(NULL);
  const firmware_t *const f = &r->firmware;
  for (int i = 0; i < firmware_params(f); i++) {
    const firmware_row_t row = firmware_param_row(f, i);
    ROW("%s.%s", row.group, row.name);
    CHECK(firmware_param(f, i) == firmware_param_default(f, i)); // no NaN either
  }
  CHECK_NEAR(firmware_param(f, firmware_param_find(f, "system.selftestPassed")), 1, 0);
  rig_close(r);
}

TEST(an_emergency_stop_holds_wherever_it_comes_from) {
  static const struct {
    const char *what, *asked;
    bool stops;
  } row[] = {{"the supervisor's port", "9d03", true},
             {"the localization's port, as older clients", "6d03", true},
             {"a watchdog that is not fed again", "6d04", true},
             {"a position", "6d02", false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rig_t *const r = rig_open(NULL);
    firmware_t *const f = &r->firmware;
    const pilot_in_t in = {.vbat_V = 4.0, .acc_b_mps2 = {0.0, 0.0, 9.81}, .q_wb = {1.0, 0.0, 0.0, 0.0}};
    pilot_in_t now = in;
    double motor_N[PILOT_MOTORS];
    for (; now.step < 2500; now.step++) {
      if (now.step == 500) (void)ask(r, row[i].asked);
      firmware_ms(f, &now, motor_N);
    }
    CHECK((f->vehicle.supervised.state == SUPERVISED_LOCKED) == row[i].stops);
    rig_close(r);
  }
}

TEST(any_bytes_are_answered_or_dropped) {
  rig_t *const r = rig_open(NULL);
  random_t *const random = random_open(4);
  const int rounds = test_long() ? 2000000 : 100000;
  packet_t p;
  for (int i = 0; i < rounds; i++) {
    uint8_t bytes[40];
    const int size = (int)random_uniform(random, 0.0, 40.0);
    for (int k = 0; k < size; k++) bytes[k] = (uint8_t)random_uniform(random, 0.0, 256.0);
    link_take(&r->link, bytes, size);
    r->firmware.vehicle.around.clock_ms++;
    link_ms(&r->link);
    while (link_give(&r->link, &p)) CHECK(p.size >= 1 && p.size <= 31);
  }
  CHECK_NEAR(r->link.in, rounds, 0);
  CHECK(r->link.dropped > 0 && r->link.lost == 0);
  random_close(random);
  rig_close(r);
}
