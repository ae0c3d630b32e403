// test_app_vehicle.c - the app as it runs on the vehicle: shadow flight, hand-overs, what it refuses, what it
// says.
#include "app.h"
#include "firmware/units.h"
#include "rig/flying_app.h"
#include "rig/test.h"

#include <setjmp.h>
#include <string.h>

// --- who flies --------------------------------------------------------------------------------------------

TEST(app_takes_over_in_flight_without_a_bump_and_gives_back_likewise) {
  static flying_t f;
  app_start(&f);
  double low_m = 1.0, high_m = 0.0, tilt_rad = 0.0;
  for (int ms = 0; ms < 12000; ms++) {
    // The stock controller from 4 s to 8 s. It has to find its integrals first, from which this one holds it.
    if (ms == 4000) CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
    if (ms == 8000) CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 0));
    app_fly(&f, 1);
    low_m = fmin(low_m, f.rig.pos_w_m.z);
    high_m = fmax(high_m, f.rig.pos_w_m.z);
    tilt_rad = fmax(tilt_rad, rig6_tilt_rad(&f.rig));
    if (ms == 3999) {
      CHECK_NEAR(low_m, 0.3, 0.003);
      CHECK_NEAR(high_m, 0.3, 0.003);
    }
    if (ms == 7000) CHECK(app_log(&f, "indi.stock") == 1.0);
  }
  ROW("lowest %.3f m, highest %.3f m", low_m, high_m);
  CHECK(low_m > 0.18 && high_m < 0.33); // the stock one sinks by 10 cm until its integral carries: measured
  CHECK(tilt_rad < 0.05);
  CHECK_NEAR(f.rig.pos_w_m.z, 0.3, 0.005);
}

TEST(app_gives_the_stock_controller_the_heading_of_now_to_turn_by_a_rate) {
  static flying_t f;
  app_start(&f);
  f.set.yaw_rad = 1.0;
  app_fly(&f, 3000);
  CHECK_NEAR(rig6_yaw_rad(&f.rig), 1.0, 0.02);
  f.set.yaw_by_rate = true; // at no rate: this heading
  app_fly(&f, 100);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
  for (int ms = 0; ms < 3000; ms++) {
    app_fly(&f, 1);
    if (!CHECK_NEAR(rig6_yaw_rad(&f.rig), 1.0, 0.03)) break;
  }
  CHECK(app_log(&f, "indi.stock") == 1.0);
}

TEST(app_in_shadow_commands_what_the_stock_controller_does_and_computes_its_own) {
  static flying_t f;
  app_start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
  crazyflie_start(&f.vehicle);
  stock_pid_t pid;
  const stock_pid_param_t param = f.vehicle.stock.param;
  const pilot_t stock = stock_pid_pilot(&pid, &param);
  double worst_N = 0.0;
  for (int ms = 0; ms < 2000; ms++) {
    const pilot_in_t in = rig6_sense(&f.rig, &f.set);
    double motor_N[PILOT_MOTORS], stock_N[PILOT_MOTORS];
    crazyflie_ms(&f.vehicle, &in, motor_N);
    stock.step(stock.state, &in, stock_N);
    if (ms > 500) // its filtered battery voltage starts elsewhere
      for (int i = 0; i < PILOT_MOTORS; i++) worst_N = fmax(worst_N, fabs(motor_N[i] - stock_N[i]));
    rig6_step(&f.rig, motor_N);
  }
  CHECK(worst_N < 1e-4);
  CHECK_NEAR(app_log(&f, "indi.thrust"), 9.81 * f.rig.param.mass_kg, 0.05);
}

TEST(app_that_contradicts_itself_does_not_take_off) {
  static flying_t f;
  app_start(&f);
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  f.rig = rig6_at(&body, d3(0.0, 0.0, 0.0), 0.0, false);
  f.set.mode[2] = PILOT_OFF;
  for (int ms = 0; ms < 4000; ms++) {
    if (ms == 1000) f.set.mode[2] = PILOT_POSITION;
    pilot_in_t in = rig6_sense(&f.rig, &f.set);
    in.acc_b_mps2.z = -in.acc_b_mps2.z;
    double motor_N[PILOT_MOTORS];
    crazyflie_ms(&f.vehicle, &in, motor_N);
    for (int i = 0; i < PILOT_MOTORS; i++) CHECK(motor_N[i] == 0.0);
    rig6_step(&f.rig, motor_N);
  }
  CHECK(app_log(&f, "guard.notFlyable") == FLYABLE_UP);
}

