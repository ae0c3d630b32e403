// flight.c - the whole controller.
#include "flight/flight.h"

#include "flight/bounds.h"
#include "flight/trig.h"
#include "flight/watch.h"
#include <limits.h>
#include <string.h>

// Constants: the name ends in the unit, if there is one. The comment behind gives the reason for the value,
// and the line above each group names the test that pins it.

// test: flight_feeds_the_yaw_rate_forward_in_both_modes
#define INNER_S 0.002f // watch_time runs the inner loop in every second millisecond
// test: flight_follows_a_velocity_on_any_axis
#define OUTER_S 0.01f // and the outer loop in one of ten
// test: flight_heading_runs_no_further_ahead_than_half_a_radian
#define LEAD_COS 0.88f // of 0.5 rad, by which the held heading may be ahead of the vehicle's

status_t flight_init(flight_t *f, const flight_param_t *p) {
  TRY(params_check(p)); // a set that passes can be flown
  memset(f, 0, sizeof *f);
  f->out.q_ref = (quat_t){.w = 1.0f};
  TRY(outer_init(&f->outer, p, OUTER_S));
  TRY(ground_init(&f->ground, &p->learn, &p->ground.fixed));
  f->out.outer = f->outer.out;
  f->yaw_rad = NAN;
  by_hand_init(&f->by_hand);
  height_init(&f->height);
  return flight_tune(f, p);
}

status_t flight_tune(flight_t *f, const flight_param_t *p) {
  TRY(lpf2_tune(&f->att_filter, p->att_cutoff_Hz, 1.0f / INNER_S));
  f->outer.coef.period_s = OUTER_S;
  TRY(outer_take(&f->outer, p));
  f->height_share = thrust_lag_share(OUTER_S, p->height.tau_s);
  f->att_lag_share = thrust_lag_share(INNER_S, p->motor_tau_s);
  f->att_lag_s = p->motor_tau_s + lpf2_delay_s(p->att_cutoff_Hz);
  return ST_OK;
}

static void count(flight_t *f, status_t status) {
  if (status != ST_OK && f->faults[status] < UINT_MAX) f->faults[status]++;
}

// Checks what the outer loop does not check itself; not again what the guard has found plausible.
static status_t check_in(const flight_in_t *in, bool plausible) {
  if (!plausible && (!v3_within(in->rate_b_radps, BOUND_RATE_RADPS) || !quat_plausible(in->q_wb)))
    return ST_BAD_INPUT;
  for (int i = 0; i < MOTORS; i++)
    if (!(fabsf(in->force_N[i]) <= BOUND_THRUST_N)) return ST_BAD_INPUT;
  return ST_OK;
}

// Returns cosine and sine of the heading of an attitude, a rotation about z.
static sincos_t heading(quat_t q) {
  const v3_t forward = quat_to_world(q, (v3_t){1.0f, 0.0f, 0.0f});
  const float length = sqrtf(forward.x * forward.x + forward.y * forward.y);
  if (!(length > 1e-3f)) return (sincos_t){0.0f, 1.0f};
  return (sincos_t){forward.y / length, forward.x / length};
}

static pos_setpoint_t position_wanted(const flight_in_t *in) {
  const flight_setpoint_t *sp = &in->setpoint;
  v3_t vel = sp->vel_mps;
  if (sp->vel_in_body) {
    const sincos_t h = heading(in->q_wb);
    vel.x = h.cos * sp->vel_mps.x - h.sin * sp->vel_mps.y;
    vel.y = h.sin * sp->vel_mps.x + h.cos * sp->vel_mps.y;
  }
  // If a velocity is wanted there is no position error.
  const v3_t pos = {sp->x == AXIS_POSITION ? sp->pos_w_m.x : in->pos_w_m.x,
                    sp->y == AXIS_POSITION ? sp->pos_w_m.y : in->pos_w_m.y,
                    sp->z == AXIS_POSITION ? sp->pos_w_m.z : in->pos_w_m.z};
  return (pos_setpoint_t){pos, vel, sp->acc_w_mps2};
}

static APART void fly_by_height(flight_t *f, const flight_in_t *in, outer_in_t *x) {
  const flight_param_t *p = &f->outer.param;
  const float climb_mps = x->vel_w_mps.z - f->outer.bias.vel_off_mps.z;
  height_fly(&f->height, &p->height, &p->pos, x->pos_w_m.z, climb_mps, &f->height_fly);
  // If a velocity is wanted there is no error of the height.
  if (in->setpoint.z == AXIS_POSITION) x->setpoint.pos_w_m.z -= f->height_fly.more_m;
  outer_fly_by(&f->outer, &f->height_fly);
}

