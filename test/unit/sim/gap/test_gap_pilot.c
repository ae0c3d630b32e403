// test_gap_pilot.c - what a log says of who flew it (3_feedback/nominal.h).
#include "base/constants.h"
#include "base/random.h"
#include "gap/2_predict/lines.h"
#include "gap/3_feedback/nominal_pilot.h"
#include "rig/gap_track.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

// Every `every`-th row of a flight.
static void thin(gap_flight_t *f, int every) {
  const int n = f->n / every;
  for (int i = 0; i < n; i++) {
    f->t_s[i] = f->t_s[every * i];
    for (int k = 0; k < SIG_COUNT; k++)
      if (f->v[k]) f->v[k][i] = f->v[k][every * i];
    if (f->segment) f->segment[i] = f->segment[every * i];
    if (f->saturated) f->saturated[i] = f->saturated[every * i];
  }
  f->n = n;
  f->rate_Hz /= every;
}

static void hold_motors(gap_track_t *t) {
  for (int f = 0; f < 2; f++)
    for (int k = 0; k < 4 * t->flight[f].n; k++) t->flight[f].v[SIG_M1 + k % 4][k / 4] = 0.08;
}

// A vehicle with less falls over, one with more is not followed by its motors.
TEST(gap_takes_a_pilots_gain_to_be_one_that_can_fly) {
  static const struct {
    const char *what;
    gap_track_job_t job;
    double read; // 1/s
  } row[] = {{"commands that do not ask for rates", {.spoil = hold_motors}, 8.0},
             {"the flight code's, in a hover", {.indi = true, .hover = true}, 39.39}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_track_t r;
    why_t why = {""};
    ROW("%s", row[i].what);
    if (!CHECK_OK(gap_track_make(&r, &row[i].job, &why))) return;
    CHECK_NEAR(r.loop.rate_gain[0], row[i].read, 0.01);
    gap_track_free(&r);
  }
}

// 1.3 over lag and three half periods; a lag of more than 0.03 s is made up for by a lead.
TEST(gap_lets_a_pilot_be_as_swift_as_its_motors_and_its_commands_allow) {
  static const struct {
    const char *what;
    double motor_tau_s, delay_s, period_s, most; // 1/s
  } row[] = {{"a Crazyflie's motors", 0.08, 0.0, 0.002, 39.39},
             {"no lag", 0.0, 0.0, 0.002, 433.33},
             {"no lag, and commands ten times as seldom", 0.0, 0.0, 0.02, 43.33},
             {"more often than a nominal flight has steps", 0.0, 0.0, 0.0, 433.33},
             {"a lag of 10 ms, and 10 ms of delay", 0.01, 0.01, 0.002, 30.23}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_NEAR(pilot_gain_most(row[i].motor_tau_s, row[i].delay_s, row[i].period_s), row[i].most, 0.01);
  }
}

// With these motors and this vehicle a pilot rings from 39.39 1/s on.
TEST(gap_tames_a_pilot_to_what_its_vehicle_bears) {
  static const struct {
    const char *what;
    double swift, delay_s, gain, yaw, tamed, tamed_yaw; // gains in 1/s
  } row[] = {{"one that does not ring", 1.0, 0.0, 20.0, 5.0, 20.0, 5.0},
             {"a swift one is cut", 1.0, 0.0, 100.0, 5.0, 39.39, 5.0},
             {"one as swift as the log's is not", 1.4, 0.0, 55.0, 40.0, 55.0, 40.0},
             {"but to that", 1.4, 0.0, 100.0, 40.0, 55.15, 40.0},
             {"by a vehicle that is slower, about z too", 1.4, 0.02, 55.0, 40.0, 19.57, 14.19}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    nominal_flight_t f = {.own = {.rate_gain = {row[i].gain, row[i].gain, row[i].yaw},
                                  .rate_gain_most = 39.39 * row[i].swift,
                                  .swift = row[i].swift,
                                  .tilt_gain = 60.0}};
    f.w = &f.own;
    f.body.rigid.motor_tau_s = 0.03;
    f.body.plant.delay_s = row[i].delay_s;
    pilot_tame(&f);
    for (int k = 0; k < 2; k++) CHECK_NEAR(f.own.rate_gain[k], row[i].tamed, 0.01);
    CHECK_NEAR(f.own.rate_gain[2], row[i].tamed_yaw, 0.01);
  }
}

