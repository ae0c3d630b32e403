// nominal_fly.c - flies the model in closed loop along a log's track.
#include "gap/3_feedback/nominal_known.h"

#include "base/larger.h"
#include "body/side_by_side.h"
#include "gap/3_feedback/gusts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LOST_M 3.0 // off its track: the vehicle is lost
// A lost vehicle is put back on the track. A known pilot is not tamed, and may end on the floor where the
// log's vehicle flew on.
#define DOWN_S  0.2 // of contact: it is down
#define UPRIGHT 0.5 // cosine of the tilt: with less it has tipped over
#define MASK_S  0.4 // after it was put back, until its motion is its own again
#define PUT_S   3.0 // if it is put back more often than this, it cannot fly there

#define ROWS_S 0.085 // s: the rows' filter passes as much white noise as a mean over this time

static double step_of(const grid_t *g) {
  const double log_s = g->period_s / g->every;
  return log_s / nominal_steps(log_s);
}

// --- errors and disturbances that last for a while --------------------------------------------------------

// Numbers are drawn from triangles, a tenth of the cost of normal ones: flight, filter and fit average over
// many of them, so only their spread counts, not their distribution.
#define LASTS 9  // numbers per step for lasting errors
#define SHAKE 10 // numbers per step for disturbances; the last is unused, because they come in pairs

static decay_t decay_of(const slow_t *slow, double step_s) {
  decay_t d;
  for (int i = 0; i < 3; i++) {
    d.keep[i] = slow->tau_s[i] > 0.0 ? exp(-step_s / slow->tau_s[i]) : 0.0;
    d.fresh[i] = slow->sd[i] * sqrt(1.0 - d.keep[i] * d.keep[i]);
  }
  return d;
}

// sd: of an acceleration; of: the mass or inertia that turns it into a force or moment.
static decay_t disturbance_of(const double sd[3], const double of[3], double tau_s, double step_s) {
  const slow_t slow = {{of[0] * sd[0], of[1] * sd[1], of[2] * sd[2]}, {tau_s, tau_s, tau_s}};
  return decay_of(&slow, step_s);
}

static void find_decays(nominal_flight_t *f, double step_s) {
  const closed_loop_t *w = f->w;
  const double m = f->m->mass_kg, mass_kg[] = {m, m, m};
  f->pos_keeps = decay_of(&w->slow_pos_m, step_s);
  f->vel_keeps = decay_of(&w->slow_vel_mps, step_s);
  f->angle_keeps = decay_of(&w->slow_angle_rad, step_s);
  f->force_keeps = disturbance_of(w->force_mps2, mass_kg, w->force_tau_s, step_s);
  f->quick_keeps = disturbance_of(w->quick_mps2, mass_kg, GUST_QUICK_S, step_s);
  double lasts[3], news[3];
  for (int k = 0; k < 3; k++) {
    lasts[k] = w->turn_radps2[k] * sqrt(1.0 - w->turn_quick[k]);
    news[k] = f->m->frame.inertia_kgm2[k] * w->turn_radps2[k] * sqrt(w->turn_quick[k] * ROWS_S / step_s);
  }
  f->turn_keeps = disturbance_of(lasts, f->m->frame.inertia_kgm2, w->turn_tau_s, step_s);
  f->new_b_Nm = d3_of(news);
}

static d3_t drifted(d3_t off, const decay_t *d, const double drawn[3]) {
  return d3(d->keep[0] * off.x + d->fresh[0] * drawn[0], d->keep[1] * off.y + d->fresh[1] * drawn[1],
            d->keep[2] * off.z + d->fresh[2] * drawn[2]);
}

static void drift(nominal_flight_t *f, const double drawn[LASTS]) {
  f->pos_off_m = drifted(f->pos_off_m, &f->pos_keeps, drawn);
  f->vel_off_mps = drifted(f->vel_off_mps, &f->vel_keeps, drawn + 3);
  f->angle_off_rad = drifted(f->angle_off_rad, &f->angle_keeps, drawn + 6);
}

// Draws nothing where there is none, so that the other numbers stay what they were.
static d3_t new_moment(nominal_flight_t *f) {
  double drawn[4]; // drawn in pairs; the last is unused
  if (!(d3_norm(f->new_b_Nm) > 0.0)) return d3(0.0, 0.0, 0.0);
  random_triangles(f->shakes, 4, drawn);
  return d3(f->new_b_Nm.x * drawn[0], f->new_b_Nm.y * drawn[1], f->new_b_Nm.z * drawn[2]);
}

