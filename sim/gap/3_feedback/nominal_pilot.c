// nominal_pilot.c - the pilot that flies the nominal flights.
#include "gap/3_feedback/nominal_pilot.h"

#include "base/larger.h"
#include "body/body.h"
#include <math.h>
#include <string.h>

#define QUICK_S   0.03 // s: slower motors get commands with a lead that makes them as quick as this
#define SWIFT     1.3  // largest rate gain times lag: beyond it the cascade rings
#define TILT_MAX  0.5
#define BEND_SURE 2.0  // standard errors that are taken off the track's linear and angular acceleration
#define SPARE     0.95 // of the motors' thrust may lift; the rest turns the vehicle
#define YAW       2.0
// Share, no unit, of the thrust beside the weight that a pilot that kicks may use about z; the rest turns the
// vehicle about x and y. With all of it lift goes with the turning where yaw is weak, and no updraft is seen
// (users 45354, 45410).
#define YAW_SHARE 0.5

// Finds the points on both sides of a point, and the time between them. False: there are none, or a gap in
// time lies between.
static bool both_sides(const nominal_flight_t *f, int at, int side, const grid_point_t *end[2],
                       double *span_s) {
  const int from = at - side, to = at + side;
  if (from < f->from || to >= f->to) return false;
  for (int i = 0; i < 2; i++) end[i] = &f->g->point[i ? to : from];
  *span_s = end[1]->t_s - end[0]->t_s;
  return end[0]->segment == end[1]->segment;
}

// Returns v shortened by BEND_SURE errors, because in a hover the errors would shake the vehicle.
static d3_t beyond(d3_t v, double error) {
  return d3_scale(larger(1.0 - BEND_SURE * error / larger(d3_norm(v), 1e-9), 0.0), v);
}

// Returns the acceleration of the track, beyond its errors.
static d3_t track_acc(const nominal_flight_t *f, int at) {
  const int side = (int)larger(1.0, round(AHEAD_S / f->g->period_s));
  const grid_point_t *end[2];
  double span_s, error = 0.0;
  if (!f->g->has_velocity || !both_sides(f, at, side, end, &span_s)) return d3(0.0, 0.0, 0.0);
  for (int i = 0; i < 3; i++) error = larger(error, hypot(f->w->vel_mps[i], f->w->slow_vel_mps.sd[i]));
  return beyond(d3_scale(1.0 / span_s, d3_sub(end[1]->vel_w_mps, end[0]->vel_w_mps)),
                sqrt(2.0) * error / span_s);
}

// Returns the angular acceleration of the track where rows are fewer than commands, else 0: there the loop
// itself turns the vehicle. With the track's turning besides, less its noise or not, nominal flights of the
// example at 500 rows a second no longer show an inertia of a twentieth, which their logs show though none is
// hidden.
static d3_t track_turn(const nominal_flight_t *f, int at) {
  const grid_point_t *end[2];
  double span_s, error = 0.0;
  if (!f->w->unread || !f->g->has_rates || !both_sides(f, at, 1, end, &span_s)) return d3(0.0, 0.0, 0.0);
  for (int i = 0; i < 3; i++) error = larger(error, f->w->gyro_radps[i]);
  return beyond(d3_scale(1.0 / span_s, d3_sub(end[1]->rate_b_radps, end[0]->rate_b_radps)),
                sqrt(2.0 / f->g->every) * error / span_s);
}

// The point that was ahead is now the current one: what is known of it is kept.
void pilot_look_ahead(nominal_flight_t *f) {
  f->track = f->g->point[f->at];
  const bool known = f->at > f->from && f->bends_at == f->at;
  f->bends_mps2[0] = known ? f->bends_mps2[1] : track_acc(f, f->at);
  f->bends_radps2[0] = known ? f->bends_radps2[1] : track_turn(f, f->at);
  f->bends_at = f->at + pilot_goes_on(f);
  f->bends_mps2[1] = track_acc(f, f->bends_at);
  f->bends_radps2[1] = track_turn(f, f->bends_at);
}

