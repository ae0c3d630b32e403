// outer.c - the outer loop.
#include "flight/outer.h"

#include "flight/bounds.h"
#include <limits.h>
#include <string.h>

#define AT_REST                                                                                              \
  { .up_w = {0.0f, 0.0f, 1.0f}, .at = {.ratio = 1.0f}, .ceiling_z_m = NAN }

// Returns the time from the instant of the filtered signals until the thrust commanded now is reached.
static float lag_s(const flight_param_t *p, float quick, float period_s) {
  return lpf2_delay_s(p->cutoff_Hz) + p->motor_tau_s / quick + 0.5f * period_s;
}

void outer_fly_by(outer_t *f, const height_fly_t *by) {
  f->law = by->law;
  f->lag_s = lag_s(&f->param, by->law.quick, f->coef.period_s);
  f->gap_min_m = f->param.gap_min_m + by->more_m;
  f->less_mps = -by->more_mps;
}

void outer_fly_by_estimate(outer_t *f) {
  f->law = f->param.pos;
  f->lag_s = lag_s(&f->param, f->law.quick, f->coef.period_s);
  f->gap_min_m = f->param.gap_min_m;
  f->less_mps = 0.0f;
}

status_t outer_init(outer_t *f, const flight_param_t *p, float period_s) {
  if (!(period_s >= 0.001f && period_s <= 0.1f)) return ST_BAD_PARAM;
  TRY(params_check(p));
  sync_coef_t coef;
  TRY(sync_tune(&coef, p->cutoff_Hz, p->motor_tau_s, period_s));
  // Nothing fails from here on, as the learner can start from the weights of any checked set. *f is set in
  // place, because a second state would not fit onto the vehicle's stack.
  memset(f, 0, sizeof *f);
  f->coef = coef;
  f->param = *p;
  outer_fly_by_estimate(f);
  bias_tune(&f->bias_coef, &f->param.bias, period_s);
  f->out = (outer_out_t)AT_REST;
  ceiling_init(&f->ceiling, period_s);
  hold_init(&f->hold);
  return learn_init(&f->learn, &f->param.learn, &f->param.curve.fixed);
}

status_t outer_take(outer_t *f, const flight_param_t *p) {
  TRY(sync_tune(&f->coef, p->cutoff_Hz, p->motor_tau_s, f->coef.period_s));
  f->param = *p;
  outer_fly_by_estimate(f);
  bias_tune(&f->bias_coef, &f->param.bias, f->coef.period_s);
  f->ceiling.period_s = f->coef.period_s;
  return ST_OK;
}

static void count(outer_t *f, status_t status) {
  FOR_WHOM(status != ST_OK, &f->faults) {
    if (f->faults[status] < UINT_MAX) f->faults[status]++;
  }
}

status_t outer_tune(outer_t *f, const flight_param_t *p) {
  status_t status = params_check(p);
  if (status == ST_OK) status = outer_take(f, p);
  count(f, status);
  return status;
}

static status_t check_in(const outer_in_t *in) {
  if (!v3_within(in->pos_w_m, BOUND_POS_M) || !v3_within(in->vel_w_mps, BOUND_VEL_MPS)) return ST_BAD_INPUT;
  if (!v3_within(in->acc_b_mps2, BOUND_ACC_MPS2) || !quat_plausible(in->q_wb)) return ST_BAD_INPUT;
  if (!(fabsf(in->thrust_N) <= BOUND_THRUST_N)) return ST_BAD_INPUT;
  const pos_setpoint_t *sp = &in->setpoint;
  if (!v3_within(sp->pos_w_m, BOUND_POS_M) || !v3_within(sp->vel_w_mps, BOUND_VEL_MPS))
    return ST_BAD_SETPOINT;
  if (!v3_within(sp->acc_w_mps2, BOUND_ACC_MPS2)) return ST_BAD_SETPOINT;
  return ST_OK;
}

