// closed_loop.c - reads off a log how it was flown and measured.
#include "gap/3_feedback/nominal_pilot.h"

#include "base/lsq_blocks.h"
#include "base/nth.h"
#include "gap/2_predict/color.h"
#include "gap/3_feedback/stirs.h"
#include <math.h>
#include <stdlib.h>

#define TILT_MOST  0.35 // largest tilt gain over the square of the rate gain: more overshoots
#define LEAD_MOST  0.5 // largest lead: acts as so much more inertia; beyond it lag and delay make a loop ring
#define TILT_LEAST 0.1 // least of the same, up to SWIFT_GAIN: with less it does not hold its place
#define SWIFTER    2.0 // a pilot rings from a gain on, and falls over from more than twice as much
// Share of what commands change by. A pilot that answers rate and tilt alone has 0.75 to 0.98 where noise of
// each motor turns the vehicle (PyFlyt's PID; the Crazyflie's in recorded flights: 0.8). That is the log in
// which control's answer looks most like a flat thrust curve, and gains that were cut to what does not ring
// made a third of it: with nothing hidden, thrust_slope was named. The Crazyflie's INDI, which answers
// accelerations too, has 0.7 at most, and four times its gain is read.
#define BELIEVED 0.75
// Where rows are fewer than commands, no single time shift of the logged commands fits both those that turn
// the vehicle and those that are held between two looks at place and speed, and in a manoeuvre too small a
// gain is found (swiftness.c). Then every odd pilot is at least as swift as the Crazyflie's INDI (24 1/s,
// crazyflie/stock_indi.c) and looks at place and speed as seldom. It keeps the lead that was read with the
// smaller gain. Pilots 3, 7, .. are as swift as the motors allow: on a simulator's motors without lag a PID
// has 170 1/s. Its commands decay from row to row, and rows in step with its outer loop all hold the peak,
// which looks like an inertia larger by half. These pilots steer the attitude as slowly as the others: with
// the square of their gain they would follow the noise of the track. Pilots 1, 5, .. have their lead on the
// rate error, as a PID may: each look kicks, a log in step with the looks has every kick or none, and what it
// misses is proportional to the speed, as flapping is (in four of 32 sets of somebody else's Crazyflie with
// nothing hidden, a flapping was named). gap_every_other_nominal_pilot_is_swift_where_rows_miss_commands
// holds all of it.
#define SWIFT_GAIN 25.0 // 1/s: angular acceleration per rate
#define OUTER_S    0.01 // s, period of its position loop

#define STANDS_S     60.0 // s: as long as a nominal flight. What correlates for longer, stands in it
#define TURN_LEAST_S 0.05 // s: rows, filtered at 8 Hz, do not tell shorter times apart

static double clamp(double v, double lo, double hi) {
  return v >= lo ? fmin(v, hi) : lo; // NaN: lo
}

// Third differences of samples, as noise has them.
static double third(const double *v, int i) {
  return v[i] - 3.0 * v[i - 1] + 3.0 * v[i - 2] - v[i - 3];
}

// Returns the sd of white noise on a smooth signal, from the median third difference, so that jumps do not
// count.
static double noise_of(const grid_t *g, const double *v) {
  if (!v || g->samples < 16) return 0.0;
  double *const d = malloc((size_t)g->samples * sizeof(double));
  int n = 0;
  for (int i = g->from + 3; d && i < g->from + g->samples; i++) {
    const double x = fabs(third(v, i));
    if (isfinite(x)) d[n++] = x;
  }
  const double sd = n ? nth_smallest(d, n, n / 2) / NTH_NORMAL_MEDIAN / sqrt(20.0) : 0.0;
  free(d);
  return sd;
}

// Correlation of third differences with the next ones: of white noise -0.75, of motion up to 1. Above nine
// tenths of it something else is in them. Logs of three simulators have -0.70 to -0.80, or 0.68 to 1 where
// they are free of noise.
#define ALTERNATES (-0.9 * 0.75)
#define JUMPS      (4.0 * sqrt(20.0)) // times the sd: a third difference beyond is no noise

// True if a signal's third differences, but for jumps, are those of white noise.
static bool is_noise(const grid_t *g, const double *v) {
  const double most = JUMPS * noise_of(g, v);
  double squares = 0.0, next = 0.0;
  for (int i = g->from + 4; i < g->from + g->samples; i++) {
    const double d = third(v, i), before = third(v, i - 1);
    if (fabs(d) < most && fabs(before) < most) squares += d * d, next += d * before;
  }
  return next < ALTERNATES * squares;
}