// The flight code turns it with 24 1/s, and a third more or less is found. What a hovering vehicle turns is
// its pilot's doing; in a manoeuvre the one that is tried follows some of it, and less is found.
TEST(gap_finds_a_pilots_gain_by_how_much_the_vehicle_turns) {
  static const struct {
    const char *what;
    bool hover, unread;
    double read, least, most; // 1/s
  } row[] = {{"a hover", true, false, 8.0, 16.0, 32.0},
             {"manoeuvres", false, false, 8.0, 12.0, 26.0},
             {"where the vehicle turns with its track besides", true, true, 8.0, 16.0, 32.0},
             {"more than is found was read", true, false, 38.0, 38.0, 38.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_track_t r;
    why_t why = {""};
    ROW("%s", row[i].what);
    if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){true, row[i].hover, NULL}, &why))) return;
    for (int k = 0; k < 2; k++) r.loop.rate_gain[k] = row[i].read;
    r.loop.tilt_gain = 0.1 * row[i].read * row[i].read;
    r.loop.unread = row[i].unread;
    if (!CHECK_OK(closed_loop_match(&r.loop, &r.set, &r.vehicle, 9, &why))) return;
    for (int k = 0; k < 2; k++)
      CHECK(r.loop.rate_gain[k] >= row[i].least && r.loop.rate_gain[k] <= row[i].most);
    gap_track_free(&r);
  }
}

// A look at place and speed 10 ms after the first finds the vehicle 0.5 m/s aside: by the error of its rate,
// a pilot commands once what the wanted rate has grown by, and from then on as the other one does.
TEST(gap_a_pilot_kicks_at_a_look_where_its_lead_is_on_the_error) {
  double turn[2][8] = {{0.0}};
  gap_track_t r;
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.hover = true}, &why))) return;
  for (int kicks = 0; kicks < 2; kicks++) {
    closed_loop_t w = {.rate_gain = {25.0, 25.0, 5.0},
                       .rate_lead = {0.1},
                       .tilt_gain = 200.0,
                       .outer_s = 0.01,
                       .kicks = kicks};
    nominal_flight_t f = {.g = r.set.grid, .m = &r.vehicle, .w = &w, .lift_trim = 1.0, .load_slow = 1.0};
    grid_point_t track = {.q_wb = {1.0, 0.0, 0.0, 0.0}}, seen = track;
    f.push = 2.0;
    f.rate_before_radps.x = (double)NAN;
    for (int i = 0; i < 8; i++) {
      double motor_N[ROTORS];
      seen.vel_w_mps.y = i > 0 ? -0.5 : 0.0;
      pilot_steer(&f, 0.002, &track, &seen, motor_N);
      for (int k = 0; k < ROTORS; k++) turn[kicks][i] += r.vehicle.frame.rotor_y_m[k] * motor_N[k];
      turn[kicks][i] /= r.vehicle.frame.inertia_kgm2[0];
    }
  }
  const double wanted = -atan(2.0 * 0.5 / 9.81) * 200.0;
  for (int i = 0; i < 8; i++) {
    ROW("call %d: %g, %g rad/s2, %g", i, turn[0][i], turn[1][i], wanted);
    CHECK_NEAR(turn[0][i], i < 5 ? 0.0 : wanted, 0.3);
    CHECK_NEAR(turn[1][i] - turn[0][i], i == 5 ? 0.1 * wanted / 25.0 / 0.002 : 0.0, 0.3);
  }
  gap_track_free(&r);
}

// What the pilot turns it by about z at each call, where its track turns at that rate, and it does not.
static void turned_along(double rate_radps, double noise_radps, bool kicks, double motor_tau_s, int n,
                         double *turn_radps2, const gap_track_t *r) {
  const closed_loop_t w = {.rate_gain = {25.0, 25.0, 5.0},
                           .tilt_gain = 200.0,
                           .outer_s = 0.01,
                           .kicks = kicks,
                           .nose_lead = 0.35,
                           .gyro_radps = {0.0, 0.0, noise_radps}};
  nominal_flight_t f = {.g = r->set.grid, .m = &r->vehicle, .w = &w, .lift_trim = 1.0, .load_slow = 1.0};
  const grid_point_t seen = {.q_wb = {1.0, 0.0, 0.0, 0.0}};
  const frame_t *const frame = &r->vehicle.frame;
  f.rate_before_radps.x = (double)NAN;
  f.body.rigid.motor_tau_s = motor_tau_s;
  for (int i = 0; i < n; i++) {
    grid_point_t track = {.q_wb = dq_turn(d3(0.0, 0.0, 0.002 * i * rate_radps)),
                          .rate_b_radps = {0.0, 0.0, rate_radps}};
    double motor_N[ROTORS];
    pilot_steer(&f, 0.002, &track, &seen, motor_N);
    turn_radps2[i] = 0.0;
    for (int k = 0; k < ROTORS; k++)
      turn_radps2[i] -= frame->rotor_spin[k] * frame->torque_ratio_m * motor_N[k] / frame->inertia_kgm2[2];
  }
}

