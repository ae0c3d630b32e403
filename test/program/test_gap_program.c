// test_gap_program.c - the workflow's program on simulated flights: what it says, and what it writes.
#include "exam/truth.h"
#include "rig/gap_logs.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "rig/verdicts.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DRAG_KG 3e-6
#define GAP     "gap --vehicle $S/room.toml --columns tools/columns/fly.toml "

// --- something named ------------------------------------------------------------------------------------

static void check_drag(const cJSON *v) {
  const cJSON *const effect = cJSON_GetArrayItem(cJSON_GetObjectItem(v, "effects"), 0);
  CHECK(cJSON_GetArraySize(cJSON_GetObjectItem(v, "effects")) == 1 && cJSON_GetArraySize(effect) == 13);
  CHECK_TEXT(verdict_string(effect, "name"), "rotor_drag");
  CHECK(verdict_number(effect, "p") < 1e-4 && verdict_number(effect, "share") > 0.05);
  CHECK(cJSON_IsArray(cJSON_GetObjectItem(effect, "rivals")) && verdict_string(effect, "fly")[0]);
  const cJSON *const k = cJSON_GetObjectItem(cJSON_GetObjectItem(effect, "parameters"), "k");
  CHECK_NEAR(verdict_number(k, "value"), DRAG_KG, 0.1 * DRAG_KG);
  CHECK(verdict_number(k, "stderr") > 0.0 && verdict_number(k, "stderr") < 0.1 * DRAG_KG);
  CHECK_TEXT(verdict_string(k, "unit"), "kg");
  const cJSON *const where = cJSON_GetObjectItem(effect, "where");
  CHECK(strcmp(verdict_string(where, "coordinate"), "v_x") == 0 ||
        strcmp(verdict_string(where, "coordinate"), "v_y") == 0);
  CHECK_TEXT(verdict_string(where, "unit"), "m/s");
  CHECK(verdict_number(where, "from") < -0.1 && verdict_number(where, "to") > 0.1);
  const cJSON *const x = verdict_gap(v, "force_x"), *const again = cJSON_GetObjectItem(v, "resimulation");
  CHECK(verdict_number(x, "after") < 0.8 * verdict_number(x, "before"));
  CHECK(verdict_number(again, "after") < 0.9 * verdict_number(again, "before"));
  CHECK_TEXT(verdict_string(again, "unit"), "m");
}

// The page gives the same value and standard error as the verdict.
static void check_error(const cJSON *v) {
  const cJSON *const effect = cJSON_GetArrayItem(cJSON_GetObjectItem(v, "effects"), 0);
  const cJSON *const k = cJSON_GetObjectItem(cJSON_GetObjectItem(effect, "parameters"), "k");
  char *const page = scratch_text("named/report.html");
  const char *const row = strstr(page, "<tr><td>k<td class=n>");
  double value = 0.0, error = 0.0;
  CHECK(row && sscanf(row, "<tr><td>k<td class=n>%lf<td class=n>%lf", &value, &error) == 2);
  CHECK_NEAR(value, verdict_number(k, "value"), 1e-3 * value);
  CHECK_NEAR(error, verdict_number(k, "stderr"), 0.05 * error);
  free(page);
}

static void check_page(void) {
  static const char *const holds[] = {"<!doctype html>",
                                      "<svg",
                                      "Missing: rotor_drag",
                                      "<code>at each hub F_xy = -k Om_i v_xy</code>",
                                      "standard error",
                                      "m/s</text>",
                                      "two standard errors",
                                      "That it is there has a probability of more than 0.999, if the library",
                                      "On flights that were not used",
                                      "Flown again in closed loop",
                                      "What these flights cannot tell",
                                      "<footer class=quiet><p>gap ",
                                      "seed 1, ",
                                      " rows of 3 flights</p>",
                                      "<p><code>gap --vehicle ",
                                      "</html>"};
  static const char *const never[] = {"<script", "http", "src=", "href=", "url(",
                                      "@import", ">nan", "Lnan", "Mnan"};
  char *const page = scratch_text("named/report.html");
  for (unsigned i = 0; i < sizeof holds / sizeof *holds; i++) {
    ROW("%s", holds[i]);
    CHECK(strstr(page, holds[i]));
  }
  for (unsigned i = 0; i < sizeof never / sizeof *never; i++) {
    ROW("%s", never[i]);
    CHECK(!strstr(page, never[i]));
  }
  free(page);
}

