// test_vehicle_file.c - vehicle files and effects: what is read, and what is refused with which line.
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/effect_spec.h"
#include "vehicle/frame_file.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

#define ALL_EFFECTS "*" // at the end of what is wanted: every name of the table

// What is wanted, with these names.
static const char *with_effects(const char *want) {
  static char text[2000];
  const size_t n = strlen(want);
  snprintf(text, sizeof text, "%s", want);
  if (n == 0 || want[n - 1] != ALL_EFFECTS[0]) return text;
  text[n - 1] = 0;
  for (int i = 0; i < fx_count; i++) {
    const size_t at = strlen(text);
    snprintf(text + at, sizeof text - at, "%s%s", i ? ", " : "", fx_table[i]->name);
  }
  return text;
}

#define VEHICLE                                                                                              \
  "name = \"v\"\nmass_kg = 0.03\nrotor_radius_m = 0.02\nmotor_tau_s = 0.06\nthrust_min_N = 0\nthrust_max_N " \
  "= 0.6\n"

TEST(vehicle_file_gives_the_model) {
  const char *text =
      VEHICLE "ceiling_m = 0.5\n[thrust_map]\nkind = \"volt_cubic\"\nc = [0, 1, 2, 3]\n"
              "[[effect]]\nname = \"ceiling\"\nCa = 0.5\n[[effect]]\nname = \"ground\"\nform = \"table\"\n"
              "distance_over_radius = [0, 1]\nratio = [1.2, 1]\n";
  model_t m;
  why_t why = {""};
  CHECK_OK(model_read(scratch_file("v.toml", text, -1), &m, &why));
  CHECK_TEXT(why.text, "");
  CHECK_TEXT(m.name, "v");
  CHECK_NEAR(m.ceiling_m, 0.5, 0.0);
  CHECK(m.map.kind == THRUST_MAP_VOLT_CUBIC && m.n_fx == 2);
  CHECK_NEAR(m.fx[0].p[0], 0.5, 0.0);
  CHECK(m.fx[1].points.n == 2);
  CHECK_OK(model_read(scratch_file("v.toml", VEHICLE, -1), &m, &why));
  CHECK(isinf(m.ceiling_m) && m.map.kind == THRUST_MAP_NONE && m.n_fx == 0);
}

