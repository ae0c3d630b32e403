// loop.c - one flight.
#include "flight/loop.h"

#include "base/constants.h"
#include "base/cpu_time.h"
#include "base/larger.h"
#include "flight/over.h"
#include "sense/ekf.h"
#include <math.h>
#include <stdlib.h>

#define RECORD_S 0.01
#define IDLE_N   0.002 // of one motor: below, it stands

struct flight_loop {
  const plan_t *plan;
  const model_t *model; // `own`
  model_t own;          // this flight's: as drawn, on the vertical axis a point
  noise_t noise;        // so are the sensors
  const pilot_t *pilot;
  body_t body;
  random_t *random;
  imu_t imu;
  range_t range;
  mocap_t mocap;
  vertical_t vertical;
  ekf_in_t seen; // the pose is only there with motion capture
  ekf_t ekf;
  pilot_in_t in;
  ekf_out_t estimate;
  double motor_N[PILOT_MOTORS];
  double up_min, gap_min_m, range_m; // up_min: smallest cosine of the tilt since the last sample
  bool range_new;
  int way;
  double ceiling_z_m; // as the pilot thinks it, at the last sample
  long tick;
  int every; // ticks a sample
  truth_t truth;
  thoughts_t thoughts;
};

static truth_t truth_of(const flight_loop_t *f) {
  const body_t *b = &f->body;
  const double *y = b->y;
  const dq_t q = dq_of(y + RIGID_Q_WB);
  const axes_t axes = axes_of(q);
  const double up = larger(axes_up_b(&axes).z, 1e-3);
  bool motors = false;
  for (int i = 0; i < ROTORS; i++) motors = motors || y[RIGID_THRUST_N + i] > IDLE_N;
  const double climb_mps = y[RIGID_VEL_MPS + 2] / up;
  const d3_t floor_up_w = b->touch.floor_up_w, pos_w_m = d3_of(y + RIGID_POS_M);
  const double floor_up = larger(d3_dot(axes.z, floor_up_w), 1e-3);
  // Both range sensors lie in the rotors' plane and at the feet, near enough, on the axis.
  fx_sensed_t above = {.acc_b_mps2 = body_specific_force_b_mps2(b),
                       .range_m = (f->model->ceiling_m - y[RIGID_POS_M + 2] - body_rotor_z_m(f->model)) / up,
                       .range_rate_mps = -climb_mps};
  fx_sensed_t below = {.range_m =
                           (touch_above_floor_m(&b->touch, pos_w_m) - body_rest_z_m(f->model)) / floor_up,
                       .range_rate_mps = d3_dot(floor_up_w, d3_of(y + RIGID_VEL_MPS)) / floor_up};
  model_sense(f->model, &above);
  model_sense(f->model, &below);
  return (truth_t){
      .pos_w_m = d3_of(y + RIGID_POS_M),
      .vel_w_mps = d3_of(y + RIGID_VEL_MPS),
      .q_wb = q,
      .rate_b_radps = d3_of(y + RIGID_RATE_RADPS),
      .force_b_mps2 = above.acc_b_mps2,
      .up_m = above.range_m,
      .down_m = below.range_m,
      .motors = motors,
  };
}

// Motion capture in place of the downward sensors; its zero is the height at rest.
static void see_by_mocap(flight_loop_t *f, const truth_t *truth) {
  truth_t seen = *truth;
  seen.pos_w_m.z -= body_rest_z_m(f->model);
  const mocap_sample_t pose = mocap_step(&f->mocap, &f->plan->mocap, f->random, &seen);
  f->seen.range_new = f->seen.flow_new = false;
  f->seen.pose_new = pose.is_new;
  f->seen.pose_m = pose.pos_w_m;
  f->seen.pose_q = pose.q_wb;
}