// The log of a vehicle whose nose turns has such kicks, or has none of them.
TEST(gap_a_pilot_that_kicks_is_told_its_heading_at_looks) {
  static const struct {
    const char *what;
    double rate_radps, noise_radps;
    bool kicks;
    double kick_radps2, between_radps2; // at the look 10 ms after the first, and 2 ms later
  } row[] = {{"one that does not kick", 0.5, 0.0, false, 0.05, 0.06},
             {"one that does", 0.5, 0.0, true, 4.425, 0.06},
             {"the other way", -0.5, 0.0, true, -4.425, -0.06},
             {"a kick that would take the lift", 40.0, 0.0, true, HUGE_VAL, 4.8},
             {"the other way", -40.0, 0.0, true, -HUGE_VAL, -4.8},
             {"as much without kicks", 250.0, 0.0, false, 25.0, 30.0},
             {"turning that may be noise", 0.5, 10.0, true, 0.05, 0.06}};
  gap_track_t r;
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.hover = true}, &why))) return;
  const model_t *const m = &r.vehicle;
  const double weight_N = m->mass_kg * 9.81, over_N = m->thrust_max_N - weight_N;
  const double most_radps2 =
      0.5 * fmin(weight_N, over_N) * m->frame.torque_ratio_m / m->frame.inertia_kgm2[2];
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    double turn[7];
    ROW("%s", row[i].what);
    turned_along(row[i].rate_radps, row[i].noise_radps, row[i].kicks, 0.0, 7, turn, &r);
    const double kick_radps2 = fmax(fmin(row[i].kick_radps2, most_radps2), -most_radps2);
    CHECK_NEAR(turn[5], row[i].kicks ? kick_radps2 : row[i].kick_radps2, 1e-3 * most_radps2);
    CHECK_NEAR(turn[6], row[i].between_radps2, 1e-3 * most_radps2);
  }
  ROW("motors that get as much lead");
  double turn[7];
  turned_along(40.0, 0.0, true, 0.06, 7, turn, &r);
  for (int i = 0; i < 7; i++) CHECK(fabs(turn[i]) < 1.001 * most_radps2);
  CHECK(turn[0] > 0.9 * most_radps2); // the first kick comes before what is slow follows
  gap_track_free(&r);
}