// Returns the slope of a command's third differences on those of what is seen, at this sample or one of the
// two before: whichever is the most negative. Other noise of the command does not count, nor do jumps.
static double answer_to(const grid_t *g, const double *command, const double *seen) {
  const double most_c = JUMPS * noise_of(g, command), most_x = JUMPS * noise_of(g, seen);
  double least = 0.0;
  for (int late = 0; late < 3; late++) {
    double products = 0.0, squares = 0.0;
    for (int i = g->from + 3 + late; i < g->from + g->samples; i++) {
      const double c = third(command, i), x = third(seen, i - late);
      if (fabs(c) < most_c && fabs(x) < most_x) products += c * x, squares += x * x;
    }
    if (squares > 0.0) least = fmin(least, products / squares);
  }
  return least;
}

static void noise3(const set_t *s, int signal, double sd[3]) {
  for (int i = 0; i < 3; i++) sd[i] = noise_of(&s->grid[0], s->grid[0].flight->v[signal + i]);
}

static double larger_noise(const set_t *s, int a, int b) {
  double *const *const v = s->grid[0].flight->v;
  return fmax(noise_of(&s->grid[0], v[a]), noise_of(&s->grid[0], v[b]));
}

// --- gains: least squares of the increments of a command on those of its inputs ---------------------------

typedef struct {
  double aa, ab, bb, ac, bc, cc;
} two_t;

static void two_add(two_t *t, double a, double b, double c) {
  t->aa += a * a;
  t->ab += a * b;
  t->bb += b * b;
  t->ac += a * c;
  t->bc += b * c;
  t->cc += c * c;
}

// Solves c = -x a - y b; NaN where a and b are collinear.
static void two_solve(const two_t *t, double *x, double *y) {
  const double det = t->aa * t->bb - t->ab * t->ab;
  const bool good = det > 1e-9 * t->aa * t->bb;
  *x = good ? -(t->ac * t->bb - t->bc * t->ab) / det : (double)NAN;
  *y = good ? -(t->bc * t->aa - t->ac * t->ab) / det : (double)NAN;
}

// True if c = -x a - y b explains so much of c that the gains x and y are those that flew.
static bool explains(const two_t *t, double x, double y) {
  return -(x * t->ac + y * t->bc) > BELIEVED * t->cc;
}

static d3_t tilt_of(const grid_point_t *p) {
  const axes_t a = axes_of(p->q_wb);
  const d3_t up = axes_up_b(&a);
  return d3(up.y, -up.x, 0.0); // roll and pitch, as small angles
}

// Returns the angular acceleration (rad/s2, body) and the thrust over mass that the commands of a point ask
// for.
static d3_t turn_of(const grid_t *g, const model_t *m, int j, double *lift_mps2) {
  const frame_t *f = &m->frame;
  d3_t moment = {0.0, 0.0, 0.0};
  *lift_mps2 = 0.0;
  for (int k = 0; k < ROTORS; k++) {
    double newton = 0.0;
    for (int i = j * g->every; i < (j + 1) * g->every && i < g->samples; i++)
      newton += g->command_N[k][i] / g->every;
    *lift_mps2 += newton / m->mass_kg;
    moment = d3_add(moment, d3(f->rotor_y_m[k] * newton, -f->rotor_x_m[k] * newton,
                               -f->rotor_spin[k] * f->torque_ratio_m * newton));
  }
  return d3(moment.x / f->inertia_kgm2[0], moment.y / f->inertia_kgm2[1], moment.z / f->inertia_kgm2[2]);
}

// Returns how much a step of the command about z turns the body at once, over how much it does in the end:
// the reaction to a rotor that spins up comes long before its drag.
static double yaw_at_once(const model_t *m) {
  const frame_t *const f = &m->frame;
  const double hover_N = m->mass_kg * G_MPS2 / ROTORS, drag_Nm = f->torque_ratio_m * hover_N;
  if (!(drag_Nm > 0.0 && m->motor_tau_s > 0.0)) return 1.0;
  const double spin_s = 0.5 * f->rotor_inertia_kgm2 * sqrt(hover_N / f->kf_Ns2) / drag_Nm;
  return 1.0 + spin_s * (1.0 + pilot_motor_lead(m->motor_tau_s)) / m->motor_tau_s;
}

