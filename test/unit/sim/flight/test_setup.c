// test_setup.c - everything that one flight needs, and what becomes of it when the flight cannot be flown.
#define _DEFAULT_SOURCE // fork, setrlimit, timespec_get
#include "rig/flights.h"
#include "rig/test.h"
#include "vehicle/effect_spec.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

TEST(setup_takes_a_vehicles_own_effects_or_leaves_the_scenarios) {
  static const struct {
    const char *what, *own; // effect of the vehicle
    double ceiling_m, want_ca, want_ceiling_m;
    bool no_effects; // of the scenario
  } row[] = {
      {"none", NULL, HUGE_VAL, 0.44, 0.5, false},
      {"a ceiling effect", "ceiling:Ca=0.2", HUGE_VAL, 0.2, 0.5, false},
      {"a ceiling effect and a ceiling", "ceiling:Ca=0.2", 0.8, 0.2, 0.8, false},
      {"none, nor has the scenario", NULL, HUGE_VAL, 0.0, 0.5, true},
      {"a ceiling effect, the scenario none", "ceiling:Ca=0.2", HUGE_VAL, 0.2, 0.5,
       true}, // was taken away, too
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    setup_t setup;
    why_t why = {""};
    CHECK_OK(scenario_appendix_a_setup(&setup, FLY_INDI, &why));
    model_t vehicle = {.name = "own", .mass_kg = 0.04, .ceiling_m = row[i].ceiling_m};
    fx_use_t use;
    if (row[i].own) {
      CHECK_OK(effect_parse(row[i].own, &use, &why));
      CHECK_OK(model_add_fx(&vehicle, &use, &why));
    }
    const request_t request = {.vehicle = &vehicle, .no_effects = row[i].no_effects};
    CHECK_OK(setup_apply(&setup, &request, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(setup.model.mass_kg, 0.04, 0.0);
    CHECK_NEAR(setup.model.ceiling_m, row[i].want_ceiling_m, 0.0);
    if (!CHECK(setup.model.n_fx == (row[i].want_ca > 0.0)) || setup.model.n_fx == 0) continue;
    CHECK_NEAR(setup.model.fx[0].p[0], row[i].want_ca, 1e-12);
  }
}

static rbf_weights_t learned_with(uint64_t seed) {
  setup_t setup = flights_appendix_a(FLY_INDI_LEARNED, 8.0f, 0.3f, true);
  setup.plan.seed = seed;
  flown_t flown;
  why_t why;
  if (!CHECK_OK(setup_fly(&setup, &flown, &why))) return (rbf_weights_t){{0.0f}};
  const rbf_weights_t w = flown.weights;
  flown_free(&flown);
  return w;
}

TEST(setup_learns_with_noise_also_where_the_flight_has_none) {
  const rbf_weights_t one = learned_with(1), two = learned_with(2), again = learned_with(1);
  CHECK(memcmp(&one, &again, sizeof one) == 0);
  CHECK(memcmp(&one, &two, sizeof one) != 0);
}

#ifndef __has_feature
#define __has_feature(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
#define LIMITED 0 // the sanitizer itself needs terabytes of addresses
#else
#define LIMITED 1
#endif

// In a process of its own: a flight of eleven days that may have 32 MB more than now.
static int fly_out_of_memory(void) {
  setup_t setup = flights_appendix_a(FLY_INDI, 8.0f, 0.3f, true);
  setup.plan.end_s = 1e6;
  unsigned long pages = 0;
  FILE *statm = fopen("/proc/self/statm", "r");
  if (!statm || fscanf(statm, "%lu", &pages) != 1) return 10;
  fclose(statm);
  const rlim_t most = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + (rlim_t)(32 << 20);
  const struct rlimit limit = {most, most};
  if (setrlimit(RLIMIT_AS, &limit) != 0) return 11;
  flown_t flown;
  why_t why = {""};
  if (setup_fly(&setup, &flown, &why) != FAILED) return 12;
  if (strcmp(why.text, "out of memory") != 0) return 13;
  return flown.record.sample || flown.record.n ? 14 : 0;
}

TEST(setup_frees_a_flight_that_failed) {
  if (!LIMITED) return;
  fflush(stdout);
  const pid_t child = fork();
  if (child == 0) _exit(fly_out_of_memory());
  int status = -1;
  CHECK(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK_NEAR(WEXITSTATUS(status), 0, 0);
}

// Stands in for the C library's: a clock that somebody sets back by an hour whenever it is read.
int timespec_get(struct timespec *now, int base) {
  static time_t s = 1000000000;
  *now = (struct timespec){.tv_sec = s -= 3600};
  return base;
}

TEST(real_time_factor_does_not_follow_the_time_of_day) {
  const setup_t setup = flights_appendix_a(FLY_INDI, 8.0f, 0.3f, true);
  flown_t flown;
  why_t why;
  if (!CHECK_OK(setup_fly(&setup, &flown, &why))) return;
  // 40 s in less than 40 us nobody flies.
  CHECK(flown.outcome.realtime_factor > 1.0 && flown.outcome.realtime_factor < 1e6);
  flown_free(&flown);
}