// One millisecond of sensors and estimator, from what is true at the start of the tick.
static void sense(flight_loop_t *f, const truth_t *truth) {
  const imu_sample_t imu = imu_step(&f->imu, &f->noise.imu, f->random, truth);
  const range_sample_t range = range_step(&f->range, &f->noise.range, f->random, truth);
  ekf_in_t *const seen = &f->seen;
  seen->imu = imu;
  seen->motors = truth->motors;
  seen->range_new = range.down_new;
  seen->range_m = range.down_m;
  seen->flow_new = range.flow_new;
  seen->flow_x = range.flow_x;
  seen->flow_y = range.flow_y;
  seen->flow_span_s = range.flow_span_s;
  if (f->plan->mocap.period_s > 0.0) see_by_mocap(f, truth);
  // Taken before the update: it is what the update before this one finished.
  f->estimate = f->ekf.out;
  f->in.pos_w_m = f->ekf.out.pos_w_m;
  f->in.vel_w_mps = f->ekf.out.vel_w_mps;
  f->in.q_wb = f->ekf.out.q_wb;
  ekf_update(&f->ekf, seen);
  f->in.gyro_b_radps = imu.gyro_b_radps;
  f->in.acc_b_mps2 = imu.acc_b_mps2;
  f->in.range_new = range.up_new;
  f->in.down_new = range.down_new;
  f->in.down_m = range.down_m;
  f->in.range_m = range.up_mm >= RANGE_UP_NOTHING_MM ? (double)NAN : 1e-3 * range.up_mm;
  if (range.up_new) f->range_m = f->in.range_m;
  f->range_new = f->range_new || range.up_new;
}

// The same on the vertical axis.
static void sense_vertical(flight_loop_t *f, const truth_t *truth) {
  const vertical_sample_t seen = vertical_step(&f->vertical, &f->plan->vertical_noise, f->random, truth);
  f->in.pos_w_m.z = seen.z_m;
  f->in.vel_w_mps.z = seen.climb_mps;
  f->in.acc_b_mps2.z = seen.acc_mps2 + G_MPS2;
  f->in.range_new = seen.range_new;
  if (seen.range_new) f->range_m = f->in.range_m = seen.range_m;
  f->range_new = f->range_new || seen.range_new;
  f->estimate = (ekf_out_t){.pos_w_m = f->in.pos_w_m, .vel_w_mps = f->in.vel_w_mps, .q_wb = f->in.q_wb};
}

// The estimator's zero is the height at rest; the plan's heights are of the rotors' plane.
static void order(flight_loop_t *f, double t_s) {
  const plan_t *plan = f->plan;
  while (f->way + 1 < plan->n_way && t_s >= plan->way[f->way + 1].at_s - 1e-9) f->way++;
  const double rest_m = body_rest_z_m(f->model) + body_rotor_z_m(f->model);
  const bool on = t_s >= plan->take_off_s;
  for (int i = 0; i < 3; i++) f->in.set.mode[i] = on ? PILOT_POSITION : PILOT_OFF;
  const bool thought = plan->below_estimate && isfinite(f->ceiling_z_m);
  const double down_m = thought ? f->model->ceiling_m - f->ceiling_z_m : rest_m;
  f->in.set.pos_w_m = (d3_t){0.0, 0.0, plan->way[f->way].setpoint_m - down_m};
  f->in.set.thrust_N = 0.0;
}

static void call_pilot(flight_loop_t *f, const truth_t *truth) {
  f->plan->vertical_only ? sense_vertical(f, truth) : sense(f, truth);
  if (f->plan->edit) {
    pilot_in_t in = f->in;
    f->plan->edit(f->plan->edit_context, &f->body, &in);
    f->pilot->step(f->pilot->state, &in, f->motor_N);
  } else {
    f->pilot->step(f->pilot->state, &f->in, f->motor_N);
  }
  f->in.step++;
}

static tick_t look(flight_loop_t *f, double t_s) {
  f->thoughts = (thoughts_t){.zc_m = (double)NAN, .ceiling_z_m = (double)NAN, .ratio = 1.0, .y = (double)NAN};
  if (f->pilot->tell) f->pilot->tell(f->pilot->state, &f->thoughts);
  f->ceiling_z_m = f->thoughts.ceiling_z_m;
  const tick_t tick = {
      .t_s = t_s,
      .setpoint_m = f->plan->way[f->way].setpoint_m,
      .body = &f->body,
      .truth = &f->truth,
      .in = &f->in,
      .estimate = &f->estimate,
      .motor_N = f->motor_N,
      .thoughts = &f->thoughts,
      .up_min = f->up_min,
      .gap_min_m = f->gap_min_m,
      .range_new = f->range_new,
      .range_m = f->range_m,
  };
  f->gap_min_m = HUGE_VAL;
  f->up_min = 1.0;
  f->range_new = false;
  return tick;
}

