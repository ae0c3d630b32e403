// test_gap_deck.c - what a uSD deck is asked to log is what the workflow reads.
#include "crazyflie/usd_config.h"
#include "gap/1_read/flight.h"
#include "logs/columns.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <string.h>

static bool asked(const usd_config_event_t *e, const char *name) {
  for (int i = 0; i < e->n; i++)
    if (strcmp(e->variable[i], name) == 0) return true;
  return false;
}

TEST(gap_reads_all_that_its_usd_config_asks_the_deck_for) {
  static const signal_id_t needed[] = {SIG_X,  SIG_Y,  SIG_Z,  SIG_VX, SIG_VY,  SIG_VZ,   SIG_AX,
                                       SIG_AY, SIG_AZ, SIG_GX, SIG_GY, SIG_GZ,  SIG_ROLL, SIG_PITCH,
                                       SIG_M1, SIG_M2, SIG_M3, SIG_M4, SIG_YAW, SIG_VBAT};
  const columns_t own = columns_crazyflie();
  usd_config_t config;
  why_t why = {""};
  if (!CHECK_OK(usd_config_read("tools/usd/gap.txt", &config, &why))) return;
  CHECK(config.n == 1 && strcmp(config.event[0].name, "fixedFrequency") == 0);
  CHECK(config.frequency_Hz == 500 && config.mode == 1);
  CHECK(config.event[0].n == (int)(sizeof needed / sizeof *needed));
  for (unsigned i = 0; i < sizeof needed / sizeof *needed; i++) {
    ROW("%s", own.of[needed[i]].column);
    CHECK(asked(&config.event[0], own.of[needed[i]].column));
  }
}

static bool read_flight(const char *log, const char *file, gap_flight_t *f) {
  columns_t columns;
  model_t model;
  why_t why = {""};
  const bool good = CHECK_OK(columns_read(file, &columns, &why)) &&
                    CHECK_OK(model_builtin("cf21_legacy", &model, &why)) &&
                    CHECK_OK(gap_read(f, scratch_path(log), &columns, &model, &why));
  CHECK_TEXT(why.text, "");
  return good;
}

// Root mean square of what one log says less what the other says at the nearest instant.
static double apart(const gap_flight_t *a, const gap_flight_t *b, signal_id_t i) {
  double sum = 0.0;
  int n = 0;
  for (int j = 0, k = 0; j < a->n && k < b->n; j++) {
    while (k + 1 < b->n && b->t_s[k + 1] <= a->t_s[j] + 1e-3) k++;
    const double d = a->v[i][j] - b->v[i][k];
    if (isnan(d)) continue;
    sum += d * d;
    n++;
  }
  return CHECK(n > 10000) ? sqrt(sum / n) : HUGE_VAL;
}

static int new_ranges(const gap_flight_t *f) {
  int n = 0;
  for (int i = 0; f->v[SIG_RANGE] && i < f->n; i++) n += !isnan(f->v[SIG_RANGE][i]);
  return n;
}

TEST(gap_reads_the_apps_own_log_as_the_flight_that_it_is) {
  static const struct {
    const char *what;
    signal_id_t signal;
    double most; // what two samples a millisecond apart differ by, and their mean from one of them
  } row[] = {{"z", SIG_Z, 5e-4},   {"vz", SIG_VZ, 3e-3}, {"az", SIG_AZ, 0.05},
             {"gx", SIG_GX, 0.02}, {"qx", SIG_QX, 5e-4}, {"f1", SIG_F1, 1.5e-3}};
  gap_flight_t csv = {0}, deck = {0};
  char text[200];
  CHECK(program_run("fly test-flight --log $S/deck.csv --log-rate 500 --usd $S/deck00 --usd-config "
                    "tools/usd/config.txt >$S/deck.txt",
                    STREAM_ERROR, text, sizeof text) == 0);
  if (read_flight("deck.csv", "tools/columns/fly.toml", &csv) &&
      read_flight("deck00", "tools/columns/app.toml", &deck)) {
    for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
      ROW("%s", row[i].what);
      CHECK_NEAR(apart(&csv, &deck, row[i].signal), 0.0, row[i].most);
    }
    // The deck's rows of other events lie between: what the sensor said last is no new sample.
    CHECK(new_ranges(&csv) > 250);
    CHECK_NEAR(new_ranges(&deck), new_ranges(&csv), 5);
  }
  gap_flight_free(&csv);
  gap_flight_free(&deck);
}