// Runs the height filter. Switched off in flight, it fades out, too.
static APART void run_height(flight_t *f, const flight_in_t *in, const flight_in_t *raw) {
  const flight_param_t *p = &f->outer.param;
  const bool by = f->outer.started && (p->height.own != 0 || f->height.share > 0.0f), was = f->by_height;
  f->by_height = by;
  if (!by) {
    if (was) {
      height_init(&f->height);
      outer_fly_by_estimate(&f->outer);
    }
    return;
  }
  // After missed calls the commands meanwhile are not known.
  if (in->step - f->height_last != 10) height_lose(&f->height);
  f->height_last = in->step;
  height_in_t *const x = &f->height_in;
  x->acc_b_mps2 = in->acc_b_mps2;
  x->q_wb = quat_unit(in->q_wb);
  x->thrust_N = mixer_thrust_N(in->force_N);
  x->mass_kg = p->pos.mass_kg;
  x->z_m = in->pos_w_m.z;
  x->climb_mps = in->vel_w_mps.z - f->outer.bias.vel_off_mps.z;
  x->at = f->outer.out.at;
  x->ground_excess = f->outer.ground.excess;
  x->zc_m = f->outer.out.zc_m;
  x->ceiling_z_m = f->outer.out.ceiling_z_m;
  x->down_m = raw->down_m; // used only here
  x->bias_mps2 = f->outer.bias.bias_mps2.z;
  height_step(&f->height, &p->height, f->height_share, x);
}

// Nothing is learned from faulty inputs, least of all from a substituted acceleration.
static bool may_learn(const flight_t *f) {
  return f->guard.now == 0 && !f->guard.acc_lost && !f->in.no_lesson;
}

// Runs one learner a period. The ceiling's needs the ground's share of its sample.
static APART void run_lesson(flight_t *f, bool may) {
  const bool of_ground = f->ground.turn, known = f->outer.param.ground.mode == CURVE_OFF || f->ground.known;
  FOR_WHOM(may && of_ground, f) count(f, ground_learn(&f->ground, &f->outer.param.learn));
  FOR_WHOM(may && !of_ground && known, &f->outer) outer_learn(&f->outer);
}

static bool ground_may_learn(const flight_t *f) {
  const outer_t *const o = &f->outer;
  return may_learn(f) && o->missed == 0 && o->carrying_s >= o->param.learn_after_s && !outer_on_floor(o);
}

static outer_ground_t ground_share(const ground_t *g, const outer_t *o) {
  const float most_per_s2 = GROUND_DAMPING * o->law.kd_z_per_s / o->lag_s;
  const float pull_per_s2 = -GRAVITY_MPS2 * g->at.slope_per_m / o->out.at.ratio;
  return (outer_ground_t){.excess = f_max(g->at.ratio - 1.0f, GROUND_LEAST),
                          .pull_per_s2 = f_bound(pull_per_s2, most_per_s2),
                          .lesson_excess = g->lesson_excess};
}

// Runs the ground's curve at the last outer loop's height, for the next one.
static APART void run_ground(flight_t *f) {
  const flight_param_t *const p = &f->outer.param;
  outer_t *const o = &f->outer;
  if (p->ground.mode == CURVE_OFF || !o->started) {
    outer_lose_ground(o); // clears a flipped bit, too, which would stay for ever
    ground_rest(&f->ground);
    return;
  }
  const float zc_m = o->sample.zc_m; // filtered
  const rbf_point_t above = curve_at(&p->curve, &o->learn.rls.theta, o->ceiling.known, zc_m);
  // A jump that was removed from the height is in the ground: a table that the vehicle flies over.
  const ground_in_t x = {.height_m = o->height_last_m + f->height_off_m - p->ground_zero_m,
                         .sample = ground_may_learn(f) ? &o->sample : NULL,
                         .excess = above.ratio - 1.0f,
                         .shared = p->curve.mode == CURVE_LIVE && o->sample.known && zc_m <= p->learn.far_m};
  ground_step(&f->ground, &p->ground, &p->learn, &o->coef.filter, &x);
  o->ground = ground_share(&f->ground, o);
}

static APART void run_outer(flight_t *f, const flight_in_t *in) {
  if (in->setpoint.z == AXIS_OFF) {
    outer_rest(&f->outer);
    f->range_waits = false; // it would be old when the height is controlled again
    f->out.outer = f->outer.out;
    return;
  }
  outer_in_t *const x = &f->outer_in;
  x->pos_w_m = in->pos_w_m;
  x->vel_w_mps = in->vel_w_mps;
  x->acc_b_mps2 = in->acc_b_mps2;
  x->q_wb = in->q_wb;
  x->thrust_N = mixer_thrust_N(in->force_N);
  x->range_new = f->range_waits;
  x->range_m = f->range_m;
  x->range_age_s = f->range_age_s;
  x->setpoint = position_wanted(in);
  f->range_waits = false;
  if (f->by_height) fly_by_height(f, in, x);
  f->out.outer = *outer_step(&f->outer, x);
}