// Starts as if the first sample had always been there, so that taking over in flight causes no bump.
static APART void start(outer_t *f, const outer_in_t *in, const sync_in_t *signals) {
  sync_start(&f->sync, signals);
  const v3_t before_m = v3_sub(in->pos_w_m, v3_scale(f->coef.period_s, in->vel_w_mps));
  bias_start(&f->bias, before_m, in->vel_w_mps);
  f->height_last_m = before_m.z;
  f->missed = 0;
  f->started = true;
}

// test: outer_takes_a_last_height_that_is_none_for_no_reset
#define CLIMB_MAX_M (6.0f * BOUND_POS_M) // twice: a height within its bound, less jumps of twice that

// Returns the climb since the last good input, `ticks` periods ago. A reset of the height is not a climb.
static float climb_m(outer_t *f, const outer_in_t *in, float ticks) {
  const float by_height_m = in->pos_w_m.z - f->height_last_m;
  const float by_velocity_m = in->vel_w_mps.z * f->coef.period_s * ticks;
  f->height_last_m = in->pos_w_m.z;
  if (fabsf(by_height_m - by_velocity_m) <= BOUND_HEIGHT_JUMP_M * ticks) return by_height_m;
  if (!(fabsf(by_height_m) <= CLIMB_MAX_M)) return by_velocity_m; // a bit of the last height flipped
  count(f, ST_JUMP);
  bias_shift(&f->bias, (v3_t){.z = by_height_m - by_velocity_m});
  f->hold.ceiling_z_m += by_height_m - by_velocity_m;
  f->range_height_m += by_height_m - by_velocity_m;
  return by_velocity_m;
}

// True if the range is a repeated value: a sensor without time stamps gives its last value while it has no
// new one, so an unchanged value after a climb is not a measurement.
static bool is_repeated(outer_t *f, const outer_in_t *in) {
  const bool is = in->range_new && in->range_m > 0.0f && in->range_m <= CEILING_RANGE_MAX_M;
  const bool same = in->range_m == f->range_last_m, other = is && !same;
  f->range_last_m = EITHER(other, in->range_m, f->range_last_m);
  f->range_height_m = EITHER(other, in->pos_w_m.z, f->range_height_m);
  return is && same && fabsf(in->pos_w_m.z - f->range_height_m) > OUTER_REPEATED_M;
}

static void take_range(outer_t *f, const outer_in_t *in) {
  // The sensor looks along the body's axis; a level ceiling is nearer by the cosine of the tilt as it was
  // then.
  const float vertical_m = in->range_m * ceiling_up(&f->ceiling, in->range_age_s);
  const float gap_m =
      EITHER(in->range_m <= CEILING_RANGE_MAX_M, vertical_m - f->param.up_offset_m, in->range_m);
  const bool repeated = is_repeated(f, in), is_new = in->range_new && !repeated;
  const bool good = ceiling_good(gap_m, in->range_age_s), is = is_new && good;
  if (is_new && !good) count(f, ST_BAD_RANGE);
  if (!ANY(is)) return;
  ceiling_take(&f->ceiling, &f->param.ceiling, is, gap_m, in->range_age_s);
  hold_take(&f->hold, &f->ceiling, is, in->pos_w_m.z, in->vel_w_mps.z, f->param.hold);
}

static APART void find_ceiling(outer_t *f, const outer_in_t *in) {
  const int ticks = 1 + (int)f->missed;
  ceiling_predict_over(&f->ceiling, &f->param.ceiling, climb_m(f, in, (float)ticks), ticks);
  ceiling_tilt(&f->ceiling, quat_up(f->sync.att_last).z);
  if (ANY(in->range_new)) take_range(f, in);
  hold_step(&f->hold, &f->ceiling, in->pos_w_m.z, f->coef.period_s * (float)ticks, f->param.hold);
}

// Runs the bias observer; after missed periods its step is longer.
static status_t find_bias(outer_t *f, const outer_in_t *in, v3_t acc_w_mps2) {
  bias_coef_t late;
  if (f->missed > 0) bias_tune(&late, &f->param.bias, f->coef.period_s * (1.0f + (float)f->missed));
  const bias_coef_t *const c = f->missed > 0 ? &late : &f->bias_coef;
  return bias_step(&f->bias, &f->param.bias, c, acc_w_mps2, in->pos_w_m, in->vel_w_mps);
}