TEST(app_counts_as_applied_nothing_while_the_motors_are_not_allowed_to_run) {
  static flying_t f;
  app_start(&f);
  app_fly(&f, 50);
  CHECK(app_log(&f, "indiIn.f1") > 0.05);
  f.vehicle.stop = true;
  app_fly(&f, 2 * SUPERVISED_PERIOD_MS);
  CHECK(f.vehicle.supervised.state == SUPERVISED_LOCKED);
  CHECK(app_log(&f, "indiIn.f1") == 0.0);
}

// At 2.55 V the motors give 0.34 N at most, and it weighs 0.32 N.
TEST(app_takes_the_cap_of_a_low_battery_for_what_the_motors_did) {
  static flying_t f;
  app_start(&f);
  app_fly(&f, 1000);
  f.rig.vbat_V = 2.55;
  f.set.mode[2] = PILOT_VELOCITY;
  int full = 0, lowered = 0;
  double worst_N = 0.0;
  for (int ms = 0; ms < 6000; ms++) {
    // Up and down, tilting: the cap takes as much from those that are not full.
    f.set.vel_mps = d3(0.0, 0.0, ms / 500 % 2 == 0 ? 0.8 : -0.4);
    f.set.pos_w_m = d3(ms / 700 % 2 == 0 ? 0.2 : -0.2, 0.0, 0.3);
    double motor_N[PILOT_MOTORS];
    const pilot_in_t in = rig6_sense(&f.rig, &f.set);
    bool is_full = false;
    for (int i = 0; i < PILOT_MOTORS; i++) is_full = is_full || f.vehicle.around.duty[i] == UINT16_MAX;
    float asked_N[MOTORS];
    units_applied(asked_N, &f.vehicle.control);
    double got_N[PILOT_MOTORS];
    memcpy(got_N, f.rig.command_N, sizeof got_N);
    crazyflie_ms(&f.vehicle, &in, motor_N);
    if (is_full && ms > 600) { // the firmware's filtered voltage has come down
      full++;
      for (int i = 0; i < PILOT_MOTORS; i++) {
        worst_N = fmax(worst_N, fabs((double)f.vehicle.app.in.force_N[i] - got_N[i]));
        lowered += (double)asked_N[i] > got_N[i] + 0.003;
      }
    }
    rig6_step(&f.rig, motor_N);
  }
  ROW("%d milliseconds at the limit, %d motors lowered by more than 3 mN", full, lowered);
  CHECK(full > 1000 && lowered > 1000);
  CHECK(worst_N < 1e-4); // of 0.12 N
}

TEST(app_teaches_nothing_while_the_supervisor_says_it_does_not_fly) {
  static flying_t f;
  app_start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.mode", CURVE_LIVE));
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  f.rig = rig6_at(&body, d3(0.0, 0.0, 0.0), 0.0, false);
  crazyflie_start(&f.vehicle);
  f.vehicle.stop = true;
  app_fly(&f, 3000);
  CHECK(app_log(&f, "rls.taught") == 0.0 && app_log(&f, "indiIn.noLesson") == 1.0);
}

// It looks 25 times a second.
TEST(app_hears_that_it_flies_up_to_80_ms_after_the_first_thrust) {
  int latest_ms = 0;
  for (uint32_t begin = 0; begin < SUPERVISED_PERIOD_MS; begin += 4) {
    static flying_t f;
    app_start(&f);
    rig6_param_t body = rig6_crazyflie();
    body.floor = true;
    f.rig = rig6_at(&body, d3(0.0, 0.0, 0.0), 0.0, false);
    f.rig.step = begin;
    crazyflie_start(&f.vehicle);
    int turned_ms = 0;
    do {
      app_fly(&f, 1);
      turned_ms += f.vehicle.around.duty[0] > 0;
    } while (turned_ms < 200 && app_log(&f, "indiIn.noLesson") == 1.0);
    CHECK(turned_ms <= 2 * SUPERVISED_PERIOD_MS);
    latest_ms = turned_ms > latest_ms ? turned_ms : latest_ms;
  }
  CHECK(latest_ms > SUPERVISED_PERIOD_MS / 2);
}