// model.toml is the vehicle file in its own words, and the effect with the verdict's numbers.
static void check_model(const cJSON *v) {
  model_t m, plain;
  why_t why = {""};
  char text[2000], *const file = scratch_text("named/model.toml");
  CHECK(strstr(file, "utiasDSL/drone-models") &&
        strstr(file, "# Found by the discrepancy workflow in 2 flights, "));
  CHECK(strstr(file, "# Written by gap: ") == file && strstr(file, "\n# made by gap ") &&
        strstr(file, "\n# gap --vehicle ") && strstr(file, " rows, seed 1\n"));
  free(file);
  CHECK_OK(model_read(scratch_path("room.toml"), &plain, &why));
  CHECK_OK(model_read(scratch_path("named/model.toml"), &m, &why));
  CHECK_TEXT(why.text, "");
  CHECK(m.mass_kg == plain.mass_kg && m.ceiling_m == plain.ceiling_m && plain.n_fx == 0 && m.n_fx == 1);
  CHECK_TEXT(m.fx[0].fx->name, "rotor_drag");
  const cJSON *const effect = cJSON_GetArrayItem(cJSON_GetObjectItem(v, "effects"), 0);
  CHECK_NEAR(verdict_number(effect, "probability"), 0.999, 0.0); // as is said in words
  const cJSON *const k = cJSON_GetObjectItem(cJSON_GetObjectItem(effect, "parameters"), "k");
  CHECK_NEAR(m.fx[0].p[0], verdict_number(k, "value"), 1e-8 * DRAG_KG);
  CHECK(program_run("fly ceiling-gap --vehicle $S/named/model.toml", STREAM_ERROR, text, sizeof text) == 0);
  CHECK_TEXT(text, "");
}

TEST(gap_names_a_hidden_drag_shows_it_and_writes_a_model_that_flies) {
  fx_use_t hidden = fx_use(fx_find("rotor_drag"));
  hidden.p[0] = DRAG_KG;
  char text[4000];
  CHECK(gap_logs_fly("c", 3, &hidden));
  CHECK(program_run(GAP "--out $S/named --json $S/same.json $S/c?.csv", STREAM_OUTPUT, text, sizeof text) ==
        0);
  CHECK(strstr(text, "\nMissing in room.toml: rotor_drag.\n") != NULL);
  CHECK(strstr(text, ", probability 0.999, p ") != NULL);
  CHECK(strstr(text, "held out: 1 of 3 flights\n") != NULL);
  cJSON *const v = verdict_read("named/verdict.json"), *const same = verdict_read("same.json");
  CHECK_TEXT(verdict_string(v, "verdict"), "named");
  CHECK(cJSON_Compare(v, same, true));
  verdict_check(v);
  check_drag(v);
  const cJSON *const held = cJSON_GetObjectItem(verdict_gap(v, "force_z"), "held_out");
  CHECK(cJSON_GetArraySize(held) == 1 && strstr(cJSON_GetArrayItem(held, 0)->valuestring, "c2.csv"));
  check_page();
  check_error(v);
  check_model(v);
  cJSON_Delete(v);
  cJSON_Delete(same);
}

TEST(gap_reads_a_usd_log_as_the_same_flight_and_holds_out_what_it_is_told) {
  fx_use_t hidden = fx_use(fx_find("rotor_drag"));
  hidden.p[0] = DRAG_KG;
  char text[4000];
  double k[2];
  CHECK(gap_logs_fly("b", test_long() ? 3 : 2, &hidden));
  for (int i = 0; i < 2; i++) {
    ROW("%s", i ? "uSD" : "CSV");
    CHECK(program_run(i ? GAP "--json $S/k.json --hold-out $S/b1.bin $S/b?.bin"
                        : GAP "--json $S/k.json --hold-out $S/b1.csv $S/b?.csv",
                      STREAM_OUTPUT, text, sizeof text) == 0);
    cJSON *const v = verdict_read("k.json");
    const cJSON *const effect = cJSON_GetArrayItem(cJSON_GetObjectItem(v, "effects"), 0);
    CHECK_TEXT(verdict_string(effect, "name"), "rotor_drag");
    const cJSON *const held = cJSON_GetObjectItem(verdict_gap(v, "force_x"), "held_out");
    CHECK(cJSON_GetArraySize(held) == 1 && strstr(cJSON_GetArrayItem(held, 0)->valuestring, "b1."));
    k[i] = verdict_number(cJSON_GetObjectItem(cJSON_GetObjectItem(effect, "parameters"), "k"), "value");
    cJSON_Delete(v);
  }
  CHECK_NEAR(k[1], k[0], 0.01 * k[0]); // floats differ in their last digits: a tenth of the standard error
}

// --- nothing, and what has no name ----------------------------------------------------------------------