// Returns the disturbance one step later. It is part of the nominal flight, not of the model.
static push_t shaken(nominal_flight_t *f, const double drawn[SHAKE]) {
  f->gust_w_N = drifted(f->gust_w_N, &f->force_keeps, drawn);
  f->disturbs_b_Nm = drifted(f->disturbs_b_Nm, &f->turn_keeps, drawn + 3);
  f->quick_w_N = drifted(f->quick_w_N, &f->quick_keeps, drawn + 6);
  return (push_t){d3_add(f->gust_w_N, f->quick_w_N), d3_add(f->disturbs_b_Nm, new_moment(f))};
}

static void shake(nominal_flight_t *f) {
  double drawn[SHAKE];
  random_triangles(f->shakes, SHAKE, drawn);
  body_shake(&f->body, shaken(f, drawn));
}

// Starts the disturbance at its full spread. False: no memory.
static bool shake_first(nominal_flight_t *f, unsigned long seed) {
  double drawn[SHAKE];
  random_close(f->shakes);
  f->shakes = random_open(seed);
  if (!f->shakes) return false;
  random_triangles(f->shakes, SHAKE, drawn);
  find_decays(f, HUGE_VAL);
  f->gust_w_N = f->quick_w_N = f->disturbs_b_Nm = d3(0.0, 0.0, 0.0);
  const push_t first = shaken(f, drawn);
  find_decays(f, step_of(f->g));
  body_shake(&f->body, first);
  body_look(&f->body, 0, f->body.y, &f->body.look);
  return true;
}

// --- sensors ----------------------------------------------------------------------------------------------

#define RANGE_DRAWN 16 // number of the range's; those of a row's other columns come before
#define SEEN        (RANGE_DRAWN + 1)

_Static_assert(SHAKE % 2 == 0 && (LASTS + SEEN) % 2 == 0, "random_triangles() draws pairs");

// Adds noise to v. The last axis takes the first number.
static d3_t noisy3(d3_t v, const double sd[3], const double drawn[3]) {
  return d3(v.x + sd[0] * drawn[2], v.y + sd[1] * drawn[1], v.z + sd[2] * drawn[0]);
}

static fx_sensed_t sensed(const nominal_flight_t *f) {
  const body_t *b = &f->body;
  const axes_t axes = axes_of(dq_of(b->y + RIGID_Q_WB));
  const double up = larger(axes_up_b(&axes).z, 0.1), z = b->y[RIGID_POS_M + 2];
  const double far_m = f->g->range_up ? f->m->ceiling_m - z - body_rotor_z_m(f->m) : z - body_rest_z_m(f->m);
  const double side = f->g->range_up ? -1.0 : 1.0;
  fx_sensed_t s = {.acc_b_mps2 = body_specific_force_b_mps2(b),
                   .range_m = far_m / up,
                   .range_rate_mps = side * b->y[RIGID_VEL_MPS + 2] / up};
  model_sense(f->m, &s);
  return s;
}

// Sets the true state and what is seen of it, field by field, as most fields are not touched.
static void look(nominal_flight_t *f, const double drawn[SEEN]) {
  const body_t *b = &f->body;
  const fx_sensed_t s = sensed(f);
  grid_point_t *const is = &f->is, *const seen = &f->seen;
  is->pos_w_m = d3_of(b->y + RIGID_POS_M);
  is->vel_w_mps = d3_of(b->y + RIGID_VEL_MPS);
  is->q_wb = dq_of(b->y + RIGID_Q_WB);
  is->rate_b_radps = d3_of(b->y + RIGID_RATE_RADPS);
  is->acc_b_mps2 = s.acc_b_mps2;
  is->range_m = s.range_m;
  is->vbat_V = b->vbat_V;
  const closed_loop_t *w = f->w;
  const double any[3] = {w->angle_rad, w->angle_rad, w->angle_rad};
  const d3_t angle = d3_scale(0.5, noisy3(f->angle_off_rad, any, drawn));
  const dq_t wrong = dq_unit((dq_t){1.0, angle.x, angle.y, angle.z});
  seen->pos_w_m = noisy3(d3_add(is->pos_w_m, f->pos_off_m), w->pos_m, drawn + 3);
  seen->vel_w_mps = noisy3(d3_add(is->vel_w_mps, f->vel_off_mps), w->vel_mps, drawn + 6);
  seen->q_wb = dq_mul(is->q_wb, wrong);
  seen->rate_b_radps = noisy3(is->rate_b_radps, w->gyro_radps, drawn + 9);
  seen->acc_b_mps2 = noisy3(is->acc_b_mps2, w->acc_mps2, drawn + 12);
  seen->range_m = is->range_m + w->range_m * drawn[RANGE_DRAWN];
  seen->vbat_V = is->vbat_V + w->vbat_V * drawn[15];
}