static void look_at_rotors(flight_loop_t *f) {
  f->in.rotors_N = 0.0;
  for (int i = 0; i < PILOT_MOTORS; i++) f->in.rotors_N += f->body.y[RIGID_THRUST_N + i];
}

static void move(flight_loop_t *f, double tick_s) {
  const plan_t *plan = f->plan;
  if (plan->vertical_noise.gust_mps2 > 0.0) {
    const double gust_mps2 = vertical_gust_mps2(&f->vertical, &plan->vertical_noise, f->random);
    body_push(&f->body, d3(0.0, 0.0, f->model->mass_kg * gust_mps2));
  }
  body_tick(&f->body, f->motor_N, tick_s);
  for (int i = 0; i < PILOT_MOTORS; i++) f->in.applied_N[i] = f->body.command_N[i];
  look_at_rotors(f);
  f->in.vbat_V = f->body.vbat_V;
  f->gap_min_m = smaller(f->gap_min_m, record_gap_m(&f->body));
}

static double tick_s_of(const flight_loop_t *f) {
  return f->plan->vertical_only ? f->plan->period_s : LOOP_TICK_S;
}

flight_over_t loop_tick(flight_loop_t *f, tick_t *seen, bool *is_sample) {
  const plan_t *plan = f->plan;
  const double tick_s = tick_s_of(f), t_s = (double)f->tick * tick_s;
  *is_sample = false;
  const flight_over_t over = flight_over(plan, tick_s, f->tick, &f->body, f->motor_N);
  if (over != FLIGHT_FLIES) return over;
  order(f, t_s);
  if (f->body.rigid.held && t_s >= plan->held_s) body_hold(&f->body, false);
  f->truth = truth_of(f);
  const int calls = plan->vertical_only ? 1 : 2;
  for (int i = 0; i < calls; i++) call_pilot(f, &f->truth);
  const axes_t axes = axes_of(f->truth.q_wb);
  f->up_min = smaller(f->up_min, axes_up_b(&axes).z);
  *is_sample = f->tick % f->every == 0;
  if (*is_sample) *seen = look(f, t_s);
  return FLIGHT_FLIES;
}

void loop_move(flight_loop_t *f) {
  move(f, tick_s_of(f));
  f->tick++;
}

static done_t run(flight_loop_t *f, record_t *record, outcome_t *outcome, why_t *why) {
  TRY(record_reserve(record, (int)(lround(f->plan->end_s / tick_s_of(f)) / f->every) + 1, why));
  flight_over_t over;
  tick_t seen;
  for (bool is_sample; (over = loop_tick(f, &seen, &is_sample)) == FLIGHT_FLIES; loop_move(f))
    if (is_sample) TRY(record_add(record, &seen, why));
  outcome->finite = over != FLIGHT_NOT_FINITE;
  return DONE;
}

static body_start_t start_of(const flight_loop_t *f) {
  const plan_t *plan = f->plan;
  if (!plan->vertical_only) {
    body_start_t start = plan->in_flight ? plan->start : body_standing(f->model);
    start.held = plan->held_s > 0.0;
    return start;
  }
  // On the ground it lies as deep as its springs need to carry what the rotors do not.
  const double each_N = plan->start_thrust_N / ROTORS;
  const double left_mps2 = larger(0.0, G_MPS2 - plan->start_thrust_N / f->model->mass_kg);
  const double z_m = plan->start_z_m > 0.0 ? plan->start_z_m : -left_mps2 / (TOUCH_POINTS * TOUCH_SPRING);
  return (body_start_t){
      .pos_w_m = {0.0, 0.0, z_m}, .thrust_N = {each_N, each_N, each_N, each_N}, .vertical_only = true};
}