static const struct {
  const char *what, *text, *want;
} bad_vehicle[] = {
    {"not TOML", "name = \n", "v.toml:1:8: "},
    {"empty", "", "v.toml:1: name: missing; allowed: a text in quotes"},
    {"unknown key", VEHICLE "mass = 1\n",
     "v.toml:7: mass: unknown key; allowed: name, mass_kg, rotor_radius_m, "
     "motor_tau_s, motor_tau_down_s, lag_in, lag_square, thrust_min_N, thrust_max_N, ceiling_m, wall_y_m, "
     "floor_rise_x, "
     "floor_rise_y, thrust_map, "
     "body, rotors, battery, "
     "controller, range_up, range_down, "
     "effect"},
    {"nan", "name = \"v\"\nmass_kg = nan\n", "v.toml:2: mass_kg: nan is out of range; allowed: 0.001 to 100"},
    {"key twice", VEHICLE "mass_kg = 1\n", "v.toml:7:"},
    {"limits",
     "name = \"v\"\nmass_kg = 1\nrotor_radius_m = 1\nmotor_tau_s = 1\nthrust_min_N = 2\nthrust_max_N = 1\n",
     "v.toml:6: thrust_max_N: 1; allowed: more than thrust_min_N, 2"},
    {"map kind", VEHICLE "[thrust_map]\nkind = \"x\"\n",
     "v.toml:8: kind: unknown kind `x`; allowed: stand, volt_cubic, pwm_cubic, speed"},
    {"map numbers", VEHICLE "[thrust_map]\nkind = \"stand\"\nc = [1, 2]\n",
     "v.toml:9: c: 2 numbers; allowed: 5"},
    {"map of a speed", VEHICLE "[thrust_map]\nkind = \"speed\"\nc = [1]\n",
     "v.toml:9: c: 1 numbers; allowed: 3"},
    {"map without", VEHICLE "[thrust_map]\nkind = \"stand\"\n",
     "v.toml:7: c: missing; allowed: a list of numbers"},
    {"effect", VEHICLE "[[effect]]\nname = \"x\"\n",
     "v.toml:8: name: unknown effect `x`; allowed: " ALL_EFFECTS},
    {"form", VEHICLE "[[effect]]\nname = \"ceiling\"\nform = \"x\"\n",
     "v.toml:9: form: effect ceiling: unknown form `x`; allowed: cheeseman-bennett, exponential, "
     "inverse-square, table, square-root"},
    {"effect key", VEHICLE "[[effect]]\nname = \"ceiling\"\nCc = 1\n",
     "v.toml:9: Cc: effect ceiling, form exponential: unknown key `Cc`; allowed: form, Ca 0 to 5, Cb 0.01 "
     "to 50, each 0 to 1"},
    {"a key of the file behind an effect", VEHICLE "[[effect]]\nname = \"delay\"\nceiling_m = 2.4\n",
     "v.toml:9: ceiling_m: effect delay: unknown key `ceiling_m`; allowed: add 0 to 0.2 s (a key of the file "
     "itself stands before the first [table])"},
    {"a key of the file behind a table", VEHICLE "[rotors]\nmotor_tau_down_s = 0.1\n",
     "v.toml:8: motor_tau_down_s: unknown key; allowed: x_m, y_m, spin, torque_ratio_m, kf_Ns2, "
     "inertia_kgm2, "
     "delay_s (a key of the file itself stands before the first [table])"},
    {"effect range", VEHICLE "[[effect]]\nname = \"ceiling\"\nCa = 9\n",
     "v.toml:9: Ca: effect ceiling: Ca = 9 is out of range; allowed: 0 to 5"},
    {"points",
     VEHICLE
     "[[effect]]\nname = \"ceiling\"\nform = \"table\"\ndistance_over_radius = [1, 0]\nratio = [1, 1]\n",
     "v.toml:11: ratio: effect ceiling: point 2: distance_over_radius 0; allowed: 0 to 1000, ascending"},
    {"effect twice", VEHICLE "[[effect]]\nname = \"ceiling\"\n[[effect]]\nname = \"ceiling\"\n",
     "v.toml:10: name: effect ceiling stands twice; allowed: once"},
};

#define LIFTS(mass, thrust)                                                                                  \
  "name = \"v\"\nmass_kg = " mass "\nrotor_radius_m = 0.02\nmotor_tau_s = 0.06\nthrust_min_N = -1\n"         \
  "thrust_max_N = " thrust "\n"