// The supervisor finds it on the ground, takes the set point away, and arms it: no pilot has let go.
TEST(app_stays_down_after_a_hand_over_until_the_pilot_lets_go) {
  static flying_t f;
  app_start(&f);
  rig6_param_t body = rig6_crazyflie();
  body.floor = true;
  f.rig = rig6_at(&body, d3(0.0, 0.0, 0.3), 0.0, true);
  crazyflie_start(&f.vehicle);
  app_fly(&f, 1000);
  CHECK(f.rig.pos_w_m.z > 0.2);
  for (int ms = 0; ms < 200; ms++) { // no number is felt
    pilot_in_t in = rig6_sense(&f.rig, &f.set);
    in.gyro_b_radps.x = (double)NAN;
    double motor_N[PILOT_MOTORS];
    crazyflie_ms(&f.vehicle, &in, motor_N);
    rig6_step(&f.rig, motor_N);
  }
  bool armed_anew = false;
  for (int ms = 0; ms < 12000; ms++) {
    app_fly(&f, 1);
    armed_anew = armed_anew || f.vehicle.supervised.state == SUPERVISED_PASSED;
    CHECK(f.vehicle.around.duty[0] == 0 || ms < 2000);
  }
  CHECK(armed_anew && f.vehicle.supervised.state == SUPERVISED_READY);
  for (int ms = 0; ms < 4000; ms++) { // somebody picks it up, and turns it over and back
    pilot_in_t in = rig6_sense(&f.rig, &f.set);
    if (ms < 500) in.acc_b_mps2.z = -in.acc_b_mps2.z;
    double motor_N[PILOT_MOTORS];
    crazyflie_ms(&f.vehicle, &in, motor_N);
    CHECK(f.vehicle.around.duty[0] == 0 && (ms != 450 || app_log(&f, "guard.notFlyable") != 0.0));
    rig6_step(&f.rig, motor_N);
  }
  const pilot_setpoint_t wanted = f.set;
  f.set.mode[0] = f.set.mode[1] = f.set.mode[2] = PILOT_OFF;
  app_fly(&f, 100);
  f.set = wanted;
  app_fly(&f, 3000);
  CHECK(f.rig.pos_w_m.z > 0.2);
}

// --- the task ---------------------------------------------------------------------------------------------

static jmp_buf out;
static int naps;
static void nap(void *context, uint32_t ticks) {
  (void)ticks;
  crazyflie_t *const c = context;
  if (naps == 0) c->app.flyable.not_flyable = FLYABLE_UP;
  if (naps++ == 12) longjmp(out, 1);
}

static void run_until_out(void) {
  if (setjmp(out) == 0) appMain();
}

TEST(app_says_on_the_console_what_is_missing_and_what_is_wrong) {
  static const struct {
    bool flow, multiranger;
    const char *want;
  } row[] = {{true, true, "Flow and multiranger decks are there"},
             {false, true, "MISSING: flow deck"},
             {true, false, "MISSING: multiranger deck"},
             {false, false, "MISSING: flow deck"},
             {false, false, "MISSING: multiranger deck"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    static crazyflie_t c;
    crazyflie_init(&c, NULL);
    crazyflie_start(&c);
    c.around.has_flow = row[i].flow;
    c.around.has_multiranger = row[i].multiranger;
    c.around.delay = nap;
    c.around.delay_context = &c;
    naps = 0;
    run_until_out();
    ROW("%s: %s", row[i].want, c.around.console);
    CHECK(strstr(c.around.console, row[i].want) != NULL);
    CHECK(strstr(c.around.console, "NOT FLYABLE: at rest") != NULL);
    CHECK(c.app.decks == (row[i].flow ? DECK_FLOW : 0) + (row[i].multiranger ? DECK_MULTIRANGER : 0));
  }
}

// The task rests for a tenth of a second each time; silent since the first millisecond.
static void fall_silent(void *context, uint32_t ticks) {
  (void)ticks;
  crazyflie_t *const c = context;
  CHECK_NEAR(c->around.landings, c->around.clock_ms > 600, 0);
  if (c->around.clock_ms > 600) longjmp(out, 1);
}

TEST(app_watches_the_radio_ten_times_a_second) {
  static crazyflie_t c;
  crazyflie_init(&c, NULL);
  crazyflie_start(&c);
  c.around.flying = true;
  c.around.fed_ms = 1;
  c.around.delay = fall_silent;
  c.around.delay_context = &c;
  run_until_out();
  CHECK(c.around.clock_ms == 700);
}