TEST(gap_says_none_and_the_smallest_sizes_where_nothing_is_hidden) {
  char text[4000];
  // Not the rig's first flight: that one leaves about twice its floor in turn_y, depending on the compiler.
  CHECK(gap_logs_fly("n", 2, NULL));
  CHECK(program_run(GAP "--json $S/none.json $S/n1.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "Nothing is missing in room.toml that these flights could show.\n") != NULL);
  CHECK(strstr(text, "held out: stretches of 2 s of the flight, by turns\n") != NULL);
  cJSON *const v = verdict_read("none.json");
  CHECK_TEXT(verdict_string(v, "verdict"), "none");
  verdict_check(v);
  CHECK(cJSON_GetArraySize(cJSON_GetObjectItem(v, "effects")) == 0 &&
        cJSON_IsNull(cJSON_GetObjectItem(v, "unknown")));
  CHECK(strstr(text, "  They would have shown, from this size on: ") != NULL);
  CHECK(cJSON_GetArraySize(cJSON_GetObjectItem(v, "would_show")) > 0);
  cJSON_Delete(v);
}

// Writes the rows of a log within these seconds, or all others, to part.csv.
static const char *rows_of(double from_s, double to_s, bool without) {
  static char line[200];
  snprintf(line, sizeof line, "awk -F, 'NR == 1 || %s($1 >= %.0f && $1 < %.0f)' $S/n1.csv >$S/part.csv; ",
           without ? "!" : "", 1e3 * from_s, 1e3 * to_s);
  return line;
}

TEST(gap_cannot_tell_by_a_flight_too_short_for_each_turn_to_be_held_out) {
  static const struct {
    double length_s;
    bool tells;
  } row[] = {{3.0, false}, {5.5, false}, {8.0, true}};
  CHECK(gap_logs_fly("n", 2, NULL));
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g s", row[i].length_s);
    char line[600], text[4000];
    snprintf(line, sizeof line, "%s%s$S/part.csv", rows_of(6.0, 6.0 + row[i].length_s, false), GAP);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK((strstr(text, "These flights cannot tell what is missing") == NULL) == row[i].tells);
    CHECK(!strstr(text, "more is left than noise and feedback leave"));
  }
}

TEST(gap_notes_what_its_vehicle_file_does_not_say_first_of_all) {
  char line[600], text[4000];
  CHECK(gap_logs_fly("n", 2, NULL));
  snprintf(line, sizeof line,
           "%ssed '/^kf_Ns2/d; /^top_half_m/d' $S/room.toml >$S/lacks.toml; gap --vehicle $S/lacks.toml "
           "--columns tools/columns/fly.toml $S/part.csv",
           rows_of(6.0, 9.0, false));
  CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "\n\nnote: lacks.toml does not say body.top_half_m, rotors.kf_Ns2: those of a Crazyflie "
                     "are taken, scaled to "
                     "this mass and radius\n") != NULL);
}

// In the log of a hover under the ceiling, 0.8 g push the vehicle down for 30 ms.
TEST(gap_notes_when_a_vehicle_bumped_into_the_ceiling) {
  for (int bump = 0; bump < 2; bump++) {
    ROW("%s", bump ? "a bump" : "none");
    char line[600], text[6000];
    snprintf(
        line, sizeof line,
        "(echo 'ceiling_m = 0.5'; cat sim/vehicle/vehicles/cf21_legacy.toml) >$S/under.toml; fly "
        "test-flight --seed 5 --log $S/whole.csv >$S/fly.txt; awk -F, -v OFS=, '$1 > 36000 && $1 < 36035 "
        "{$11 -= %g} 1' $S/whole.csv >$S/bump.csv; gap --vehicle $S/under.toml $S/bump.csv",
        bump ? 0.8 : 0.0);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    const char *const said =
        strstr(text, "note: bump.csv: it touched the ceiling, at about 36.0 s for the first "
                     "time; what was measured then is left out\n");
    CHECK(bump ? said != NULL : !strstr(text, "it touched"));
  }
}

// A flight that is flown again takes the commands of its own time: later ones, behind the gap, would lift and
// sink it.
TEST(gap_flies_again_behind_a_gap_in_time_as_before_it) {
  double off_m[2];
  CHECK(gap_logs_fly("n", 2, NULL));
  for (int i = 0; i < 2; i++) {
    ROW("%s", i ? "3.1 s missing" : "whole");
    char line[600], text[4000];
    snprintf(line, sizeof line, "%s%s--json $S/part.json $S/part.csv", rows_of(8.0, i ? 11.1 : 8.0, true),
             GAP);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    cJSON *const v = verdict_read("part.json");
    off_m[i] = verdict_number(cJSON_GetObjectItem(v, "resimulation"), "height_after");
    cJSON_Delete(v);
  }
  CHECK_NEAR(off_m[1], off_m[0], 0.2 * off_m[0]);
}

