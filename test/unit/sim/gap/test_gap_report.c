// test_gap_report.c - what the workflow's outputs say of a finished diagnosis.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "gap/5_infer/unknown.h"
#include "gap/8_report/page.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/splitmix.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define N 50

TEST(gap_counts_time_from_the_beginning_of_the_log) {
  double t_s[6] = {100.0, 110.0, 120.0, 130.0, 140.0, 150.0};
  const gap_flight_t flight = {.n = 6, .t_s = t_s};
  grid_point_t last[2] = {{.t_s = 140.0, .q_wb = {1.0, 0.0, 0.0, 0.0}},
                          {.t_s = 150.0, .q_wb = {1.0, 0.0, 0.0, 0.0}}};
  const grid_t third = {.flight = &flight, .from = 4, .samples = 2, .n = 2, .point = last};
  model_t m;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &m, &why));
  int time = 0;
  while (strcmp(coordinate_name(time), "time") != 0) time++;
  CHECK_NEAR(coordinate_of(time, &third, &m, 0), 40.0, 0.0);
  CHECK_NEAR(coordinate_of(time, &third, &m, 1), 50.0, 0.0);
}

TEST(gap_gives_a_probability_alike_in_words_and_in_numbers) {
  static const struct {
    double p, number;
    const char *words;
  } cases[] = {{0.0031, 0.0031, "p 0.003"},
               {2e-13, 2e-13, "p 2e-13"},
               {5e-114, 1e-16, "p < 1e-16"},
               {0.0, 1e-16, "p < 1e-16"}};
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    char words[P_TEXT];
    ROW("%g", cases[i].p);
    CHECK_NEAR(p_value(cases[i].p), cases[i].number, 0.0);
    CHECK_TEXT(p_words(cases[i].p, words), cases[i].words);
  }
}

// Rms before, after and of the floor; what is noted of force_z.
static const struct {
  const char *what;
  gap_part_t part;
  const char *note; // null: none
} floors[] = {
    {"noise", {.used = true, .before = 0.2, .after = 0.1, .floor = 0.08}, NULL},
    {"more than noise", {.used = true, .before = 0.3, .after = 0.2, .floor = 0.09}, "more than can be named"},
    {"a floor a little above the log", {.used = true, .before = 0.1, .after = 0.1, .floor = 0.19}, NULL},
    {"a pilot that shakes more than who flew",
     {.used = true, .before = 0.1, .after = 0.1, .floor = 0.21},
     "shake more than who flew (force_z 0.21, not 0.1 m/s2)"},
    {"a channel that is left out", {.before = 0.1, .after = 0.1, .floor = 0.21}, NULL},
};

TEST(gap_notes_where_floor_and_log_are_not_of_one_flight) {
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &study->vehicle, &why));
  r->study = study;
  study->resimulation.flew = study->diagnosis.nominal_flew = true;
  for (unsigned i = 0; i < sizeof floors / sizeof *floors; i++) {
    ROW("%s", floors[i].what);
    study->diagnosis.held_out.channel[CH_FZ] = floors[i].part;
    memset(&r->warnings, 0, sizeof r->warnings);
    report_warn(r);
    const char *said = NULL;
    for (int k = 0; k < r->warnings.n; k++)
      if (strstr(r->warnings.line[k], "force_z")) said = r->warnings.line[k];
    CHECK((said != NULL) == (floors[i].note != NULL));
    if (said && floors[i].note) CHECK(strstr(said, floors[i].note) != NULL);
  }
  free(study);
  free(r);
}

TEST(gap_notes_heights_that_do_not_count_from_one_floor) {
  static const struct {
    double floor_m[2];
    bool known[2], noted;
  } row[] = {{{0.05, 0.0}, {true, false}, true},
             {{0.0, 0.05}, {false, true}, true},
             {{0.05, 0.05}, {true, true}, false},
             {{0.0, 0.0}, {true, false}, false}};
  double z_m[1] = {0.3};
  gap_flight_t flight[2];
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &study->vehicle, &why));
  r->study = study;
  study->flight = flight;
  study->fit.n = study->held.n = 1;
  study->resimulation.flew = true;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%u", i);
    for (int k = 0; k < 2; k++)
      flight[k] = (gap_flight_t){.name = {(char)('a' + k)},
                                 .v = {[SIG_Z] = z_m},
                                 .floor_m = row[i].floor_m[k],
                                 .floor_known = row[i].known[k]};
    memset(&r->warnings, 0, sizeof r->warnings);
    report_warn(r);
    bool noted = false;
    for (int k = 0; k < r->warnings.n; k++) noted = noted || strstr(r->warnings.line[k], "where it stood");
    CHECK(noted == row[i].noted);
  }
  free(study);
  free(r);
}