static void find_gains(const set_t *s, const model_t *m, closed_loop_t *w) {
  two_t roll = {0}, pitch = {0}, yaw = {0}, climb = {0};
  const grid_t *g = &s->grid[0];
  for (int j = 2; j < g->n; j++) {
    const grid_point_t *p = &g->point[j], *q = &g->point[j - 2];
    if (!p->ok || !q->ok || p->segment != q->segment || p->segment != 0) continue;
    double lift, lift_before;
    const d3_t turn = d3_sub(turn_of(g, m, j, &lift), turn_of(g, m, j - 2, &lift_before));
    const d3_t rate = d3_sub(p->rate_b_radps, q->rate_b_radps), tilt = d3_sub(tilt_of(p), tilt_of(q));
    two_add(&roll, rate.x, tilt.x, turn.x);
    two_add(&pitch, rate.y, tilt.y, turn.y);
    two_add(&yaw, rate.z, 0.0, turn.z);
    two_add(&climb, p->seen_w_mps.z - q->seen_w_mps.z, p->seen_w_m.z - q->seen_w_m.z, lift - lift_before);
  }
  double tilt[2];
  two_solve(&roll, &w->rate_gain[0], &tilt[0]);
  two_solve(&pitch, &w->rate_gain[1], &tilt[1]);
  two_solve(&climb, &w->climb_gain, &w->height_gain);
  const double most = w->rate_gain_most;
  if (!w->unread && explains(&roll, w->rate_gain[0], tilt[0]) && explains(&pitch, w->rate_gain[1], tilt[1]))
    w->rate_gain_most = clamp(fmin(w->rate_gain[0], w->rate_gain[1]), most, SWIFTER * most);
  w->swift = w->rate_gain_most / most;
  for (int i = 0; i < 2; i++) w->rate_gain[i] = clamp(w->rate_gain[i], RATE_GAIN_LEAST, w->rate_gain_most);
  const double yaw_most = w->rate_gain_most / yaw_at_once(m), turns = -yaw.ac / yaw.aa;
  w->rate_gain[2] =
      fmin(!w->unread && explains(&yaw, turns, 0.0) ? fmax(turns, YAW_GAIN) : YAW_GAIN, yaw_most);
  const double least = fmin(w->rate_gain[0], w->rate_gain[1]), slow = fmin(least, SWIFT_GAIN);
  w->tilt_gain = clamp(fmax(tilt[0], tilt[1]), TILT_LEAST * slow * slow, TILT_MOST * least * least);
  w->climb_gain = clamp(w->climb_gain, 2.0, 8.0);
  w->height_gain =
      clamp(w->height_gain, 0.1 * w->climb_gain * w->climb_gain, 0.3 * w->climb_gain * w->climb_gain);
}

// --- lead: what makes commands noisy --------------------------------------------------------------------

// At each call a pilot answers white noise n of the rates with -(P + d) n(0) + d n(1), P its rate gain and d
// its lead over its period. Third differences of rows one call apart have (70 d^2 + 70 P d + 20 P^2) times
// the variance of n, of rows two calls or more apart 20 ((P + d)^2 + d^2) times; noise_of() divides by the
// 20. Of rows that are means over N calls they have 20 P^2 + 70 / N (d^2 + P d) times that of a row's mean:
// what the lead adds at one call it takes back at the next, and only the ends of a row are left. Regressed on
// the rates' own, one call apart, they have the slope -(P + 35 / 20 d).
#define CALLS_APART 1.5 // calls per row: between one and two

static double lead_of(double noise, double gyro, double gain, double calls_a_row, bool means) {
  const double next = 80.0 / 70.0 * (means ? fmax(calls_a_row, 1.0) : 1.0);
  const double ratio = gyro > 0.0 ? noise / gyro : 0.0,
               share = means || calls_a_row < CALLS_APART ? next : 2.0;
  const double more = gain * gain + share * (ratio * ratio - gain * gain);
  return more > gain * gain ? 0.5 * (sqrt(more) - gain) : 0.0;
}

