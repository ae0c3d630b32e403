// test_gap_extend.c - the vehicle file with what was named: it reads back as what was found.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "gap/6_extend/extend.h"
#include "gap/diagnose.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdlib.h>
#include <string.h>

static const char VEHICLE[] = "name = \"test\" # a word of its own\nmass_kg = 0.03\nrotor_radius_m = 0.02\n"
                              "motor_tau_s = 0.05\nthrust_min_N = 0.0\nthrust_max_N = 0.6\nceiling_m = 1.0\n";

// What extend_write makes of a vehicle file's text where this was found.
static done_t extend(const char *path, const char *text, const fx_use_t *use, char *out, size_t size,
                     model_t *base, why_t *why) {
  found_t found = {.n = 1, .chosen = {.n = 1, .use = {*use}}};
  found.named[0] = (named_t){.candidate = 0, .stderr_ = {0.01, 0.02, 0.03}, .p = 1e-5, .share = 0.25};
  char *made = NULL;
  out[0] = 0;
  size_t used = 0;
  TRY(model_read_text(path, text, base, why));
  FILE *const file = open_memstream(&made, &used);
  const extend_job_t job = {path, text, base, &found, "3 flights, seed 1", NULL};
  const done_t status = extend_write(&job, file, why);
  fclose(file);
  snprintf(out, size, "%s", made);
  free(made);
  return status;
}

static fx_use_t some_of(const char *name) {
  fx_use_t use = fx_use(fx_find(name));
  const double first = fx_use_size(&use, 0);
  for (int k = 0; k < use.fx->n_size; k++) fx_use_resize(&use, k, 3.0 / 7.0 / (k + 1) * first);
  if (use.fx->n_shape) use.p[use.fx->shape_param] = use.fx->shape[1];
  return use;
}

TEST(gap_extends_a_vehicle_file_by_every_effect_that_can_be_named) {
  for (int i = 0; i < fx_count; i++) {
    if (fx_table[i]->n_size == 0) continue;
    ROW("%s", fx_table[i]->name);
    const fx_use_t use = some_of(fx_table[i]->name);
    model_t base, m;
    why_t why = {""};
    char text[8000];
    CHECK_OK(extend("v.toml", VEHICLE, &use, text, sizeof text, &base, &why));
    CHECK_OK(model_read_text("model.toml", text, &m, &why));
    CHECK_TEXT(why.text, "");
    CHECK(strstr(text, "a word of its own") && strstr(text, "p 1e-05, 25 % of the gap"));
    CHECK(m.n_fx == 1 && m.fx[0].fx == fx_table[i] && m.fx[0].form == use.form && m.mass_kg == base.mass_kg);
    for (int k = 0; k < FX_PARAM_MAX; k++) CHECK_NEAR(m.fx[0].p[k], use.p[k], 1e-8 * fabs(use.p[k]));
  }
}

TEST(gap_writes_one_effect_of_two_names_that_are_about_its_numbers) {
  fx_use_t use[2] = {fx_use(fx_find("accel_bias")), fx_use(fx_find("accel_bias"))};
  found_t found = {.n = 2, .chosen = {.n = 2, .of = {0, 1}}};
  model_t base, m;
  why_t why = {""};
  char *text = NULL;
  size_t size = 0;
  for (int i = 0; i < 2; i++) {
    for (int k = 0; k < 3; k++) fx_use_resize(&use[i], k, i == (k == 2) ? 0.1 * (k + 1) : 0.0);
    found.chosen.use[i] = use[i];
    found.named[i] = (named_t){.candidate = i, .p = 1e-5, .share = 0.25};
  }
  found.named[0].stderr_[0] = found.named[0].stderr_[1] = 0.01;
  found.named[1].stderr_[2] = 0.04;
  CHECK_OK(model_read_text("v.toml", VEHICLE, &base, &why));
  FILE *const file = open_memstream(&text, &size);
  CHECK_OK(extend_write(&(extend_job_t){"v.toml", VEHICLE, &base, &found, "3 flights", NULL}, file, &why));
  fclose(file);
  CHECK_OK(model_read_text("model.toml", text, &m, &why));
  if (CHECK(m.n_fx == 1))
    for (int k = 0; k < 3; k++) CHECK_NEAR(m.fx[0].p[k], 0.1 * (k + 1), 1e-9);
  CHECK(strstr(text, "50 % of the gap") && strstr(text, "x = 0.1 # m/s2, estimated, +- 0.01") &&
        strstr(text, "z = 0.3 # m/s2, estimated, +- 0.04"));
  free(text);
}

