// loop_parts.c - the inside of a flight: its ticks.
#include "flight/loop_parts.h"

#include "base/constants.h"
#include "base/larger.h"
#include <math.h>

double loop_tick_s(const flight_loop_t *f) {
  return f->plan->vertical_only ? f->plan->period_s : LOOP_TICK_S;
}

static void take_truth(const flight_loop_t *f, truth_t *truth) {
  const double *const y = f->body.y;
  bool motors = false;
  for (int i = 0; i < ROTORS; i++) motors = motors || y[RIGID_THRUST_N + i] > FORCES_IDLE_N;
  fx_sensed_t above, below;
  body_sensed(&f->body, &above, &below);
  truth->pos_w_m = d3_of(y + RIGID_POS_M);
  truth->vel_w_mps = d3_of(y + RIGID_VEL_MPS);
  truth->q_wb = dq_of(y + RIGID_Q_WB);
  truth->rate_b_radps = d3_of(y + RIGID_RATE_RADPS);
  truth->force_b_mps2 = above.acc_b_mps2;
  truth->up_m = above.range_m;
  truth->down_m = below.range_m;
  truth->motors = motors;
}

// Motion capture in place of the downward sensors; its zero is the height at rest.
static mocap_sample_t see_by_mocap(flight_loop_t *f, const truth_t *truth) {
  truth_t seen = *truth;
  seen.pos_w_m.z -= body_rest_z_m(f->model);
  return mocap_step(&f->mocap, &f->plan->mocap, f->random, &seen);
}

void loop_draw(flight_loop_t *f, const truth_t *truth, senses_drawn_t *drawn) {
  random_triangles(f->random, IMU_DRAWN, drawn->imu);
  loop_draw_more(f, truth, drawn);
}

void loop_draw_more(flight_loop_t *f, const truth_t *truth, senses_drawn_t *drawn) {
  drawn->range = range_draw(&f->senses.range, &f->noise.range, f->random);
  drawn->by_mocap = f->plan->mocap.period_s > 0.0;
  if (drawn->by_mocap) drawn->mocap = see_by_mocap(f, truth);
}

void loop_note_range(flight_loop_t *f) {
  if (f->in.range_new) f->range_m = f->in.range_m;
  f->range_new = f->range_new || f->in.range_new;
}

// One millisecond of sensors and estimator, from what is true at the start of the tick.
static void sense(flight_loop_t *f, const truth_t *truth) {
  senses_drawn_t drawn;
  loop_draw(f, truth, &drawn);
  senses_take(&f->senses, &f->noise.imu, &f->noise.range, &drawn, truth, &f->in);
  loop_note_range(f);
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
  f->senses.estimate =
      (ekf_out_t){.pos_w_m = f->in.pos_w_m, .vel_w_mps = f->in.vel_w_mps, .q_wb = f->in.q_wb};
}

// Returns when the next set point is due, unless the pilot's estimate of the ceiling changes before.
static double next_order_s(const flight_loop_t *f, double t_s) {
  const plan_t *plan = f->plan;
  const double way_s = f->way + 1 < plan->n_way ? plan->way[f->way + 1].at_s - 1e-9 : HUGE_VAL;
  return t_s >= plan->take_off_s ? way_s : smaller(way_s, plan->take_off_s);
}

// Updates the set point; true if it changed. The estimator's zero is the height at rest, the plan's heights
// are of the rotors' plane.
static bool order(flight_loop_t *f, double t_s) {
  const plan_t *plan = f->plan;
  if (t_s < f->order_s) return false;
  while (f->way + 1 < plan->n_way && t_s >= plan->way[f->way + 1].at_s - 1e-9) f->way++;
  f->order_s = next_order_s(f, t_s);
  const double rest_m = body_rest_z_m(f->model) + body_rotor_z_m(f->model);
  const pilot_mode_t mode = t_s >= plan->take_off_s ? PILOT_POSITION : PILOT_OFF;
  const bool thought = plan->below_estimate && isfinite(f->ceiling_z_m);
  const double down_m = thought ? f->model->ceiling_m - f->ceiling_z_m : rest_m;
  const double z_m = plan->way[f->way].setpoint_m - down_m;
  pilot_setpoint_t *const set = &f->in.set;
  if (set->mode[2] == mode && set->pos_w_m.z == z_m) return false;
  for (int i = 0; i < 3; i++) set->mode[i] = mode;
  set->pos_w_m = (d3_t){0.0, 0.0, z_m};
  return true;
}