// Finds the rate leads, and the noise of the commands about x and y. No lead is read where the vehicle file
// says that the log has nearly every command and its third differences are motion: so they are in slow rows.
// In other such logs it is read off the commands' answer to the noise of the rates: a simulator's pilot may
// not have seen the noise of its log, and what its commands have is that of the motors, fed back. Without a
// lead, control made a fifth of what it made of noise under the firmware's Mellinger controller, and
// thrust_scale was named where mass was hidden.
static void find_lead(const set_t *s, const model_t *m, closed_loop_t *w) {
  const grid_t *const g = &s->grid[0];
  const double row_s = g->period_s / g->every, step_s = row_s / nominal_steps(row_s);
  const double told_Hz = w->flown_by ? w->flown_by->rate_Hz : 0.0;
  const bool told = told_Hz > 0.0 && told_Hz * row_s < CALLS_APART;
  // The period of the nominal pilot's calls: at least one step.
  const double call_s = told_Hz > 0.0 ? fmax(1.0 / told_Hz, step_s) : step_s;
  double *const turn =
      g->has_rates && g->has_moments ? malloc((size_t)(g->from + g->samples) * sizeof *turn) : NULL;
  for (int axis = 0; axis < 3 && turn; axis++) {
    for (int i = 0; i < g->samples; i++) turn[g->from + i] = grid_turns(g, m, axis, i);
    const double by_motors = 1.0 + pilot_motor_lead(m->motor_tau_s), noise = noise_of(g, turn) / by_motors;
    if (axis < 2) w->turn_noise_radps2[axis] = noise;
    if (told && !is_noise(g, turn)) continue;
    const double gain = w->rate_gain[axis];
    const double d =
        told ? (-answer_to(g, turn, g->flight->v[SIG_GX + axis]) / by_motors - gain) / (35.0 / 20.0)
             : lead_of(noise, w->gyro_radps[axis], gain, row_s / call_s, g->flight->rows_are_means);
    w->rate_lead[axis] = fmin(fmax(d, 0.0) * call_s, LEAD_MOST / (axis == 2 ? yaw_at_once(m) : 1.0));
  }
  free(turn);
}

closed_loop_t closed_loop_turning(const closed_loop_t *w, const set_t *s, const model_t *m, double gain) {
  closed_loop_t v = *w;
  for (int i = 0; i < 2; i++) v.rate_gain[i] = fmax(w->rate_gain[i], gain);
  v.tilt_gain = fmax(w->tilt_gain, TILT_MOST * gain * gain);
  find_lead(s, m, &v);
  return v;
}

// --- disturbing moments -----------------------------------------------------------------------------------

// Returns the variance that gyro noise leaves in a row of the turning, which is a filtered derivative: about
// (2 pi 5 Hz)^2 of it.
static double filtered(const grid_t *g, double sd_radps) {
  return 900.0 * sd_radps * sd_radps / g->every * fmin(1.0, 13.0 * g->period_s);
}

// Finds the disturbing moments. Their correlation time is the mean over the axes: taken axis by axis, that of
// a weak axis is the noise's, and what feedback made there of a name with too small a number was told as
// another torque_ratio. What correlates rows less than the shortest time would is, in part, new at each step,
// as the noise of each motor is. Control answers it a step later, too late to cancel it, and its commands
// look like a flat thrust curve (thrust_slope -0.6 +- 0.03 on PyFlyt's motors with noise of 2 %).
static done_t find_moments(const set_t *s, double *const r[CHANNELS], closed_loop_t *w, why_t *why) {
  const double apart_s = STIRS_SLOW / RESIDUAL_HZ, least = exp(-apart_s / TURN_LEAST_S);
  double tau_s = 0.0;
  for (int k = 0; k < 3; k++) {
    if (!residual_has(s, CH_WX + k)) continue;
    stirs_t stirs = {.share = 0.0};
    TRY(stirs_add(&stirs, s, r[CH_WX + k], why));
    const double all = stirs_all(&stirs), own = fmax(all - filtered(&s->grid[0], w->gyro_radps[k]), 0.0);
    w->turn_radps2[k] = sqrt(own);
    if (!(own > 0.0)) continue;
    const double lasting = stirs_lasting(&stirs);
    tau_s -= apart_s / log(clamp(lasting / all, least, exp(-apart_s / STANDS_S))) / 3.0;
    w->turn_quick[k] = 1.0 - clamp(lasting / own / least, 0.0, 1.0); // gyro noise is no moment
  }
  w->turn_tau_s = clamp(tau_s, TURN_LEAST_S, STANDS_S);
  return DONE;
}

// Returns the lead of pilots that kick, on the error of a heading that they are told at looks: each step of
// the heading kicks. A log in step with the looks has all kicks or none, and what is left about z is then
// proportional to the yaw rate. The lead is as large as makes that proportion, and no larger than the motors
// follow. In four of 30 sets of somebody else's Crazyflie with nothing hidden, whose lead is 0.35 of a rate
// gain of 13 1/s, a moment about z was named. With 0.35 for every log, six of the users' inertias, which
// turning about z tells, are not named.
static double nose_lead(const set_t *s, const model_t *m, const closed_loop_t *w, const double *left_radps2) {
  double squares = 0.0, products = 0.0;
  for (int i = 0; residual_has(s, CH_WZ) && i < s->smooth.n; i++) {
    const double rate_radps = s->grid[s->smooth.flight[i]].point[s->smooth.point[i]].rate_b_radps.z;
    squares += rate_radps * rate_radps;
    products += rate_radps * left_radps2[i];
  }
  const double most = w->rate_gain_most / yaw_at_once(m) / w->rate_gain[2] - 1.0;
  return squares > 0.0 ? fmin(fabs(products) / squares / w->rate_gain[2], fmax(most, 0.0)) : 0.0;
}