// --- the flight -------------------------------------------------------------------------------------------

// Returns what the pilot is fed with: what is seen, less the share of its noise that logging adds.
static grid_point_t fed_with(const nominal_flight_t *f) {
  grid_point_t fed = f->seen;
  const double share = 1.0 - f->w->spared;
  if (share >= 1.0) return fed;
  fed.pos_w_m = d3_add(f->is.pos_w_m, d3_scale(share, d3_sub(fed.pos_w_m, f->is.pos_w_m)));
  fed.vel_w_mps = d3_add(f->is.vel_w_mps, d3_scale(share, d3_sub(fed.vel_w_mps, f->is.vel_w_mps)));
  fed.rate_b_radps =
      d3_add(f->is.rate_b_radps, d3_scale(share, d3_sub(fed.rate_b_radps, f->is.rate_b_radps)));
  fed.q_wb = dq_unit(dq_towards(f->is.q_wb, fed.q_wb, share));
  return fed;
}

// motor_N: keeps the last command where no new one is due.
static void steer(nominal_flight_t *f, double step_s, double motor_N[ROTORS]) {
  const grid_point_t *const track = &f->track;
  if (f->known) {
    known_steer(f->known, step_s, track, &f->seen, motor_N);
    return;
  }
  const double period_s = larger(pilot_period_s(f->w->flown_by), step_s);
  if (f->due_s < 0.5 * step_s) {
    const grid_point_t fed = fed_with(f);
    pilot_steer(f, period_s, track, &fed, motor_N);
    f->due_s += period_s;
  }
  f->due_s -= step_s;
}

// Puts the vehicle on the track, hovering, with a fresh pilot.
static done_t start_at(nominal_flight_t *f, unsigned long seed, why_t *why) {
  const model_t *m = f->m;
  const grid_point_t *p = &f->g->point[f->at];
  body_start_t start = {.pos_w_m = p->pos_w_m, .vel_w_mps = p->vel_w_mps, .q_wb = p->q_wb, .seed = seed + 2};
  for (int k = 0; k < ROTORS; k++) start.thrust_N[k] = 0.25 * m->mass_kg * G_MPS2;
  // Motors faster than the step need a finer step.
  const done_t status = body_open(&f->body, m, INTEGRATE_RK4, model_step_s(m, NOMINAL_STEP_S), &start);
  if (status == BAD_INPUT) return error_set(why, "%s: a model that cannot be flown", m->name);
  if (status != DONE) return error_failed(why, "out of memory");
  f->body.vbat_V = p->vbat_V;
  body_effects(&f->body, 0.0);
  if (!shake_first(f, seed)) return error_failed(why, "out of memory");
  pilot_tame(f);
  pilot_trim(f);
  return DONE;
}

static done_t find_pilot(nominal_flight_t *f, why_t *why) {
  if (!f->w->flown_by || f->w->flown_by->kind <= FLOWN_BY_OTHER) return DONE;
  double drawn[LASTS + SEEN];
  random_triangles(f->random, LASTS + SEEN, drawn);
  look(f, drawn + LASTS);
  return known_open(&f->known, f, &f->seen, why);
}

static bool is_down(nominal_flight_t *f, double span_s) {
  const axes_t axes = axes_of(dq_of(f->body.y + RIGID_Q_WB));
  f->down_s += f->body.on_floor || f->body.on_ceiling ? span_s : 0.0;
  return f->down_s > DOWN_S || axes_up_b(&axes).z < UPRIGHT;
}

static done_t cannot_fly(const nominal_flight_t *f, why_t *why) {
  return error_set(why, "%s: the model cannot fly along this track", f->g->flight->name);
}