// The swinging one is of a user's flights with 5 g more mass, whose pilot had 24 1/s.
TEST(gap_takes_a_vehicle_that_swings_for_no_sign_of_a_swift_pilot) {
  enum { N = 6 };
  const double lost = (double)NAN;
  const double gain[N] = {8.0, 10.0, 12.5, 16.0, 20.0, 25.0};
  const struct {
    const char *what;
    double off[N];
    bool believed;
    double found;
  } row[] = {
      {"between two", {-0.9, -0.6, -0.2, 0.2, 0.4, 0.5}, false, 14.142},
      {"all turn more", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, false, 8.0},
      {"none as much", {-0.9, -0.8, -0.7, -0.6, -0.5, -0.4}, false, 25.0},
      {"it swings with the least", {0.2, -0.65, -0.69, -0.49, -0.36, -0.35}, false, 25.0},
      {"it swings a little less", {-0.34, -0.65, -0.69, -0.49, -0.36, -0.35}, false, 25.0},
      {"the least is what was read", {0.2, -0.65, -0.69, -0.49, -0.36, -0.35}, true, 8.0},
      {"the least cannot be flown", {lost, -0.1, -0.2, 0.2, 0.4, 0.6}, false, 14.142},
      {"one cannot be flown", {-0.3, lost, -0.2, 0.2, 0.4, 0.6}, false, 14.142},
      {"none can be flown", {lost, lost, lost, lost, lost, lost}, false, 0.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    turned_t turned[N];
    ROW("%s", row[i].what);
    for (int k = 0; k < N; k++) turned[k] = (turned_t){gain[k], row[i].off[k]};
    CHECK_NEAR(closed_loop_gain(turned, N, row[i].believed), row[i].found, 0.01);
  }
}

// The pilot that is read off a log which this one flew, if the file says that the vehicle is m.
static done_t pilot_read(closed_loop_t *read, const gap_track_t *r, const model_t *m,
                         const closed_loop_t *flown_by, int every, double told_Hz, why_t *why) {
  const flown_by_t by = {.rate_Hz = told_Hz};
  gap_flight_t flight;
  set_t set;
  lines_t left;
  TRY(nominal_fly(&r->set.grid[0], &r->vehicle, flown_by, 5, &flight, NULL, why));
  thin(&flight, every);
  TRY(nominal_set(&set, &(gap_flights_t){&flight, 1}, false, m, why));
  TRY(lines_make(&left, &set, why));
  TRY(residual_of(&set, m, left.r, why));
  TRY(closed_loop_of(read, &set, m, told_Hz > 0.0 ? &by : NULL, left.r, why));
  read->flown_by = NULL;
  lines_free(&left);
  set_free(&set);
  gap_flight_free(&flight);
  return DONE;
}

// Commands of a pilot with such a gain (1/s) about x and y and 20 1/s about z, who gives besides what has
// nothing to do with rates: `other` times as much.
static void command(gap_track_t *r, double gain, double other) {
  grid_t *const g = &r->set.grid[0];
  random_t *const random = random_open(3);
  const double *const inertia_kgm2 = r->vehicle.frame.inertia_kgm2;
  for (int j = 0; random && j < g->n; j++) {
    double newton[ROTORS], n[6], moment_Nm[3];
    for (int k = 0; k < 6; k++) n[k] = random_normal(random);
    g->point[j].rate_b_radps = d3(0.1 * n[0], 0.1 * n[1], 0.1 * n[2]);
    for (int k = 0; k < 3; k++)
      moment_Nm[k] = (k < 2 ? -gain : -20.0) * 0.1 * (n[k] + other * n[3 + k]) * inertia_kgm2[k];
    model_mix(&r->vehicle.frame, r->vehicle.mass_kg * G_MPS2, moment_Nm, newton);
    for (int k = 0; k < ROTORS; k++)
      for (int i = j * g->every; i < (j + 1) * g->every; i++) g->command_N[k][i] = newton[k];
  }
  random_close(random);
}

// Motors like these ring from 39 1/s on. What the Crazyflie's INDI commands has less to do with its rates,
// and four times its gain is read.
TEST(gap_believes_gains_that_explain_what_the_commands_change_by) {
  static const struct {
    const char *what;
    bool missed; // rows are fewer than commands
    double flown, other, gain, swift, yaw;
  } row[] = {{"nothing else", false, 55.0, 0.0, 55.0, 1.396, 20.0},
             {"a fifth of the squares is something else", false, 55.0, 0.5, 55.0, 1.396, 20.0},
             {"three in ten", false, 55.0, 0.65, 39.39, 1.0, 5.0},
             {"more than twice what rings", false, 120.0, 0.0, 78.79, 2.0, 20.0},
             {"not all commands are logged", true, 55.0, 0.0, 39.39, 1.0, 5.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_track_t r;
    lines_t left;
    why_t why = {""};
    ROW("%s", row[i].what);
    if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.hover = true}, &why))) return;
    r.vehicle.frame.rotor_inertia_kgm2 = 0.0;
    if (row[i].missed) r.set.grid[0].command_Hz = 1e4;
    command(&r, row[i].flown, row[i].other);
    CHECK_OK(residual_lines(&r.set, &r.vehicle, &left, &why));
    closed_loop_t read;
    CHECK_OK(closed_loop_of(&read, &r.set, &r.vehicle, NULL, left.r, &why));
    for (int k = 0; k < 2; k++) CHECK_NEAR(read.rate_gain[k], row[i].gain, 0.05 * row[i].gain);
    CHECK_NEAR(read.swift, row[i].swift, 0.07);
    CHECK_NEAR(read.rate_gain[2], row[i].yaw, 0.05 * row[i].yaw);
    CHECK_NEAR(read.tilt_gain, 62.5, 0.1); // its commands ask for no tilt: a tenth of the square of 25 1/s
    CHECK(read.rate_gain[0] <= read.rate_gain_most);
    lines_free(&left);
    gap_track_free(&r);
  }
}