// Place and speed of a point are means over its samples, its attitude is that of one sample.
static void find_slow(const grid_t *g, closed_loop_t *w) {
  white_error_t white;
  for (int i = 0; i < 3; i++) {
    white.pos_m[i] = w->pos_m[i] / sqrt(g->every);
    white.vel_mps[i] = w->vel_mps[i] / sqrt(g->every);
    white.angle_rad[i] = w->angle_rad;
  }
  slow_errors(g, &white, &w->slow_pos_m, &w->slow_vel_mps, &w->slow_angle_rad);
}

// Returns the share of the log's noise that a pilot with these gains is not fed with, so that its commands
// are no noisier than the log's.
static double spared(const closed_loop_t *w) {
  double share = 1.0;
  for (int i = 0; i < 2; i++) {
    const double own_radps2 = hypot(w->rate_gain[i] * w->gyro_radps[i], w->tilt_gain * w->angle_rad);
    if (w->turn_noise_radps2[i] > 0.0) share = fmin(share, w->turn_noise_radps2[i] / own_radps2);
  }
  return 1.0 - share;
}

closed_loop_t closed_loop_varied(const closed_loop_t *w, int i) {
  closed_loop_t v = *w;
  // Golden-section steps fill both ranges evenly, each independently of the other.
  const double turn = 1.0 + NOMINAL_VARIED * (i ? 2.0 * fmod(0.618 * i, 1.0) - 1.0 : 0.0);
  const double place = 1.0 + NOMINAL_VARIED * (i ? 2.0 * fmod(0.382 * i + 0.5, 1.0) - 1.0 : 0.0);
  for (int k = 0; k < 3; k++) {
    v.rate_gain[k] *= turn;
    v.rate_lead[k] = fmin(turn * v.rate_lead[k], LEAD_MOST);
  }
  v.tilt_gain *= turn * turn;
  if (w->unread && i % 2) {
    const double swift =
        turn * (i % 4 == 3 ? fmax(SWIFT_GAIN, w->rate_gain_most / (1.0 + NOMINAL_VARIED)) : SWIFT_GAIN);
    for (int k = 0; k < 2; k++) v.rate_gain[k] = fmax(v.rate_gain[k], swift);
    v.tilt_gain = fmax(v.tilt_gain, TILT_MOST * turn * SWIFT_GAIN * swift);
    if (i % 4 == 3) {
      v.spared = spared(&v);
      v.unread = false; // it does not turn with the track, whose noise would shake it at this gain
    }
    v.outer_s = OUTER_S;
    v.kicks = i % 4 == 1;
  }
  v.climb_gain *= place;
  v.height_gain *= place * place;
  return v;
}

double closed_loop_range_m(const set_t *s, const model_t *m, const double *residual_m) {
  const color_t range = s->range.n ? color_fit(&s->range, residual_m) : (color_t){.used = false};
  const range_told_t *const told = s->grid[0].range_up ? &m->range_up : &m->range_down;
  return range.used ? range.sd : told->noise_m > 0.0 ? told->noise_m : 0.005;
}

done_t closed_loop_of(closed_loop_t *to, const set_t *s, const model_t *m, const flown_by_t *by,
                      double *const residual[CHANNELS], why_t *why) {
  closed_loop_t w = {.flown_by = by, .unread = grid_is_slow(&s->grid[0]), .swift = 1.0};
  const gap_flight_t *f = s->grid[0].flight;
  noise3(s, SIG_AX, w.acc_mps2);
  noise3(s, SIG_GX, w.gyro_radps);
  noise3(s, SIG_VX, w.vel_mps);
  noise3(s, SIG_X, w.pos_m);
  w.angle_rad = 2.0 * larger_noise(s, SIG_QX, SIG_QY);
  w.vbat_V = noise_of(&s->grid[0], f->v[SIG_VBAT]);
  find_slow(&s->grid[0], &w);
  w.rate_gain_most = fmax(RATE_GAIN_LEAST, pilot_gain_most(m->motor_tau_s, 0.0, pilot_period_s(by)));
  find_gains(s, m, &w);
  find_lead(s, m, &w);
  w.range_m = closed_loop_range_m(s, m, residual[CH_RANGE]);
  TRY(find_moments(s, residual, &w, why));
  w.nose_lead = nose_lead(s, m, &w, residual[CH_WZ]);
  *to = w;
  return DONE;
}