void loop_pilot(flight_loop_t *f) {
  if (f->plan->edit) {
    pilot_in_t in = f->in;
    f->plan->edit(f->plan->edit_context, &f->body, &in);
    f->pilot->step(f->pilot->state, &in, f->motor_N);
  } else {
    f->pilot->step(f->pilot->state, &f->in, f->motor_N);
  }
  f->in.step++;
}

static void call_pilot(flight_loop_t *f) {
  f->plan->vertical_only ? sense_vertical(f, &f->truth) : sense(f, &f->truth);
  loop_pilot(f);
}

tick_t loop_look(flight_loop_t *f) {
  f->thoughts = (thoughts_t){.zc_m = (double)NAN, .ceiling_z_m = (double)NAN, .ratio = 1.0, .y = (double)NAN};
  if (f->pilot->tell) f->pilot->tell(f->pilot->state, &f->thoughts);
  if (f->plan->below_estimate) f->order_s = 0.0;
  f->ceiling_z_m = f->thoughts.ceiling_z_m;
  const tick_t tick = {
      .t_s = (double)f->tick * loop_tick_s(f),
      .setpoint_m = f->plan->way[f->way].setpoint_m,
      .body = &f->body,
      .truth = &f->truth,
      .in = &f->in,
      .estimate = &f->senses.estimate,
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

// Keeps what the next tick knows of this one.
void loop_moved(flight_loop_t *f, double rotors_N, double vbat_V, double gap_m) {
  for (int i = 0; i < PILOT_MOTORS; i++) f->in.applied_N[i] = f->body.command_N[i];
  f->in.rotors_N = rotors_N;
  f->in.vbat_V = vbat_V;
  f->gap_min_m = smaller(f->gap_min_m, gap_m);
}

static void move(flight_loop_t *f, double tick_s) {
  const plan_t *plan = f->plan;
  if (plan->vertical_noise.gust_mps2 > 0.0) {
    const double gust_mps2 = vertical_gust_mps2(&f->vertical, &plan->vertical_noise, f->random);
    body_push(&f->body, d3(0.0, 0.0, f->model->mass_kg * gust_mps2));
  }
  body_tick(&f->body, f->motor_N, tick_s);
  loop_moved(f, body_rotors_N(&f->body), f->body.vbat_V, body_gap_m(&f->body));
}

flight_over_t loop_tick_order(flight_loop_t *f) {
  const double tick_s = loop_tick_s(f), t_s = (double)f->tick * tick_s;
  const flight_over_t over = flight_over(f->plan, tick_s, f->tick, &f->body, f->motor_N);
  if (over != FLIGHT_FLIES) return over;
  f->ordered = order(f, t_s);
  if (f->body.rigid.held && t_s >= f->plan->held_s) body_hold(&f->body, false);
  return FLIGHT_FLIES;
}

void loop_see_truth(flight_loop_t *f) {
  take_truth(f, &f->truth);
  f->up_min = smaller(f->up_min, axes_up_b(&f->body.look.axes).z);
}

bool loop_is_sample(const flight_loop_t *f) {
  return f->tick % f->every == 0;
}

flight_over_t loop_tick(flight_loop_t *f, tick_t *seen, bool *is_sample) {
  *is_sample = false;
  const flight_over_t over = loop_tick_order(f);
  if (over != FLIGHT_FLIES) return over;
  loop_see_truth(f);
  const int calls = f->plan->vertical_only ? 1 : 2;
  for (int i = 0; i < calls; i++) call_pilot(f);
  *is_sample = loop_is_sample(f);
  if (*is_sample) *seen = loop_look(f);
  return FLIGHT_FLIES;
}

void loop_move(flight_loop_t *f) {
  move(f, loop_tick_s(f));
  f->tick++;
}

done_t loop_run(flight_loop_t *f, record_t *record, bool *finite, why_t *why) {
  flight_over_t over;
  tick_t seen;
  for (bool is_sample; (over = loop_tick(f, &seen, &is_sample)) == FLIGHT_FLIES; loop_move(f))
    if (is_sample) TRY(record_add(record, &seen, why));
  *finite = over != FLIGHT_NOT_FINITE;
  return DONE;
}