float outer_take_bias(outer_t *f, float more_mps2) {
  const bool takes = f->started && f->param.bias.pole_radps > 0.0f && more_mps2 != 0.0f;
  if (!ANY(takes)) return 0.0f;
  float taken_mps2 = 0.0f;
  FOR_WHOM(takes, &f->bias) taken_mps2 = bias_take(&f->bias, &f->param.bias, more_mps2);
  taken_mps2 = EITHER(takes, taken_mps2, 0.0f); // 0 also at the observer's bound
  FOR_WHOM(taken_mps2 != 0.0f, &f->sync) sync_shift_acc(&f->sync, taken_mps2);
  return taken_mps2;
}

static APART void start_signals(outer_t *f, const outer_in_t *in) {
  const sync_in_t again = {in->acc_b_mps2, in->q_wb, in->thrust_N, f->at_limit};
  sync_start(&f->sync, &again);
  count(f, ST_BAD_STATE);
}

void outer_scrub(outer_t *f, const outer_in_t *in) {
  if (f->started && !sync_good(&f->sync)) start_signals(f, in);
}

// Keeps this tick's sample for the learner, which decides whether to use it.
static APART void observe(outer_t *f, const sync_out_t *x) {
  const bool known = f->ceiling.known;
  const float weight_N = f->param.pos.mass_kg * GRAVITY_MPS2;
  const bool carries = x->thrust_N >= CARRYING_SHARE * weight_N;
  f->carrying_s = carries ? f_clamp(f->carrying_s + f->coef.period_s, 0.0f, OUTER_CARRYING_S) : 0.0f;
  f->sample = learn_sample(&f->sync, x, f->param.pos.mass_kg);
  f->sample.zc_m = sync_distance_m(&f->sync, &f->coef, known, f->ceiling.zc_m);
  f->sample.known = known && f->carrying_s >= f->param.learn_after_s;
  f->sample.blind_s = f->ceiling.blind_s;
  f->sample_new = true;
}

void outer_learn(outer_t *f) {
  if (!f->sample_new || f->param.curve.mode != CURVE_LIVE) return;
  f->sample_new = false;
  count(f, learn_update(&f->learn, &f->param.learn, &f->sample, f->ground.lesson_excess));
}

void outer_rest(outer_t *f) {
  f->started = f->at_limit = f->sample_new = false;
  outer_lose_ground(f);
  f->carrying_s = 0.0f;
  ceiling_init(&f->ceiling, f->coef.period_s);
  hold_init(&f->hold);
  f->out = (outer_out_t)AT_REST;
}

typedef struct {
  v3_t acc_mps2;
  float climb_mps;
} wanted_t;

// Returns the wanted acceleration and climb rate, not nearer to the ceiling than ceil.min, whether a height,
// a velocity or an acceleration was asked for: upwards at most what a set point at rest at that limit asks
// for. A height beyond the limit is flown up to OUTER_CLIP_M below it, as no vehicle holds a limit to the
// millimetre.
static wanted_t wanted(const outer_t *f, const outer_in_t *in, v3_t vel_mps) {
  const pos_indi_param_t *p = &f->law;
  const pos_setpoint_t *sp = &in->setpoint;
  wanted_t w = {.acc_mps2 = pos_indi_wanted_acc(p, sp, in->pos_w_m, vel_mps),
                .climb_mps = sp->vel_w_mps.z + p->kp_z_per_s * (sp->pos_w_m.z - in->pos_w_m.z)};
  const bool limited = f_finite(f->hold.ceiling_z_m);
  if (!ANY(limited)) return w;
  const float limit_m = f->hold.ceiling_z_m - f->gap_min_m;
  const float beyond_m = f_clamp(sp->pos_w_m.z - limit_m, 0.0f, OUTER_CLIP_M);
  const float climb_mps = p->kp_z_per_s * (limit_m - beyond_m - in->pos_w_m.z);
  const float most_mps2 = f_max(p->kd_z_per_s * (climb_mps - vel_mps.z), -p->acc_max_mps2);
  w.acc_mps2.z = EITHER(limited, f_min(w.acc_mps2.z, most_mps2), w.acc_mps2.z);
  w.climb_mps = EITHER(limited, f_min(w.climb_mps, climb_mps), w.climb_mps);
  return w;
}