// Only what the vehicle file does not say is asked for.
TEST(gap_asks_of_a_pilot_that_shakes_what_the_vehicle_file_does_not_say) {
  static const struct {
    const char *what;
    flown_by_kind_t flown_by;
    bool rotors;
    const char *asks;
  } row[] = {
      {"nothing is said", FLOWN_BY_UNKNOWN, false,
       "is not named; [controller] and rotors.inertia_kgm2 in the vehicle file would tell more of it"},
      {"the rotors are", FLOWN_BY_UNKNOWN, true,
       "is not named; [controller] in the vehicle file would say who flew"},
      {"who flew is", FLOWN_BY_STOCK_PID, false,
       "is not named; rotors.inertia_kgm2 in the vehicle file would tell more of it"},
      {"who flew is, and nobody knows it", FLOWN_BY_OTHER, true, "is not named"},
      {"both are", FLOWN_BY_INDI, true, "is not named"},
  };
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  r->study = study;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &study->vehicle, &why));
  study->resimulation.flew = study->diagnosis.nominal_flew = true;
  study->diagnosis.held_out.channel[CH_WX] =
      (gap_part_t){.used = true, .before = 10.0, .after = 10.0, .floor = 90.0};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    study->vehicle.frame_lacks = row[i].rotors ? 0 : 1u << 10;
    study->flown_by.kind = row[i].flown_by;
    memset(&r->warnings, 0, sizeof r->warnings);
    report_warn(r);
    const char *said = "";
    for (int k = 0; k < r->warnings.n; k++)
      if (strstr(r->warnings.line[k], "shake more")) said = r->warnings.line[k];
    said = strstr(said, "is not ");
    if (!CHECK(said != NULL)) continue;
    CHECK_TEXT(said, row[i].asks);
  }
  free(study);
  free(r);
}

// A flight that turns, and what an attitude that is late leaves of its forces beside noise.
static void turn_late(report_t *r, study_t *study, double late_s, double noise_mps2) {
  enum { POINTS = 600 };
  splitmix_t draw = {5};
  why_t why;
  grid_t *const grid = calloc(1, sizeof *grid);
  grid->n = POINTS, grid->period_s = 0.02;
  grid->point = calloc(POINTS, sizeof *grid->point);
  grid->acceleration_made = grid->has_rates = grid->has_attitude = true;
  for (int j = 0; j < POINTS; j++)
    grid->point[j] = (grid_point_t){.t_s = 0.02 * j,
                                    .ok = true,
                                    .rate_b_radps = {sin(0.1 * j), cos(0.13 * j), 0.3},
                                    .range_m = (double)NAN};
  set_t *const held = &study->diagnosis.held;
  CHECK_OK(set_make(held, grid, 1, &why));
  CHECK_OK(lines_make(&r->after, held, &why));
  study->diagnosis.held_out.channel[CH_FX].used = study->diagnosis.held_out.channel[CH_FY].used = true;
  for (int i = 0; i < held->smooth.n; i++) {
    const d3_t rate = grid->point[held->smooth.point[i]].rate_b_radps;
    r->after.r[CH_FX][i] = G_MPS2 * late_s * rate.y + splitmix_normal(&draw, noise_mps2);
    r->after.r[CH_FY][i] = -G_MPS2 * late_s * rate.x + splitmix_normal(&draw, noise_mps2);
  }
}