bool pilot_goes_on(const nominal_flight_t *f) {
  const grid_point_t *const p = f->g->point;
  return f->at + 1 < f->to && p[f->at + 1].segment == p[f->at].segment;
}

static d3_t between(d3_t a, d3_t b, double share) {
  return d3_add(a, d3_scale(share, d3_sub(b, a)));
}

void pilot_take_track(nominal_flight_t *f, double share) {
  const grid_point_t *const a = &f->g->point[f->at], *const b = a + pilot_goes_on(f);
  f->track.pos_w_m = between(a->pos_w_m, b->pos_w_m, share);
  f->track.vel_w_mps = between(a->vel_w_mps, b->vel_w_mps, share);
  f->track.rate_b_radps = between(a->rate_b_radps, b->rate_b_radps, share);
  f->track.q_wb = dq_unit(dq_towards(a->q_wb, b->q_wb, share));
  f->bent_mps2 = between(f->bends_mps2[0], f->bends_mps2[1], share);
  f->bent_radps2 = between(f->bends_radps2[0], f->bends_radps2[1], share);
}

static d3_t wanted_acc(const nominal_flight_t *f, const grid_point_t *track, const grid_point_t *seen) {
  const d3_t off = d3_sub(track->pos_w_m, seen->pos_w_m), slip = d3_sub(track->vel_w_mps, seen->vel_w_mps);
  const closed_loop_t *w = f->w;
  const bool place = f->g->has_position;
  const double x = place ? f->level * f->push * off.x : 0.0, y = place ? f->level * f->push * off.y : 0.0;
  const d3_t feed = f->bent_mps2;
  return d3(larger(-6.0, smaller(6.0, feed.x + x + f->push * slip.x)),
            larger(-6.0, smaller(6.0, feed.y + y + f->push * slip.y)),
            larger(-5.0, smaller(5.0, feed.z + w->height_gain * off.z + w->climb_gain * slip.z)));
}

// Limits acc to what the motors can give. Height comes first, because a horizontal lag can be made up later.
static d3_t within_thrust(const nominal_flight_t *f, d3_t acc) {
  const double most = SPARE * f->m->thrust_max_N / f->lift_trim / f->m->mass_kg, level = hypot(acc.x, acc.y);
  const double z = smaller(acc.z, most), share = sqrt(larger(most * most - z * z, 0.0)) / larger(level, 1e-9);
  return share < 1.0 ? d3(share * acc.x, share * acc.y, z) : acc;
}

// load: thrust over weight.
static void hold(const nominal_flight_t *f, double load, d3_t turn_radps2, double motor_N[ROTORS]) {
  const double lift_N = f->lift_trim * load * f->m->mass_kg * G_MPS2;
  const d3_t turn = d3_add(turn_radps2, d3_scale(load, f->turn_trim_radps2));
  const double *const inertia_kgm2 = f->m->frame.inertia_kgm2;
  const double moment_Nm[] = {inertia_kgm2[0] * turn.x, inertia_kgm2[1] * turn.y, inertia_kgm2[2] * turn.z};
  model_mix(&f->m->frame, lift_N, moment_Nm, motor_N);
  for (int r = 0; r < ROTORS; r++) motor_N[r] = larger(0.0, smaller(motor_N[r], f->m->thrust_max_N / ROTORS));
}

double pilot_motor_lead(double motor_tau_s) {
  return larger(motor_tau_s / QUICK_S - 1.0, 0.0);
}

// Returns the angular acceleration as it is seen from one command to the next.
static d3_t rate_grows(nominal_flight_t *f, d3_t rate_radps, double step_s) {
  const d3_t before = f->rate_before_radps;
  f->rate_before_radps = rate_radps;
  return isfinite(before.x) ? d3_scale(1.0 / step_s, d3_sub(rate_radps, before)) : d3(0.0, 0.0, 0.0);
}

