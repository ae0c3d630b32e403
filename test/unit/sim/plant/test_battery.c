// test_battery.c - the battery under load.
#include "base/csv.h"
#include "plant/battery.h"
#include "rig/vehicle6.h"
#include "vehicle/model_file.h"
#include <stdio.h>

static battery_param_t legacy(void) {
  model_t m = {.n_fx = 0};
  why_t why = {""};
  CHECK_OK(model_builtin("cf21_legacy", &m, &why));
  return m.battery;
}

TEST(battery_voltage_follows_charge_and_load) {
  const battery_param_t p = legacy();
  CHECK_NEAR(battery_open_V(&p, 1.0), 4.2, 1e-12);
  CHECK_NEAR(battery_open_V(&p, 0.95), 4.15, 1e-12);
  CHECK_NEAR(battery_open_V(&p, 0.0), 3.0, 1e-12);
  CHECK_NEAR(battery_open_V(&p, -1.0), 3.0, 1e-12);
  CHECK_NEAR(battery_open_V(&p, 2.0), 4.2, 1e-12);
  const double hover_N[ROTORS] = {0.08, 0.08, 0.08, 0.08};
  // 0.279 + 4 (5.815 0.08 + 10.27 0.0064) = 2.4027 A; 4.2 - 0.163 x 2.4027 = 3.8084 V
  CHECK_NEAR(battery_current_A(&p, hover_N, NULL, ROTORS), 2.4027, 1e-4);
  CHECK_NEAR(battery_voltage_V(&p, 1.0, 2.4027), 3.8084, 1e-4);
  CHECK_NEAR(battery_discharge(&p, 1.0, 2.5, 36.0), 1.0 - 90.0 / 900.0, 1e-12);
  CHECK(battery_discharge(&p, 0.01, 100.0, 1e4) == 0.0);
  CHECK(battery_voltage_V(&p, 0.0, 1e3) == 0.0);
  const battery_param_t none = {0};
  CHECK_NEAR(battery_voltage_V(&none, 0.3, 2.0), BATTERY_FULL_V, 0.0);
}

TEST(battery_current_is_that_of_the_bench) {
  if (!test_data_dir()) SKIP("no measured data");
  const battery_param_t p = legacy();
  char path[600];
  why_t why;
  csv_file_t *file;
  snprintf(path, sizeof path, "%s/thrust_stand/bitcraze2015_cf20.csv", test_data_dir());
  if (!CHECK_OK(csv_open(&file, path, &why))) return;
  const int amps = csv_find(file, "amps_A"), grams = csv_find(file, "thrust_g_total");
  const int volts = csv_find(file, "supply_V");
  bool more = true;
  int rows = 0;
  while (CHECK_OK(csv_next(file, &more, &why)) && more) {
    double A = 0.0, g = 0.0, V = 0.0;
    CHECK_OK(csv_number(file, amps, CSV_GAP_REFUSED, &A, &why));
    CHECK_OK(csv_number(file, grams, CSV_GAP_REFUSED, &g, &why));
    CHECK_OK(csv_number(file, volts, CSV_GAP_REFUSED, &V, &why));
    ROW("%g g", g);
    const double f = g * 9.81e-3 / 4.0, each_N[ROTORS] = {f, f, f, f};
    CHECK_NEAR(battery_current_A(&p, each_N, NULL, ROTORS), A, 0.05);
    CHECK_NEAR(4.035 - p.resistance_ohm * A, V,
               0.04); // the charge of that run is not known: its own constant
    rows++;
  }
  CHECK(rows == 16);
  csv_close(file);
}

TEST(battery_sags_in_flight_and_the_same_pwm_gives_less) {
  model_t m;
  why_t why;
  if (!CHECK_OK(model_builtin("cf21_legacy", &m, &why))) return;
  const body_start_t start = {.pos_w_m = {0.0, 0.0, body_rest_z_m(&m)}};
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  // As many as keep it on the ground: 0.9 of what hovers at full voltage.
  const double pwm[ROTORS] = {34000, 34000, 34000, 34000};
  for (int i = 0; i < 500; i++) vehicle6_tick_pwm(&b, pwm, TICK_S);
  const double early_N = b.y[RIGID_THRUST_N], early_V = b.vbat_V;
  CHECK(early_V < 4.0 && early_V > 3.7);
  for (int i = 0; i < 60000; i++) vehicle6_tick_pwm(&b, pwm, TICK_S);
  // 121 s at about 1.9 A of 900 As
  CHECK_NEAR(b.charge, 1.0 - 121.0 * b.current_A / 900.0, 0.02);
  CHECK(b.vbat_V < early_V - 0.1);
  CHECK(b.y[RIGID_THRUST_N] < 0.95 * early_N);
  CHECK(b.on_floor && b.floor_contacts == 0 && !b.broken);
  body_close(&b);
}