// Returns the direction of the thrust for the wanted roll and pitch about the heading's axes.
static v3_t direction_by_hand(const flight_setpoint_t *sp, sincos_t h, float tilt_max_rad) {
  const float max = tilt_max_rad;
  const sincos_t r = trig_sincos(f_clamp(sp->roll_rad, -max, max)),
                 p = trig_sincos(f_clamp(sp->pitch_rad, -max, max));
  const v3_t up = {p.sin * r.cos, -r.sin, p.cos * r.cos}; // Ry(pitch) Rx(roll) e_z
  return (v3_t){h.cos * up.x - h.sin * up.y, h.sin * up.x + h.cos * up.y, up.z};
}

// Returns the heading to hold: the one asked for, or the held one turned by the rate (first the vehicle's).
static sincos_t heading_wanted(flight_t *f, const flight_in_t *in) {
  const flight_setpoint_t *sp = &in->setpoint;
  if (sp->yaw == YAW_ANGLE) {
    if (sp->yaw_rad == f->yaw_rad) return f->heading_ref;
    f->yaw_rad = sp->yaw_rad;
    return trig_sincos(sp->yaw_rad);
  }
  f->yaw_rad = NAN;
  const sincos_t now = heading(in->q_wb), ref = f->heading_known ? f->heading_ref : now;
  const sincos_t turn = trig_sincos(INNER_S * sp->yaw_rate_radps);
  const sincos_t next = {ref.sin * turn.cos + ref.cos * turn.sin, ref.cos * turn.cos - ref.sin * turn.sin};
  // A turn back towards the vehicle is always allowed, or the heading would be stuck.
  const float lead_cos = next.cos * now.cos + next.sin * now.sin;
  const bool too_far = lead_cos < LEAD_COS && lead_cos < ref.cos * now.cos + ref.sin * now.sin;
  const sincos_t held = too_far ? ref : next;
  const float k = 1.0f / sqrtf(held.sin * held.sin + held.cos * held.cos);
  return (sincos_t){k * held.sin, k * held.cos};
}

// Returns the wanted thrust; before the outer loop has run, that of the motors.
static float thrust_wanted_N(const flight_t *f, const flight_in_t *in) {
  if (in->setpoint.z == AXIS_OFF) return in->setpoint.thrust_N;
  return f->outer.started ? f->out.outer.thrust_N : mixer_thrust_N(in->force_N);
}

// In flight the vehicle is kept upright even if no thrust is wanted. On a floor that carries it the motors
// are off: there the inner loop would tip it over.
static bool motors_off(const flight_t *f, const flight_setpoint_t *sp, float thrust_N) {
  if (thrust_N > 0.0f) return false;
  return sp->z == AXIS_OFF || outer_on_floor(&f->outer);
}

// Returns k lag of att_indi.h: the ceiling's torque that the loop does not see yet, per roll or pitch rate.
static float ceiling_Nms(const flight_t *f, float thrust_N) {
  const float slope_per_m = f->out.outer.at.slope_per_m, arm_m = f->outer.param.mixer.arm_m;
  const float all_Nms = f->outer.param.tilt_share * thrust_N * slope_per_m * arm_m * arm_m * f->att_lag_s;
  return EITHER(slope_per_m == 0.0f, 0.0f, all_Nms); // 0 most of a flight
}