// Returns the share of the way that slow commands go per call; kept, because all calls are equally far apart.
static double quick_share(nominal_flight_t *f, double step_s) {
  if (f->call_s != step_s) f->quick = 1.0 - exp(-step_s / QUICK_S);
  f->call_s = step_s;
  return f->quick;
}

// Returns the wanted rate about z. With kicks the heading steps at each look by what the track's rates say,
// because the attitude itself also steps by its noise from sample to sample. Where the rate error has a lead,
// too, as in a cascade of two PIDs, the kick is several times as large and is taken back at the next call: on
// average it still is the turning of the nose.
static double wanted_yaw_radps(const nominal_flight_t *f, bool looks, const axes_t *axes,
                               const grid_point_t *track, double rate_radps, double step_s) {
  const closed_loop_t *const w = f->w;
  const d3_t nose_b = axes_to_body(axes, axes_of(track->q_wb).x);
  const double wanted_radps = YAW * atan2(nose_b.y, nose_b.x);
  if (!w->kicks) return wanted_radps;
  const double error_radps = w->gyro_radps[2] / sqrt(f->g->every);
  const d3_t turns_radps = beyond(d3(0.0, 0.0, f->g->has_rates ? track->rate_b_radps.z : 0.0), error_radps);
  const double stepped_rad = looks ? w->outer_s * turns_radps.z : 0.0;
  return wanted_radps + w->nose_lead * (stepped_rad / step_s - rate_radps);
}

// Limits the turning about z of a pilot that kicks to what the motors can give beside the weight, with their
// own lead.
static double within_yaw(const nominal_flight_t *f, double lead, double turn_radps2) {
  const double weight_N = f->m->mass_kg * G_MPS2, over_N = f->m->thrust_max_N - weight_N;
  const double spare_N = YAW_SHARE / (1.0 + lead) * larger(smaller(weight_N, over_N), 0.0);
  const double most_radps2 = spare_N * f->m->frame.torque_ratio_m / f->m->frame.inertia_kgm2[2];
  return larger(-most_radps2, smaller(most_radps2, turn_radps2));
}

void pilot_steer(nominal_flight_t *f, double step_s, const grid_point_t *track, const grid_point_t *seen,
                 double motor_N[ROTORS]) {
  const closed_loop_t *w = f->w;
  const axes_t axes = axes_of(seen->q_wb);
  const bool looks = f->outer_due_s < 0.5 * step_s;
  if (looks) {
    f->acc_mps2 = within_thrust(f, d3_add(wanted_acc(f, track, seen), d3(0.0, 0.0, G_MPS2)));
    f->outer_due_s += w->outer_s;
  }
  f->outer_due_s = larger(f->outer_due_s - step_s, 0.0);
  const d3_t acc = f->acc_mps2;
  const d3_t pull_b = axes_to_body(&axes, d3_scale(1.0 / d3_norm(acc), acc));
  const double roll = larger(-TILT_MAX, smaller(TILT_MAX, -pull_b.y)),
               pitch = larger(-TILT_MAX, smaller(TILT_MAX, pull_b.x));
  const d3_t rate = seen->rate_b_radps;
  const bool turns = w->unread && f->g->has_rates;
  const d3_t off = turns ? d3_sub(track->rate_b_radps, rate) : d3_scale(-1.0, rate);
  const d3_t wanted_radps = d3(w->tilt_gain / w->rate_gain[0] * roll, w->tilt_gain / w->rate_gain[1] * pitch,
                               wanted_yaw_radps(f, looks, &axes, track, rate.z, step_s));
  // The lead is on the rate that is seen, or on its error.
  const d3_t grows = rate_grows(f, w->kicks ? d3_scale(-1.0, d3_add(off, wanted_radps)) : rate, step_s);
  const d3_t steered = d3(w->tilt_gain * roll + w->rate_gain[0] * off.x - w->rate_lead[0] * grows.x,
                          w->tilt_gain * pitch + w->rate_gain[1] * off.y - w->rate_lead[1] * grows.y,
                          w->rate_gain[2] * (wanted_radps.z + off.z) - w->rate_lead[2] * grows.z);
  d3_t turn = d3_add(f->bent_radps2, steered);
  const double lead = pilot_motor_lead(f->body.rigid.motor_tau_s);
  if (w->kicks) turn.z = within_yaw(f, lead, turn.z);
  const double up = larger(axes_up_b(&axes).z, 0.5), load = acc.z / up / G_MPS2;
  const double share = quick_share(f, step_s);
  f->turn_slow_radps2 = d3_add(f->turn_slow_radps2, d3_scale(share, d3_sub(turn, f->turn_slow_radps2)));
  f->load_slow += share * (load - f->load_slow);
  hold(f, load + lead * (load - f->load_slow),
       d3_add(turn, d3_scale(lead, d3_sub(turn, f->turn_slow_radps2))), motor_N);
}