TEST(vehicle_file_is_refused_where_the_thrust_is_no_match_for_the_weight) {
  static const struct {
    const char *what, *text, *want;
  } row[] = {
      {"grams", LIFTS("32.9", "0.6"),
       "v.toml:2: mass_kg: 32.9 kg weigh 323 N, and thrust_max_N, of all rotors together, is 0.6; allowed "
       "with that: 0.00122 to "
       "0.0612 kg"},
      {"millinewton", LIFTS("0.0329", "600"),
       "v.toml:2: mass_kg: 0.0329 kg weigh 0.323 N, and thrust_max_N, of all rotors together, is 600; "
       "allowed with that: 1.22 to 61.2 "
       "kg"},
      {"its weight", LIFTS("0.1", "0.981"),
       "v.toml:6: thrust_max_N: 0.981, and mass_kg weighs 0.981 N; allowed: more than that, of all rotors "
       "together (is it of one?)"},
      {"that of one rotor", LIFTS("0.37", "2.2"),
       "v.toml:6: thrust_max_N: 2.2, and mass_kg weighs 3.63 N; allowed: more than that, of all rotors "
       "together (is it of one?)"},
      {"a little more", LIFTS("0.1", "0.99"), ""},
      {"50 times", LIFTS("0.1", "49"), ""},
      {"more than that", LIFTS("0.1", "49.2"),
       "v.toml:2: mass_kg: 0.1 kg weigh 0.981 N, and thrust_max_N, of all rotors together, is 49.2; allowed "
       "with that: 0.1 to 5.02 "
       "kg"},
      {"none", LIFTS("0.1", "0"),
       "v.toml:6: thrust_max_N: 0; allowed: more than the weight, 0.981 N, of all rotors together"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    model_t m = {.mass_kg = 7.0};
    why_t why = {""};
    const done_t status = model_read(scratch_file("v.toml", row[i].text, -1), &m, &why);
    CHECK_STATUS(row[i].want[0] ? BAD_INPUT : DONE, status);
    CHECK_TEXT(scratch_short(why.text), row[i].want);
    if (status != DONE) CHECK_NEAR(m.mass_kg, 7.0, 0.0);
  }
}

TEST(vehicle_file_is_refused_with_line_and_key) {
  for (unsigned i = 0; i < sizeof bad_vehicle / sizeof *bad_vehicle; i++) {
    ROW("%s", bad_vehicle[i].what);
    model_t m = {.mass_kg = 7.0};
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, model_read(scratch_file("v.toml", bad_vehicle[i].text, -1), &m, &why));
    // The parser's own words are cut off: they are not ours to fix.
    const bool parser = bad_vehicle[i].want[strlen(bad_vehicle[i].want) - 1] == ' ' ||
                        bad_vehicle[i].want[strlen(bad_vehicle[i].want) - 1] == ':';
    char got[sizeof why.text];
    snprintf(got, sizeof got, "%.*s", parser ? (int)strlen(bad_vehicle[i].want) : (int)sizeof got - 1,
             scratch_short(why.text));
    CHECK_TEXT(got, with_effects(bad_vehicle[i].want));
    CHECK_NEAR(m.mass_kg, 7.0, 0.0);
  }
}

TEST(effect_of_a_command_line_is_read_or_refused) {
  scratch_file("curve.csv", "ratio,distance_over_radius\n1.3,0.5\n1,3\n", -1);
  char file_spec[500];
  snprintf(file_spec, sizeof file_spec, "ceiling:file=%s,form=table", scratch_path("curve.csv"));
  fx_use_t use;
  why_t why = {""};
  CHECK_OK(effect_parse(file_spec, &use, &why));
  CHECK(use.points.n == 2);
  CHECK_NEAR(use.points.ratio[0], 1.3, 0.0);
  CHECK_OK(effect_parse("ceiling:Cb=2.2,form=exponential,Ca=0.6", &use, &why));
  CHECK_NEAR(use.p[0], 0.6, 0.0);
  CHECK_NEAR(use.p[1], 2.2, 0.0);
  CHECK_TEXT(why.text, "");
  static const struct {
    const char *spec, *want;
  } row[] = {
      {"", "unknown effect ``; allowed: " ALL_EFFECTS},
      {"wing:x=1", "unknown effect `wing` (did you mean wind?); allowed: " ALL_EFFECTS},
      {"ceiling:", "effect ceiling: ``; allowed: key=value"},
      {"ceiling:Ca", "effect ceiling: `Ca`; allowed: key=value"},
      {"ceiling:Ca=", "effect ceiling: Ca: not a number: ``"},
      {"ceiling:Ca=0,5", "effect ceiling: `5`; allowed: key=value"},
      {"ceiling:Ca=x", "effect ceiling: Ca: not a number: `x`"},
      {"ceiling:Ca=nan", "effect ceiling: Ca: not a number: `nan`"},
      {"ceiling:Ca=-1", "effect ceiling: Ca = -1 is out of range; allowed: 0 to 5"},
      {"ceiling:form=linear", "effect ceiling: unknown form `linear`; allowed: cheeseman-bennett, "
                              "exponential, inverse-square, table, square-root"},
      {"ceiling:form=table", "effect ceiling, form table: no points; file=FILE.csv is needed (columns "
                             "distance_over_radius, ratio)"},
      {"ceiling:file=x.csv", "effect ceiling, form exponential: unknown key `file`; allowed: form, Ca 0 to "
                             "5, Cb 0.01 to 50, each 0 to 1"},
      {"ceiling:form=table,file=/none/x.csv", "/none/x.csv: cannot be opened: No such file or directory"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].spec);
    CHECK_STATUS(BAD_INPUT, effect_parse(row[i].spec, &use, &why));
    CHECK_TEXT(why.text, with_effects(row[i].want));
    CHECK_NEAR(use.p[0], 0.6, 0.0);
  }
}