TEST(gap_keeps_the_effects_that_a_vehicle_file_has_and_its_measured_curves) {
  char vehicle[600], text[8000];
  snprintf(vehicle, sizeof vehicle, "%s[[effect]]\nname = \"ground\"\nform = \"table\"\nfile = \"curve.csv\"",
           VEHICLE);
  scratch_file("curve.csv", "distance_over_radius,ratio\n0.5,1.25\n2,1.0625\n4,1\n", -1);
  const fx_use_t use = some_of("wind");
  char path[400];
  snprintf(path, sizeof path, "%s", scratch_path("v.toml"));
  model_t base, m;
  why_t why = {""};
  CHECK_OK(extend(path, vehicle, &use, text, sizeof text, &base, &why));
  // Read from elsewhere: the curve's file is not there.
  CHECK_OK(model_read_text("/elsewhere/model.toml", text, &m, &why));
  CHECK_TEXT(why.text, "");
  if (!CHECK(m.n_fx == 2 && m.fx[0].points.n == 3)) return;
  CHECK_NEAR(m.fx[0].points.x[1], 2.0, 0.0);
  CHECK_NEAR(m.fx[0].points.ratio[0], 1.25, 0.0);
  CHECK_TEXT(m.fx[1].fx->name, "wind");
}

TEST(gap_writes_an_effect_that_the_file_has_wrong_in_its_place) {
  static const struct {
    const char *what, *tables; // of the vehicle file
    const char *keeps, *drops;
  } row[] = {
      {"the last",
       "[[effect]]\nname = \"body_drag\"\nc = 3e-3\n\n[[effect]]\nname = \"rotor_drag\"\nk = 2e-6 # mine\n",
       "c = 3e-3", "mine"},
      {"the first, told otherwise",
       "[[effect]] # a drag\n  k = 2e-6 # mine\n  name = 'rotor_drag'\n[[effect]]\nname = \"body_drag\"\nc = "
       "3e-3\n",
       "c = 3e-3", "mine"},
  };
  const fx_use_t less = {.fx = fx_find("rotor_drag"), .p = {-5e-7, 1.0}}; // a difference
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    char vehicle[800], text[8000];
    model_t base, m;
    why_t why = {""};
    ROW("%s", row[i].what);
    snprintf(vehicle, sizeof vehicle, "%s%s", VEHICLE, row[i].tables);
    CHECK_OK(extend("v.toml", vehicle, &less, text, sizeof text, &base, &why));
    CHECK_OK(model_read_text("model.toml", text, &m, &why));
    CHECK_TEXT(why.text, "");
    CHECK(strstr(text, row[i].keeps) && !strstr(text, row[i].drops) && strstr(text, "; v.toml has 2e-06\n"));
    const fx_use_t *const drag = model_fx(&m, less.fx);
    if (CHECK(m.n_fx == 2 && drag)) CHECK_NEAR(drag->p[0], 1.5e-6, 1e-14);
  }
}

TEST(gap_says_when_a_vehicle_file_cannot_be_added_to) {
  char vehicle[600], text[8000];
  snprintf(vehicle, sizeof vehicle, "effect = [{name = \"wind\"}]\n%s", VEHICLE);
  const fx_use_t use = some_of("ground");
  model_t base;
  why_t why = {""};
  CHECK_STATUS(BAD_INPUT, extend("v.toml", vehicle, &use, text, sizeof text, &base, &why));
  CHECK(strncmp(why.text, "v.toml: the named effects cannot be added to it: model.toml:", 60) == 0);
  CHECK_TEXT(text, "");
}