// Puts the vehicle on the track as it is now. Samples are masked for MASK_S, until its motion is its own
// again.
static done_t put(nominal_flight_t *f, double t_s, why_t *why) {
  f->down_s = f->due_s = f->outer_due_s = 0.0;
  f->masked_to_s = t_s + MASK_S;
  body_close(&f->body);
  f->body.integrate = NULL;
  free(f->known);
  f->known = NULL;
  TRY(start_at(f, f->seed + (unsigned long)f->at, why));
  return find_pilot(f, why);
}

static done_t put_back(nominal_flight_t *f, double t_s, why_t *why) {
  if (++f->puts > 2.0 + (t_s - f->g->point[f->from].t_s) / PUT_S) return cannot_fly(f, why);
  return put(f, t_s, why);
}

// True at the first point after a gap in time, where the log goes on elsewhere.
static bool goes_on(const nominal_flight_t *f) {
  return f->at > f->from && f->g->point[f->at].segment != f->g->point[f->at - 1].segment;
}

static done_t fly(nominal_flight_t *f, why_t *why) {
  const double log_s = f->g->period_s / f->g->every, step_s = step_of(f->g);
  const int inner = f->steps, per_point = f->g->every;
  double motor_N[ROTORS] = {0.0};
  for (int first = f->at = f->from; f->at < f->to; f->at++) {
    if (goes_on(f)) {
      first = f->at;
      TRY(put(f, f->g->point[first].t_s, why));
    }
    pilot_look_ahead(f);
    for (int i = 0; i < per_point; i++) {
      const double t_s = f->g->point[first].t_s + ((f->at - first) * per_point + i) * log_s;
      for (int k = 0; k < inner; k++) {
        double drawn[LASTS + SEEN];
        random_triangles(f->random, LASTS + SEEN, drawn);
        drift(f, drawn);
        f->body.vbat_V = f->g->point[f->at].vbat_V;
        for (int n = LASTS; n < LASTS + RANGE_DRAWN; n++) drawn[n] *= f->loud;
        look(f, drawn + LASTS);
        pilot_take_track(f, (i * inner + k) / (double)(per_point * inner));
        steer(f, step_s, motor_N);
        nominal_log_step(f, motor_N, k, t_s, step_s);
        shake(f);
        side_by_side_tick(&f->body, motor_N, step_s);
      }
      const d3_t off = d3_sub(d3_of(f->body.y + RIGID_POS_M), f->g->point[f->at].pos_w_m);
      const bool lost = f->body.broken || (f->g->has_position && d3_norm(off) > LOST_M);
      if (lost || (f->known && is_down(f, log_s))) TRY(put_back(f, t_s, why));
    }
  }
  gap_flight_t *const logs[] = {f->log, f->truth};
  for (int i = 0; i < (f->truth ? 2 : 1); i++) {
    logs[i]->rate_Hz = 1.0 / log_s;
    logs[i]->command_Hz = f->g->command_Hz;
  }
  return DONE;
}

static done_t take_off(nominal_flight_t *f, why_t *why) {
  f->at = f->from;
  TRY(start_at(f, f->seed, why));
  f->random = random_open(f->seed + 1);
  return f->random ? find_pilot(f, why) : error_failed(why, "out of memory");
}

// --- the track --------------------------------------------------------------------------------------------

#define STATES 17 // numbers of a point that the pilot needs

static double *state(grid_point_t *p, int i) {
  double *const all[STATES] = {&p->pos_w_m.x,      &p->pos_w_m.y,    &p->pos_w_m.z,      &p->vel_w_mps.x,
                               &p->vel_w_mps.y,    &p->vel_w_mps.z,  &p->q_wb.w,         &p->q_wb.x,
                               &p->q_wb.y,         &p->q_wb.z,       &p->rate_b_radps.x, &p->rate_b_radps.y,
                               &p->rate_b_radps.z, &p->acc_b_mps2.x, &p->acc_b_mps2.y,   &p->acc_b_mps2.z,
                               &p->vbat_V};
  return all[i];
}

// Returns number k of point `at`, which is missing between two that have it (before < 0: only `after` has
// it): on their line, or at the end of a segment the number on this side of the gap.
static double bridged(grid_point_t *point, int k, int before, int at, int after) {
  const double b = *state(&point[after], k), a = before < 0 ? b : *state(&point[before], k);
  if (before >= 0 && point[before].segment == point[after].segment)
    return a + (b - a) * (at - before) / (after - before);
  return before >= 0 && point[before].segment == point[at].segment ? a : b;
}