TEST(gap_lists_what_missing_rates_leave_untested) {
  char text[4000];
  CHECK(gap_logs_fly("r", 1, NULL));
  CHECK(program_run("grep -v '^gz' tools/columns/fly.toml >$S/blind.toml; gap --vehicle $S/room.toml "
                    "--columns $S/blind.toml --json $S/blind.json $S/r0.csv",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  cJSON *const v = verdict_read("blind.json");
  static const char *const turns[] = {"cg_offset", "flapping", "inertia", "gyroscopic"};
  for (unsigned i = 0; i < sizeof turns / sizeof *turns; i++) {
    ROW("%s", turns[i]);
    bool listed = false;
    const cJSON *one;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "not_testable")) listed |=
        strcmp(verdict_string(one, "effect"), turns[i]) == 0 &&
        strstr(verdict_string(one, "why"), "residuals");
    CHECK(listed);
  }
  cJSON_Delete(v);
}

// The battery was strapped on elsewhere before the second flight.
TEST(gap_writes_of_every_flight_what_it_has_where_flights_differ) {
  char text[4000];
  fx_use_t offset = fx_use(fx_find("cg_offset"));
  offset.p[0] = 0.002;
  CHECK(gap_logs_fly("one", 1, NULL) && gap_logs_fly("two", 1, &offset));
  CHECK(program_run(GAP "--json $S/differ.json $S/one0.csv $S/two0.csv", STREAM_OUTPUT, text, sizeof text) ==
        0);
  cJSON *const v = verdict_read("differ.json");
  verdict_check(v);
  CHECK_TEXT(verdict_string(v, "verdict"), "unknown");
  const cJSON *const group =
      cJSON_GetArrayItem(cJSON_GetObjectItem(cJSON_GetObjectItem(v, "unknown"), "from_flight_to_flight"), 0);
  CHECK_TEXT(verdict_string(group, "channel"), "turn_y"); // because the offset is forwards
  CHECK_TEXT(verdict_string(group, "unit"), "rad/s2");
  const cJSON *const flights = cJSON_GetObjectItem(group, "flights");
  const cJSON *const would = cJSON_GetArrayItem(cJSON_GetObjectItem(group, "acts_as"), 0);
  const cJSON *const parameters = cJSON_GetObjectItem(would, "parameters");
  CHECK_TEXT(verdict_string(would, "name"), "cg_offset");
  CHECK(verdict_number(would, "share") > 0.9);
  if (CHECK(cJSON_GetArraySize(flights) == 2 && cJSON_GetArraySize(parameters) == 2)) {
    const cJSON *const one = cJSON_GetArrayItem(flights, 0), *const two = cJSON_GetArrayItem(flights, 1);
    CHECK(strstr(verdict_string(one, "log"), "one0.csv") && strstr(verdict_string(two, "log"), "two0.csv"));
    CHECK(fabs(verdict_number(one, "mean") - verdict_number(two, "mean")) >
          10.0 * hypot(verdict_number(one, "stderr"), verdict_number(two, "stderr")));
    CHECK_NEAR(verdict_number(cJSON_GetArrayItem(parameters, 1), "dx") -
                   verdict_number(cJSON_GetArrayItem(parameters, 0), "dx"),
               offset.p[0], 0.1 * offset.p[0]);
  }
  cJSON_Delete(v);
}

TEST(gap_says_where_something_without_a_name_is) {
  char text[4000];
  strange_t answer;
  const fx_use_t push = truth_strange(1, 3.0, &answer);
  CHECK(gap_logs_fly("u", 2, &push));
  CHECK(program_run(GAP "--json $S/unknown.json $S/u?.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  cJSON *const v = verdict_read("unknown.json");
  const cJSON *const u = cJSON_GetObjectItem(v, "unknown");
  CHECK_TEXT(verdict_string(v, "verdict"), "unknown");
  verdict_check(v);
  CHECK(cJSON_GetArraySize(u) == 10 && cJSON_IsArray(cJSON_GetObjectItem(u, "acts_as")) &&
        cJSON_GetArraySize(cJSON_GetObjectItem(u, "from_flight_to_flight")) == 0 &&
        verdict_number(u, "stderr") > 0.0);
  CHECK_TEXT(verdict_string(u, "coordinate"), answer.coordinate);
  CHECK(strcmp(verdict_string(u, "channel"), "force_x") == 0 ||
        strcmp(verdict_string(u, "channel"), "force_y") == 0);
  CHECK_TEXT(verdict_string(u, "unit"), "m/s2");
  CHECK(verdict_number(u, "from") < verdict_number(u, "to") && verdict_number(u, "size") != 0.0);
  cJSON_Delete(v);
}