// What the file's vehicle and the level's sensors are in this flight.
static done_t draw(flight_loop_t *f, const model_t *model, drawn_t *drawn, why_t *why) {
  f->noise = f->plan->noise;
  f->own = f->plan->vertical_only ? model_point(model) : *model;
  if (f->plan->vertical_only) return DONE;
  TRY(drawn_of(&f->noise.vary, f->plan->seed, drawn, why));
  drawn_sense(drawn, &f->noise);
  return drawn_vehicle(drawn, &f->own, why);
}

static done_t begin(flight_loop_t *f, why_t *why) {
  const plan_t *plan = f->plan;
  body_start_t start = start_of(f);
  start.seed = plan->seed ^ 0x9e3779b97f4a7c15u;
  const done_t opened =
      body_open(&f->body, f->model, plan->integrate, plan->step_s > 0.0 ? plan->step_s : LOOP_TICK_S, &start);
  if (opened == BAD_INPUT)
    return error_set(
        why,
        "vehicle %s with its effects: mass, inertia, motor lag or kf not above 0; such a vehicle "
        "cannot fly",
        f->model->name);
  f->random = random_open(plan->seed);
  if (opened != DONE || !f->random) return error_failed(why, "out of memory");
  imu_init(&f->imu);
  range_init(&f->range);
  f->mocap = (mocap_t){0};
  ekf_init(&f->ekf, &ekf_firmware, 0.0);
  if (plan->vertical_only)
    vertical_init(&f->vertical, &plan->vertical_noise, plan->period_s, start.pos_w_m.z);
  f->in.q_wb = (dq_t){1.0, 0.0, 0.0, 0.0};
  if (plan->in_flight) {
    const d3_t rest = {0.0, 0.0, -body_rest_z_m(f->model)};
    ekf_place(&f->ekf, d3_add(start.pos_w_m, rest), start.vel_w_mps, dq_of(f->body.y + RIGID_Q_WB));
  }
  for (int i = 0; i < PILOT_MOTORS; i++) f->in.applied_N[i] = start.thrust_N[i];
  look_at_rotors(f);
  f->in.vbat_V = f->body.vbat_V;
  f->pilot->reset(f->pilot->state);
  return DONE;
}

done_t loop_open(flight_loop_t **loop, const plan_t *plan, const model_t *model, const pilot_t *pilot,
                 drawn_t *drawn, why_t *why) {
  flight_loop_t *f = *loop = calloc(1, sizeof *f);
  if (!f) return error_failed(why, "out of memory");
  *f = (flight_loop_t){.plan = plan, .model = &f->own, .pilot = pilot};
  f->gap_min_m = HUGE_VAL;
  f->up_min = 1.0;
  f->range_m = f->ceiling_z_m = (double)NAN;
  f->every = plan->record_every > 0 ? plan->record_every : (int)lround(larger(1.0, RECORD_S / tick_s_of(f)));
  done_t status = draw(f, model, drawn, why);
  if (status == DONE) status = begin(f, why);
  if (status == DONE) return DONE;
  loop_close(f);
  *loop = NULL;
  return status;
}

body_t *loop_body(flight_loop_t *f) {
  return &f->body;
}
model_t *loop_model(flight_loop_t *f) {
  return &f->own;
}
ekf_t *loop_estimator(flight_loop_t *f) {
  return &f->ekf;
}

void loop_close(flight_loop_t *f) {
  if (!f) return;
  if (f->body.integrate) body_close(&f->body);
  random_close(f->random);
  free(f);
}

done_t loop_fly(const plan_t *plan, const model_t *model, const pilot_t *pilot, record_t *record,
                outcome_t *outcome, why_t *why) {
  record->vertical_only = plan->vertical_only;
  *outcome = (outcome_t){.finite = true};
  const double start_s = cpu_time_s();
  flight_loop_t *f;
  TRY(loop_open(&f, plan, model, pilot, &outcome->drawn, why));
  const done_t status = run(f, record, outcome, why);
  outcome->contacts = f->body.ceiling_contacts;
  outcome->realtime_factor = cpu_time_factor(plan->end_s, start_s);
  loop_close(f);
  return status;
}