// Bridges samples that are missing, because none may reach the pilot. The first and the last point are good.
static void bridge(grid_point_t *point, int from, int to) {
  for (int k = 0; k < STATES; k++)
    for (int j = from, last = -1; j < to; j++) {
      if (!isfinite(*state(&point[j], k))) continue;
      for (int i = last < 0 ? from : last + 1; i < j; i++)
        *state(&point[i], k) = bridged(point, k, last, i, j);
      last = j;
    }
  for (int j = from; j < to; j++) point[j].q_wb = dq_unit(point[j].q_wb);
}

// Replaces place and speed by means over both sides, within a segment. False: no memory.
static bool smooth_track(const grid_t *g, int from, int to, grid_point_t *point) {
  const int most = (int)larger(1.0, round(AHEAD_S / g->period_s));
  grid_point_t *const was = malloc(((size_t)g->n + 1) * sizeof *was);
  if (!was) return false;
  memcpy(was, point, (size_t)g->n * sizeof *was);
  for (int j = from; j < to; j++) {
    d3_t pos = {0.0, 0.0, 0.0}, vel = {0.0, 0.0, 0.0};
    int side = 0;
    while (side < most && j - side - 1 >= from && j + side + 1 < to &&
           was[j - side - 1].segment == was[j + side + 1].segment)
      side++;
    for (int i = j - side; i <= j + side; i++) {
      pos = d3_add(pos, was[i].pos_w_m);
      vel = d3_add(vel, was[i].vel_w_mps);
    }
    point[j].pos_w_m = d3_scale(1.0 / (2 * side + 1), pos);
    point[j].vel_w_mps = d3_scale(1.0 / (2 * side + 1), vel);
  }
  free(was);
  return true;
}

// Returns the track as logged, because the pilot saw no better places and speeds; smooth for one that is
// spared noise. Null: no memory.
static grid_point_t *whole_track(const grid_t *g, int from, int to, bool smooth) {
  grid_point_t *const point = malloc(((size_t)g->n + 1) * sizeof *point);
  if (!point) return NULL;
  memcpy(point, g->point, (size_t)g->n * sizeof *point);
  for (int j = 0; j < g->n; j++) {
    point[j].pos_w_m = point[j].seen_w_m;
    point[j].vel_w_mps = point[j].seen_w_mps;
  }
  bridge(point, from, to);
  if (!smooth || smooth_track(g, from, to, point)) return point;
  free(point);
  return NULL;
}

done_t nominal_fly(const grid_t *g, const model_t *m, const closed_loop_t *w, unsigned long seed,
                   gap_flight_t *flight, gap_flight_t *truth, why_t *why) {
  nominal_flight_t f = {
      .m = m, .own = *w, .w = &f.own, .log = flight, .truth = truth, .to = g->n, .seed = seed};
  grid_t track = *g;
  *flight = (gap_flight_t){.n = 0};
  if (truth) *truth = (gap_flight_t){.n = 0};
  while (f.from < g->n && !g->point[f.from].ok) f.from++;
  while (f.to > f.from && !g->point[f.to - 1].ok) f.to--;
  if (f.to <= f.from) return error_set(why, "%s: it does not fly", g->flight->name);
  f.steps = nominal_steps(g->period_s / g->every);
  f.loud = g->flight->rows_are_means ? sqrt(f.steps) : 1.0;
  track.point = whole_track(g, f.from, f.to, w->spared > 0.0);
  f.g = &track;
  const size_t room = (size_t)(f.to - f.from + 1) * (size_t)g->every;
  const bool good = track.point && nominal_log_room(flight, &track, room) &&
                    (!truth || nominal_log_room(truth, &track, room));
  done_t status = good ? take_off(&f, why) : error_failed(why, "out of memory");
  if (status == DONE) status = fly(&f, why);
  if (f.body.integrate) body_close(&f.body);
  random_close(f.random);
  random_close(f.shakes);
  free(f.known);
  free(track.point);
  if (status != DONE) gap_flight_free(flight);
  if (status != DONE && truth) gap_flight_free(truth);
  return status;
}