static APART void run_inner(flight_t *f, const flight_in_t *in) {
  const flight_setpoint_t *sp = &in->setpoint;
  const bool by_hand = sp->x == AXIS_OFF || sp->y == AXIS_OFF;
  f->heading_ref = heading_wanted(f, in);
  f->heading_known = true;
  const float thrust_N = thrust_wanted_N(f, in);
  // After missed calls the rate's change is of a longer time.
  const float period_s = f->inner_ms > 2 ? 0.001f * (float)f->inner_ms : INNER_S;
  f->inner_ms = 0;
  if (motors_off(f, sp, thrust_N)) {
    f->out.motors = (mixer_out_t){.thrust_N = 0.0f};
    att_indi_reset(&f->att);
    f->heading_known = false; // a hand may carry and turn the vehicle
    return;
  }
  const v3_t up =
      by_hand ? direction_by_hand(sp, f->heading_ref, f->outer.param.pos.tilt_max_rad) : f->out.outer.up_w;
  att_indi_in_t *const x = &f->att_in;
  x->rate_b_radps = in->rate_b_radps;
  x->q_wb = quat_unit(in->q_wb);
  x->q_ref = att_indi_reference(up, f->heading_ref);
  x->yaw_rate_radps = sp->yaw_rate_radps;
  x->torque_b_Nm = mixer_torque(&f->outer.param.mixer, in->force_N);
  const float applied_N = mixer_thrust_N(in->force_N), held_N = f->outer.param.att.trim * applied_N;
  x->ceiling_Nms = ceiling_Nms(f, applied_N);
  x->trim_Nm = held_N * f->outer.param.mixer.arm_m;
  x->trim_yaw_Nm = held_N * f->outer.param.mixer.yaw_m;
  x->ratio = f->outer.param.tilt_share > 0.0f ? f->out.outer.at.ratio : 1.0f;
  f->out.q_ref = x->q_ref;
  const v3_t torque =
      att_indi_step(&f->att, &f->outer.param.att, &f->att_filter, f->att_lag_share, period_s, x);
  f->out.motors = mixer_mix(&f->outer.param.mixer, torque, thrust_N);
}

// Without inputs to stay upright with: all motors alike.
static void run_blind(flight_t *f, float thrust_N) {
  const float each_N = f_clamp(0.25f * thrust_N, 0.0f, f->outer.param.mixer.force_max_N);
  const float all_N[MOTORS] = {each_N, each_N, each_N, each_N};
  f->out.motors = mixer_of(&f->outer.param.mixer, all_N);
}

static void run(flight_t *f, const flight_in_t *in, const flight_in_t *raw) {
  if (ANY(in->range_new)) { // of vehicles side by side each has its own time
    f->range_waits = f->range_waits || in->range_new;
    f->range_m = EITHER(in->range_new, in->range_m, f->range_m);
    f->range_age_s = EITHER(in->range_new, in->range_age_s, f->range_age_s);
  }
  if (f->due & FLIGHT_OUTER) run_outer(f, in);
  if (f->due == FLIGHT_OUTER) return; // most often; and it costs the most
  if (f->due & FLIGHT_HEIGHT) run_height(f, in, raw);
  if (f->due & FLIGHT_LEARN) run_lesson(f, may_learn(f));
  if (f->due & FLIGHT_GROUND) run_ground(f);
  if (f->due & FLIGHT_INNER) run_inner(f, in);
}

// *to = *from but for down_m. In pieces: the compiler copies over 64 bytes by a call, at twice the cost.
static ALWAYS_INLINE void take(flight_in_t *to, const flight_in_t *from) {
  to->step = from->step;
  to->rate_b_radps = from->rate_b_radps;
  to->acc_b_mps2 = from->acc_b_mps2;
  to->pos_w_m = from->pos_w_m;
  to->vel_w_mps = from->vel_w_mps;
  to->q_wb = from->q_wb;
  memcpy(to->force_N, from->force_N, sizeof to->force_N);
  to->range_new = from->range_new;
  to->no_lesson = from->no_lesson;
  to->range_m = from->range_m;
  to->range_age_s = from->range_age_s;
  to->setpoint = from->setpoint;
}

// Repairs what would stay wrong for long after a flipped bit: what is computed from parameters alone, the
// held heading (of YAW_ANGLE; of YAW_RATE only if it is not finite, from the vehicle's), and filters.
static APART void scrub(flight_t *f) {
  count(f, flight_tune(f, &f->outer.param));
  outer_scrub(&f->outer, &f->outer_in);
  if (f_finite(f->yaw_rad))
    f->heading_ref = trig_sincos(f->yaw_rad);
  else if (!f_finite(f->heading_ref.sin + f->heading_ref.cos))
    f->heading_known = false;
  if (!att_indi_good(&f->att)) {
    att_indi_reset(&f->att);
    count(f, ST_BAD_STATE);
  }
}

const flight_out_t *flight_step(flight_t *f, const flight_in_t *raw) {
  if (!watch_time(f, raw->step)) return &f->out;
  flight_in_t *const in = &f->in;
  take(in, raw);
  watch_inputs(f, in);
  if (f->due & FLIGHT_SCRUB) scrub(f);
  if (f->guard.now & GUARD_SETPOINT) count(f, ST_BAD_SETPOINT);
  const status_t judged = check_in(in, (f->guard.now & GUARD_NOT_A_NUMBER) == 0);
  count(f, judged);
  if (judged == ST_OK)
    run(f, in, raw);
  else if (f->guard.action == GUARD_HAND_OVER)
    run_blind(f, in->setpoint.thrust_N);
  else if (f->due & FLIGHT_OUTER)
    outer_miss(&f->outer, 1);
  return &f->out;
}