double pilot_period_s(const flown_by_t *by) {
  return by && by->rate_Hz > 0.0 ? 1.0 / by->rate_Hz : 0.0;
}

// A command that is held is late by half its period.
double pilot_gain_most(double motor_tau_s, double delay_s, double period_s) {
  const double late_s = delay_s + 0.5 * larger(period_s, NOMINAL_STEP_S);
  return SWIFT / (smaller(motor_tau_s, QUICK_S) + 3.0 * late_s);
}

void pilot_tame(nominal_flight_t *f) {
  closed_loop_t *const w = &f->own;
  const double most =
      larger(w->swift, 1.0) *
      pilot_gain_most(f->body.rigid.motor_tau_s, f->body.plant.delay_s, pilot_period_s(w->flown_by));
  for (int i = 0; i < 2; i++) w->rate_gain[i] = smaller(w->rate_gain[i], most);
  // A gain that is not read off the log is slow enough for any vehicle.
  const double slow = (1.0 + NOMINAL_VARIED) * YAW_GAIN;
  w->rate_gain[2] =
      smaller(w->rate_gain[2], larger(slow, smaller(1.0, most / w->rate_gain_most) * w->rate_gain[2]));
  const double least = smaller(w->rate_gain[0], w->rate_gain[1]);
  w->tilt_gain = smaller(w->tilt_gain, 0.25 * least * least);
  f->push = smaller(3.0, larger(0.8, 0.5 * w->tilt_gain / least));
  f->level = 0.66 * f->push;
}

// Turning and lift of the level body at rest show what the effects do to it. Repeated, because the lift
// changes the turning.
void pilot_trim(nominal_flight_t *f) {
  body_t *const b = &f->body;
  double at[RIGID_N], rates[RIGID_N];
  f->lift_trim = f->load_slow = 1.0;
  f->rate_before_radps.x = (double)NAN;
  for (int i = 0; i < 3; i++) {
    memcpy(at, b->y, sizeof at);
    at[RIGID_Q_WB] = 1.0;
    for (int k = 1; k < 4; k++) at[RIGID_Q_WB + k] = 0.0;
    for (int k = 0; k < 3; k++) at[RIGID_VEL_MPS + k] = at[RIGID_RATE_RADPS + k] = 0.0;
    hold(f, 1.0, d3(0.0, 0.0, 0.0), at + RIGID_THRUST_N);
    memcpy(b->y + RIGID_THRUST_N, at + RIGID_THRUST_N, ROTORS * sizeof(double));
    memcpy(b->command_N, at + RIGID_THRUST_N, ROTORS * sizeof(double));
    memcpy(b->rigid.command_N, at + RIGID_THRUST_N, ROTORS * sizeof(double));
    body_derivative(b, 0.0, at, rates);
    f->turn_trim_radps2 = d3_sub(f->turn_trim_radps2, d3_of(rates + RIGID_RATE_RADPS));
    f->lift_trim *= G_MPS2 / larger(G_MPS2 + rates[RIGID_VEL_MPS + 2], 0.2 * G_MPS2);
  }
}