TEST(vehicle_file_gives_body_rotors_and_battery) {
  const char *text =
      VEHICLE "[body]\ninertia_kgm2 = [1e-5, 2e-5, 3e-5]\ntop_above_rotor_m = -0.004\n"
              "[rotors]\nspin = [-1, 1, -1, 1]\ndelay_s = 0.004\n[battery]\n"
              "capacity_Ah = 0.25\nresistance_ohm = 0.2\nidle_A = 0.1\na_ApN = 5\nb_ApN2 = 10\n"
              "open_V = [3, 4.2]\n";
  model_t m;
  why_t why = {""};
  CHECK_OK(model_read(scratch_file("v.toml", text, -1), &m, &why));
  CHECK_TEXT(why.text, "");
  CHECK_NEAR(m.frame.inertia_kgm2[1], 2e-5, 0.0);
  CHECK_NEAR(m.frame.top_above_rotor_m, -0.004, 0.0);
  CHECK_NEAR(m.frame.rotor_spin[0], -1.0, 0.0);
  CHECK_NEAR(m.frame.motor_delay_s, 0.004, 0.0);
  CHECK_NEAR(m.battery.capacity_As, 900.0, 1e-9);
  CHECK(m.battery.n == 2);
  // What is not said is a Crazyflie's, scaled: 20 mm against 23.55 mm, 30 g against 32.9 g.
  CHECK_NEAR(m.frame.rotor_y_m[3], 0.03253 * 20.0 / 23.55, 1e-9);
  CHECK_OK(model_read(scratch_file("v.toml", VEHICLE, -1), &m, &why));
  CHECK_NEAR(m.frame.inertia_kgm2[2], 29.8e-6 * 30.0 / 32.9 * 400.0 / (23.55 * 23.55), 1e-12);
  CHECK(m.battery.capacity_As == 0.0);
}

TEST(vehicle_file_lacks_what_a_crazyflie_stands_in_for) {
  static const struct {
    const char *text, *want;
  } row[] = {
      {"", "[body], [rotors]"},
      {"[rotors]\ndelay_s = 0.004\n", "[body], [rotors]"},
      {"[body]\nimu_m = [0, 0, 0]\ninertia_kgm2 = [1e-5, 2e-5, 3e-5]\n",
       "body.cg_above_feet_m, body.rotor_above_feet_m, body.top_above_rotor_m, body.top_half_m, [rotors]"},
      {"[body]\ninertia_kgm2 = [1e-5, 2e-5, 3e-5]\ncg_above_feet_m = 0.05\nrotor_above_feet_m = 0.05\n"
       "top_above_rotor_m = 0\n[rotors]\nx_m = [1, -1, -1, 1]\ny_m = [-1, -1, 1, 1]\nspin = [1, -1, 1, -1]\n"
       "torque_ratio_m = 0.02\nkf_Ns2 = 1e-6\n",
       "body.top_half_m, rotors.inertia_kgm2"},
  };
  char text[900], lacks[FRAME_LACKS];
  model_t m;
  why_t why = {""};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    snprintf(text, sizeof text, VEHICLE "%s", row[i].text);
    CHECK_OK(model_read_text("v.toml", text, &m, &why));
    CHECK_TEXT(why.text, "");
    CHECK_TEXT(frame_lacks(&m, lacks), row[i].want);
  }
  CHECK_OK(model_builtin("cf21_legacy", &m, &why));
  CHECK_TEXT(frame_lacks(&m, lacks), "");
}

