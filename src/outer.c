// outer.c - the outer loop.
#include "flight/outer.h"

#include "flight/bounds.h"
#include <string.h>

#define MISSED_MAX 1000 // ticks; nobody flies on after so many

#define AT_REST                                                                                              \
  { .up_w = {0.0f, 0.0f, 1.0f}, .at = {.ratio = 1.0f}, .ceiling_z_m = NAN }

static status_t tune(outer_t *f, const flight_param_t *p, float period_s) {
  TRY(params_check(p));
  TRY(sync_tune(&f->coef, p->cutoff_Hz, p->motor_tau_s, period_s));
  f->param = *p;
  return ST_OK;
}

status_t outer_init(outer_t *f, const flight_param_t *p, float period_s) {
  if (!(period_s >= 0.001f && period_s <= 0.1f)) return ST_BAD_PARAM;
  outer_t fresh = {.out = AT_REST};
  TRY(tune(&fresh, p, period_s));
  TRY(learn_init(&fresh.learn, &p->learn, &p->curve.fixed));
  ceiling_init(&fresh.ceiling, period_s);
  hold_init(&fresh.hold);
  *f = fresh;
  return ST_OK;
}

static void count(outer_t *f, status_t status) {
  if (status != ST_OK) f->faults[status]++;
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

// Starts as if the first sample had been there for ever, so that taking over in flight is no bump.
static void start(outer_t *f, const outer_in_t *in, const sync_in_t *signals) {
  sync_start(&f->sync, signals);
  bias_start(&f->bias, in->pos_w_m, in->vel_w_mps);
  f->height_last_m = in->pos_w_m.z - in->vel_w_mps.z * f->coef.period_s;
  f->missed = 0;
  f->started = true;
}

// The climb since the last good input, `ticks` periods ago. A reset of the height estimate is no climb.
static float climb_m(outer_t *f, const outer_in_t *in, float ticks) {
  const float by_height_m = in->pos_w_m.z - f->height_last_m;
  const float by_velocity_m = in->vel_w_mps.z * f->coef.period_s * ticks;
  f->height_last_m = in->pos_w_m.z;
  if (fabsf(by_height_m - by_velocity_m) <= BOUND_HEIGHT_JUMP_M * ticks) return by_height_m;
  count(f, ST_JUMP);
  bias_shift(&f->bias, (v3_t){.z = by_height_m - by_velocity_m});
  f->hold.ceiling_z_m += by_height_m - by_velocity_m;
  return by_velocity_m;
}

static void find_ceiling(outer_t *f, const outer_in_t *in) {
  const int ticks = 1 + (int)f->missed;
  ceiling_predict_over(&f->ceiling, &f->param.ceiling, climb_m(f, in, (float)ticks), ticks);
  ceiling_tilt(&f->ceiling, quat_up(f->sync.att_last).z);
  if (in->range_new) {
    // The sensor looks along the body's axis; a level ceiling is nearer by the cosine of the tilt as it was
    // then.
    const float vertical_m = in->range_m * ceiling_up(&f->ceiling, in->range_age_s);
    const float gap_m = in->range_m <= CEILING_RANGE_MAX_M ? vertical_m - f->param.up_offset_m : in->range_m;
    const status_t status = ceiling_correct(&f->ceiling, &f->param.ceiling, gap_m, in->range_age_s);
    count(f, status);
    if (status == ST_OK) hold_sample(&f->hold, &f->ceiling, in->pos_w_m.z);
  }
  hold_step(&f->hold, &f->ceiling, in->pos_w_m.z, f->coef.period_s * (float)ticks, f->param.hold);
}

// What this tick can teach; the learner decides whether it may.
static void observe(outer_t *f, const sync_out_t *x) {
  const bool known = f->ceiling.known;
  const float weight_N = f->param.pos.mass_kg * GRAVITY_MPS2;
  if (x->thrust_N < CARRYING_SHARE * weight_N)
    f->carrying_s = 0.0f;
  else if (f->carrying_s < 100.0f)
    f->carrying_s += f->coef.period_s;
  f->sample = learn_sample(&f->sync, x, f->param.pos.mass_kg);
  f->sample.zc_m = sync_distance_m(&f->sync, &f->coef, known, f->ceiling.zc_m);
  f->sample.known = known && f->carrying_s >= f->param.learn_after_s;
  f->sample.blind_s = f->ceiling.blind_s;
  f->sample_new = true;
}

void outer_learn(outer_t *f) {
  if (!f->sample_new || f->param.curve.mode != CURVE_LIVE) return;
  f->sample_new = false;
  count(f, learn_update(&f->learn, &f->param.learn, &f->sample));
}

void outer_rest(outer_t *f) {
  f->started = f->at_limit = f->sample_new = false;
  f->carrying_s = 0.0f;
  ceiling_init(&f->ceiling, f->coef.period_s);
  hold_init(&f->hold);
  f->out = (outer_out_t)AT_REST;
}

// Not nearer to the ceiling than ceil.min, whatever was asked for, be it a height, a velocity or an
// acceleration: upwards no more than a set point that rests there asks for. Who asks for a height beyond
// rests OUTER_CLIP_M below, as no one holds a limit to the millimetre.
static v3_t wanted_acc(const outer_t *f, const outer_in_t *in, v3_t vel_mps) {
  const pos_indi_param_t *p = &f->param.pos;
  v3_t wanted = pos_indi_wanted_acc(p, &in->setpoint, in->pos_w_m, vel_mps);
  if (!f_finite(f->hold.ceiling_z_m)) return wanted;
  const float limit_m = f->hold.ceiling_z_m - f->param.gap_min_m;
  const float beyond_m = f_clamp(in->setpoint.pos_w_m.z - limit_m, 0.0f, OUTER_CLIP_M);
  const pos_setpoint_t top = {.pos_w_m = {.z = limit_m - beyond_m}};
  const float most_mps2 = pos_indi_wanted_acc(p, &top, in->pos_w_m, vel_mps).z;
  if (wanted.z > most_mps2) wanted.z = most_mps2;
  return wanted;
}

static pos_command_t fly(const outer_t *f, const outer_in_t *in, const sync_out_t *x, rbf_point_t at) {
  const pos_indi_param_t *p = &f->param.pos;
  const v3_t vel = bias_free_velocity(&f->bias, in->vel_w_mps);
  const v3_t error = v3_sub(wanted_acc(f, in, vel), x->acc_w_mps2);
  pos_step_t step = pos_indi_step(p, x->q_wb, x->thrust_N, error, vel.z, at);
  step.thrust_N = f_clamp(step.thrust_N, -f->param.step_max_N, f->param.step_max_N);
  return pos_indi_command(p, x->q_wb, x->thrust_N, step);
}

outer_out_t outer_step(outer_t *f, const flight_param_t *p, const outer_in_t *in) {
  if (memcmp(p, &f->param, sizeof *p) != 0) count(f, tune(f, p, f->coef.period_s));
  const status_t judged = check_in(in);
  count(f, judged);
  if (judged != ST_OK) {
    if (f->missed < MISSED_MAX) f->missed++;
    return f->out;
  }

  const sync_in_t signals = {in->acc_b_mps2, in->q_wb, in->thrust_N, f->at_limit};
  if (!f->started) start(f, in, &signals);
  sync_out_t x = sync_step(&f->sync, &f->coef, &signals);
  find_ceiling(f, in);
  bias_step(&f->bias, &f->param.bias, x.acc_now_w_mps2, in->pos_w_m, in->vel_w_mps,
            f->coef.period_s * (1.0f + (float)f->missed));
  x.acc_w_mps2 = v3_sub(x.acc_w_mps2, f->bias.bias_mps2);
  f->missed = 0;
  const rbf_point_t at = curve_at(&f->param.curve, &f->learn.rls.theta, f->ceiling.known, f->ceiling.zc_m);
  observe(f, &x);
  const pos_command_t command = fly(f, in, &x, at);
  f->at_limit = command.at_limit;
  f->out = (outer_out_t){
      .up_w = command.up_w,
      .thrust_N = command.thrust_N,
      .zc_m = f->ceiling.zc_m,
      .zc_known = f->ceiling.known,
      .at = at,
      .ceiling_z_m = f->hold.ceiling_z_m,
  };
  return f->out;
}