// Inputs of the increment.
typedef struct {
  v3_t error_mps2;     // of the acceleration
  float dzc_m, most_N; // change of the distance; largest increment of the thrust
} aim_t;

// Returns the largest increment of the thrust. Near a ceiling, thrust beyond what accelerates the vehicle is
// a push against it, which is limited to ceil.push.
static float most_N(const outer_t *f, float ratio, float climb_mps) {
  const bool reaches = f->ceiling.known && f->ceiling.zc_m < OUTER_TOUCH_M && climb_mps > -OUTER_STILL_MPS;
  if (!reaches || f->param.pos.law == LAW_THESIS) return f->param.step_max_N;
  const float pushed_N = ratio * f->sample.thrust_N - f->sample.force_N;
  return f_clamp((f->param.push_N - pushed_N) / ratio, 0.0f, f->param.step_max_N);
}

static APART aim_t aim(const outer_t *f, const outer_in_t *in, const sync_out_t *x, float ratio) {
  v3_t vel = bias_free_velocity(&f->bias, in->vel_w_mps);
  vel.z -= f->less_mps; // keeps the sign of -0, too
  wanted_t w = wanted(f, in, vel);
  w.acc_mps2.z += f->ground.pull_per_s2 * (f->lag_s * vel.z); // ground effect lost by then
  return (aim_t){.error_mps2 = v3_sub(w.acc_mps2, x->acc_w_mps2),
                 .dzc_m = pos_indi_nearing_m(&f->law, vel.z, w.climb_mps, f->lag_s),
                 .most_N = most_N(f, ratio, vel.z)};
}

static APART pos_command_t fly(const outer_t *f, const sync_out_t *x, rbf_point_t at, const aim_t *to) {
  const pos_indi_param_t *p = &f->law;
  pos_step_t step = pos_indi_step(p, x->q_wb, x->thrust_N, to->error_mps2, to->dzc_m, at);
  step.thrust_N = f_clamp(step.thrust_N, -f->param.step_max_N, to->most_N);
  return pos_indi_command(p, x->q_wb, x->thrust_N, step);
}

const outer_out_t *outer_step(outer_t *f, const outer_in_t *in) {
  const status_t judged = check_in(in);
  count(f, judged);
  if (f->missed > OUTER_MISSED_MAX) f->missed = OUTER_MISSED_MAX; // a flipped bit
  if (judged != ST_OK) {
    outer_miss(f, 1);
    return &f->out;
  }

  const sync_in_t in_sync = {in->acc_b_mps2, in->q_wb, in->thrust_N, f->at_limit};
  if (!f->started) start(f, in, &in_sync);
  sync_out_t *const x = &f->signals;
  sync_step(&f->sync, &f->coef, &in_sync, x);
  find_ceiling(f, in);
  count(f, find_bias(f, in, x->acc_now_w_mps2));
  x->acc_w_mps2 = v3_sub(x->acc_w_mps2, f->bias.bias_mps2);
  f->missed = 0;
  rbf_point_t at = curve_at(&f->param.curve, &f->learn.rls.theta, f->ceiling.known, f->ceiling.zc_m);
  at.ratio += f->ground.excess;
  observe(f, x);
  const aim_t to = aim(f, in, x, at.ratio);
  const pos_command_t command = fly(f, x, at, &to);
  f->at_limit = command.at_limit;
  f->out = (outer_out_t){
      .up_w = command.up_w,
      .thrust_N = command.thrust_N,
      .zc_m = f->ceiling.zc_m,
      .zc_known = f->ceiling.known,
      .at = at,
      .ceiling_z_m = f->hold.ceiling_z_m,
  };
  return &f->out;
}