TEST(vehicle_file_says_how_the_rotors_follow) {
  static const struct {
    const char *text;
    bool in_speed;
    double down_over_up;
    const char *want;
  } row[] = {
      {"", true, 1.0, ""},
      {"lag_in = \"thrust\"\n", false, 1.0, ""},
      {"lag_in = \"speed\"\nmotor_tau_down_s = 0.09\n", true, 1.5, ""},
      {"lag_square = [0.0, 1.0]\n", true, 1.0, ""},
      {"lag_square = [0.0, 1.5]\n", false, 0.0,
       "v.toml:7: lag_square: allowed: two numbers from 0 to 1, up and down"},
      {"lag_square = [0.5]\n", false, 0.0,
       "v.toml:7: lag_square: allowed: two numbers from 0 to 1, up and down"},
      {"lag_in = \"thrust\"\nlag_square = [0.0, 1.0]\n", false, 0.0,
       "v.toml:8: lag_square: allowed: with lag_in = \"speed\""},
      {"lag_in = \"torque\"\n", false, 0.0,
       "v.toml:7: lag_in: unknown word `torque`; allowed: speed, thrust"},
      {"motor_tau_down_s = 0\n", false, 0.0,
       "v.toml:7: motor_tau_down_s: 0 is out of range; allowed: 0.001 to 2"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    char text[600];
    model_t m = {.lag_in_speed = false};
    why_t why = {""};
    ROW("%s", row[i].text);
    snprintf(text, sizeof text, VEHICLE "%s", row[i].text);
    const done_t status = model_read(scratch_file("v.toml", text, -1), &m, &why);
    CHECK_STATUS(row[i].want[0] ? BAD_INPUT : DONE, status);
    CHECK_TEXT(scratch_short(why.text), row[i].want);
    CHECK(m.lag_in_speed == row[i].in_speed);
    CHECK_NEAR(m.motor_down_over_up, row[i].down_over_up, 1e-12);
  }
}

TEST(vehicle_file_with_a_bad_body_is_refused) {
  static const struct {
    const char *text, *want;
  } row[] = {
      {"[body]\nlength = 1\n", "v.toml:8: length: unknown key; allowed: inertia_kgm2, cg_above_feet_m, "
                               "rotor_above_feet_m, top_above_rotor_m, top_half_m, imu_m"},
      {"[body]\ninertia_kgm2 = [1, 2]\n", "v.toml:8: inertia_kgm2: 2 numbers; allowed: 3"},
      {"[body]\ninertia_kgm2 = [0, 1, 1]\n",
       "v.toml:8: inertia_kgm2: 0 is out of range; allowed: 1e-09 to 1000"},
      {"[rotors]\nspin = [1, 0, 1, 1]\n", "v.toml:8: spin: 0; allowed: 1 and -1"},
      {"[rotors]\nspin = [1, -1, 1, 1]\n",
       "v.toml:8: spin: 3 rotors of 1; allowed: 2, else the torques of a hover turn it"},
      {"[rotors]\nspin = [1, 1, -1, -1]\n",
       "v.toml:8: spin: rotors of 1 lie on one side; allowed: opposite ones turn alike"},
      {"[rotors]\nkf_Ns2 = 0\n", "v.toml:8: kf_Ns2: 0 is out of range; allowed: 1e-12 to 1"},
      {"[battery]\ncapacity_Ah = 1\nresistance_ohm = 1\nidle_A = 0\na_ApN = 0\nb_ApN2 = 0\nopen_V = [4, 3]\n",
       "v.toml:13: open_V: 3; allowed: 0 to 100, not falling"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    char text[600];
    snprintf(text, sizeof text, "%s%s", VEHICLE, row[i].text);
    model_t m = {.mass_kg = 7.0};
    why_t why = {""};
    const char *path = scratch_file("v.toml", text, -1);
    CHECK_STATUS(BAD_INPUT, model_read(path, &m, &why));
    CHECK_TEXT(strstr(why.text, "v.toml"), row[i].want);
    CHECK_NEAR(m.mass_kg, 7.0, 0.0);
  }
}

TEST(vehicle_file_takes_arms_that_are_not_all_alike) {
  static const char *const text[] = {
      "[rotors]\nx_m = [0.04, -0.03, -0.03, 0.04]\ny_m = [-0.03, -0.03, 0.04, 0.04]\n",
      "[rotors]\nx_m = [0.04, 0, -0.04, 0]\ny_m = [0, -0.04, 0, 0.04]\n",
      "[rotors]\nx_m = [0.06, -0.03, -0.03, 0.03]\n"};
  for (unsigned i = 0; i < sizeof text / sizeof *text; i++) {
    char all[600];
    model_t m;
    why_t why = {""};
    ROW("%s", text[i]);
    snprintf(all, sizeof all, VEHICLE "%s", text[i]);
    CHECK_OK(model_read(scratch_file("v.toml", all, -1), &m, &why));
    CHECK_TEXT(why.text, "");
  }
}

// What a drag of 1/s per mass, a wind of m/s2 and an offset of a tenth of the arm are in newton and metres
// grows with the vehicle.
TEST(vehicle_file_takes_effects_of_vehicles_of_every_size) {
  static const struct {
    const char *what;
    double mass_kg, radius_m, hover_radps;
  } row[] = {{"20 g", 0.02, 0.02, 2500.0}, {"700 g", 0.7, 0.12, 550.0}, {"5 kg", 5.0, 0.2, 300.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const double kg = row[i].mass_kg, sum_radps = 4.0 * row[i].hover_radps, R = row[i].radius_m;
    char text[1200];
    snprintf(text, sizeof text,
             "name = \"v\"\nmass_kg = %g\nrotor_radius_m = %g\nmotor_tau_s = 0.05\nthrust_min_N = 0\n"
             "thrust_max_N = %g\n[[effect]]\nname = \"rotor_drag\"\nk = %g\n[[effect]]\nname = "
             "\"climb_inflow\"\nk = %g\n[[effect]]\nname = \"flapping\"\nk = %g\n[[effect]]\nname = "
             "\"body_drag\"\nc = %g\n[[effect]]\nname = \"translational_lift\"\nk = %g\n[[effect]]\nname = "
             "\"cg_offset\"\ndx = %g\n[[effect]]\nname = \"wind\"\nfx = %g\n",
             kg, R, 2.5 * kg * 9.81, 0.9 * kg / sum_radps, 1.2 * kg / sum_radps, 0.1 * kg * R / sum_radps,
             0.24 * kg, 0.35 * kg, 0.3 * R, 0.4 * kg);
    model_t m;
    why_t why = {""};
    CHECK_OK(model_read_text("v.toml", text, &m, &why));
    CHECK_TEXT(why.text, "");
    CHECK(m.n_fx == 7);
  }
}

TEST(vehicle_files_of_the_tree_are_good) {
  CHECK(vehicle_count >= 6);
  for (int i = 0; i < vehicle_count; i++) {
    ROW("%s", vehicle_table[i].name);
    model_t m;
    why_t why = {""};
    CHECK_OK(model_builtin(vehicle_table[i].name, &m, &why));
    CHECK_TEXT(why.text, "");
  }
}