TEST(gap_notes_an_attitude_that_is_not_of_the_time_of_the_forces) {
  static const struct {
    double late_s, noise_mps2, said_s, moved_s; // left; beside it; by the columns file; as that says nothing
    const char *said;                           // null: nothing
  } cases[] = {{0.0, 0.02, 0.0, 0.0, NULL},
               {0.0007, 0.02, 0.0, 0.0, NULL}, // sure, and too little
               {0.0013, 0.02, 0.0, 0.0, "1.3 +- 0.1 ms late"},
               {0.004, 0.02, 0.0, 0.0,
                "4 +- 0.1 ms late against the velocities; if it is (a simulator's own step, an estimator), "
                "write late_ms = 4.0 at its columns"},
               {0.003, 0.1, 0.0, 0.0, " ms late against"},
               {0.003, 0.25, 0.0, 0.0, NULL}, // less than four standard errors
               {-0.003, 0.02, 0.001, 0.0, "late_ms = -2.0"},
               {0.003, 0.02, 0.0, 0.012, "late_ms = 15.0"}};
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%g s, noise %g", cases[i].late_s, cases[i].noise_mps2);
    study_t *const study = calloc(1, sizeof *study);
    report_t *const r = calloc(1, sizeof *r);
    why_t why;
    CHECK_OK(model_builtin("cf21_legacy", &study->vehicle, &why));
    study->resimulation.flew = true;
    r->study = study;
    gap_flight_t flight = {.attitude_late_s = cases[i].moved_s};
    study->flight = &flight;
    study->columns.of[SIG_QW].late_s = cases[i].said_s;
    study->columns.of[SIG_QW].late_said = cases[i].said_s != 0.0;
    turn_late(r, study, cases[i].late_s, cases[i].noise_mps2);
    report_warn(r);
    const char *said = NULL;
    for (int k = 0; k < r->warnings.n; k++)
      if (strstr(r->warnings.line[k], "goes with the turn rates")) said = r->warnings.line[k];
    CHECK((said != NULL) == (cases[i].said != NULL));
    if (said && cases[i].said && !CHECK(strstr(said, cases[i].said) != NULL)) fprintf(stderr, "%s\n", said);
    lines_free(&r->after);
    set_free(&study->diagnosis.held);
    free(study);
    free(r);
  }
}

TEST(gap_notes_a_name_with_which_the_vehicle_flies_worse) {
  static const struct {
    int named, lost;
    double before_m, after_m;
    bool noted;
  } cases[] = {{1, 0, 0.004, 0.0079, false},
               {1, 0, 0.004, 0.0081, true},
               {0, 0, 0.004, 0.0081, false},
               {1, 1, 0.004, 0.0081, false}};
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%g", cases[i].after_m);
    study_t *const study = calloc(1, sizeof *study);
    report_t *const r = calloc(1, sizeof *r);
    why_t why;
    CHECK_OK(model_builtin("cf21_legacy", &study->vehicle, &why));
    r->study = study;
    r->n_finding = cases[i].named;
    r->finding[0].fx = fx_find("mass");
    study->resimulation = (resimulation_t){.flew = true,
                                           .before = {.height_m = cases[i].before_m},
                                           .after = {.height_m = cases[i].after_m, .lost = cases[i].lost}};
    report_warn(r);
    bool noted = false;
    for (int k = 0; k < r->warnings.n; k++)
      noted =
          noted || strstr(r->warnings.line[k], "further off the measured height than without, 4 mm to 8.1");
    CHECK(noted == cases[i].noted);
    free(study);
    free(r);
  }
}

// Off the measured track by so much along x, y and height, with the old model and with the new one.
static const struct {
  double before[3], after[3];
  const char *label;
} tracks[] = {
    {{0.30, 0.10, 0.05}, {0.30, 0.02, 0.05}, ">error in y, m<"},
    {{0.02, 0.30, 0.10}, {0.02, 0.29, 0.01}, ">error in height, m<"},
    {{0.10, 0.30, 0.02}, {0.01, 0.31, 0.02}, ">error in x, m<"},
    {{0.02, 0.30, 0.10},
     {0.02, 0.40, 0.10},
     ">error in y, m<"}, // none is better: the one that was missed most
};

static char *track_of(const double before[3], const double after[3]) {
  static double t_s[N], line[6][N];
  resimulation_t a = {.flew = true, .n = N, .t_s = t_s};
  for (int k = 0; k < 3; k++) {
    a.before.off_m[k] = line[k], a.after.off_m[k] = line[3 + k];
    for (int j = 0; j < N; j++) {
      t_s[j] = 0.1 * j;
      line[k][j] = before[k];
      line[3 + k][j] = after[k];
    }
  }
  char *text = NULL;
  size_t size;
  FILE *const file = open_memstream(&text, &size);
  if (!file) abort();
  picture_track(&a, file);
  fclose(file);
  return text;
}

TEST(gap_draws_the_track_along_the_axis_that_improved_most) {
  for (unsigned i = 0; i < sizeof tracks / sizeof *tracks; i++) {
    ROW("track %u", i);
    char *const text = track_of(tracks[i].before, tracks[i].after);
    CHECK(strstr(text, tracks[i].label) != NULL);
    free(text);
  }
}

TEST(gap_makes_the_folders_that_its_output_folder_lies_in) {
  char text[2000];
  scratch_file("none.csv", "timestamp\n", -1);
  CHECK(program_run("gap --out $S/deep/er/est/ $S/none.csv; test -f $S/deep/er/est/verdict.json",
                    STREAM_ERROR, text, sizeof text) == 0);
}