TEST(gap_reads_a_pilots_lead_off_the_noise_of_its_commands) {
  static const struct {
    const char *what;
    double flown, read;
    int every;
    double told_Hz; // of its commands; 0: not told
    bool quiet;     // what it sees has no noise
  } row[] = {{"no lead", 0.0, 0.0, 1, 0.0, false},
             {"some", 0.15, 0.15, 1, 0.0, false},
             {"more", 0.3, 0.3, 1, 0.0, false},
             {"the most", 0.45, 0.45, 1, 0.0, false},
             {"more than is taken", 0.7, 0.5, 1, 0.0, false},
             {"some, every other command logged", 0.15, 0.15, 2, 0.0, false},
             {"more, every other command logged", 0.3, 0.3, 2, 0.0, false},
             {"some, of 500 commands a second", 0.15, 0.15, 2, 500.0, false},
             {"some, of more commands a second than a flight has steps", 0.15, 0.15, 1, 1000.0, false},
             {"every command logged, as is told", 0.15, 0.15, 1, 500.0, false},
             {"more, and every command logged, as is told", 0.3, 0.3, 1, 500.0, false},
             {"no lead, and every command logged", 0.0, 0.0, 1, 500.0, false},
             {"motion alone, in slow rows", 0.15, 0.0, 10, 50.0, true}};
  gap_track_t r;
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    closed_loop_t loop = r.loop, read;
    ROW("%s", row[i].what);
    for (int k = 0; k < 2; k++) loop.rate_lead[k] = row[i].flown;
    for (int k = 0; k < 3 && row[i].quiet; k++)
      loop.gyro_radps[k] = loop.pos_m[k] = loop.vel_mps[k] = loop.angle_rad = 0.0;
    if (!CHECK_OK(pilot_read(&read, &r, &r.vehicle, &loop, row[i].every, row[i].told_Hz, &why))) return;
    for (int k = 0; k < 2; k++) CHECK_NEAR(read.rate_lead[k], row[i].read, 0.1 * row[i].read + 0.01);
  }
  gap_track_free(&r);
}

// Rms of the acceleration upwards over a nominal flight, less that at rest.
static done_t shakes(double *mps2, const gap_track_t *r, const model_t *m, const closed_loop_t *loop,
                     why_t *why) {
  gap_flight_t flight;
  double squares = 0.0;
  TRY(nominal_fly(&r->set.grid[0], m, loop, 5, &flight, NULL, why));
  for (int i = 0; i < flight.n; i++) squares += pow(flight.v[SIG_AZ][i] - G_MPS2, 2.0) / flight.n;
  *mps2 = sqrt(squares);
  gap_flight_free(&flight);
  return DONE;
}

// With the most lead of roll and pitch about z, too, heavy rotors run into their limits from call to call,
// and shake the vehicle ten times as much. That was taken for noise: of a table of rotorpy with a weak rotor,
// and rotors heavier than its own in the vehicle file, an offset of the centre of mass was told, or nothing.
TEST(gap_steers_no_more_about_z_than_heavy_rotors_bear) {
  static const double times[] = {0.0, 1.0, 3.0, 10.0};
  gap_track_t r;
  why_t why = {""};
  if (!CHECK_OK(gap_track_make(&r, &(gap_track_job_t){.spoil = NULL}, &why))) return;
  closed_loop_t loop = r.loop;
  const double own_kgm2 = r.vehicle.frame.rotor_inertia_kgm2;
  r.vehicle.frame.rotor_inertia_kgm2 = 0.0;
  for (int k = 0; k < 3; k++) loop.rate_lead[k] = 0.5;
  for (unsigned i = 0; i < sizeof times / sizeof *times; i++) {
    model_t m = r.vehicle;
    closed_loop_t read;
    double with = 0.0, without = 0.0;
    ROW("%g times the inertia", times[i]);
    m.frame.rotor_inertia_kgm2 = times[i] * own_kgm2;
    if (!CHECK_OK(pilot_read(&read, &r, &m, &loop, 1, 0.0, &why))) return;
    if (!CHECK_OK(shakes(&with, &r, &m, &read, &why))) return;
    read.rate_gain[2] = read.rate_lead[2] = 0.0;
    if (!CHECK_OK(shakes(&without, &r, &m, &read, &why))) return;
    CHECK(with < 1.5 * without);
  }
  gap_track_free(&r);
}
