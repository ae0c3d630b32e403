// watch.c - the guard's part of one call.
#include "flight/watch.h"

#include "flight/bounds.h"

// Constants: the name ends in the unit, if there is one. The comment behind gives the reason for the value,
// and the line above each group names the test that pins it.

// test: watch_takes_a_long_pause_for_a_short_one_and_time_that_runs_backwards_for_a_millisecond
#define MS_MAX 50 // a longer pause counts as this: what is known from before it is old
// test: watch_lets_loops_that_wait_for_more_than_three_calls_run_beside_the_inner_one_in_turn
#define WAIT_MAX 3 // calls: of two, one does not run the inner loop
// test: watch_counts_the_time_of_the_inner_loop_up_to_a_second
#define INNER_MS_MAX 1000 // no flight goes on after so long

static bool passes(unsigned from, unsigned ms, unsigned at) {
  const unsigned to = from + ms; // from < 10, so that at + 10 is beyond it
  return (at > from && at <= to) || at + 10 <= to;
}

// Returns the waiting loop that follows the one chosen here last, so that none waits for ever.
static unsigned next_of(flight_t *f, unsigned others) {
  const unsigned after = others & ~(2u * f->pressed - 1u),
                 from = f->pressed != 0 && after != 0 ? after : others;
  f->pressed = from & (0u - from);
  return f->pressed;
}

// Returns the loops that this call runs: only one, also after missed calls, because a call must not cost
// more. The others wait for a call without a loop; if none comes, each call runs the inner loop and one of
// them. The ground's curve is not urgent: it is left out if it would not be alone.
static unsigned one_of(flight_t *f, unsigned due) {
  f->waited = EITHER(f->waiting == 0, 0u, EITHER(f->waited < WAIT_MAX, f->waited + 1u, WAIT_MAX + 1u));
  due |= f->waiting;
  if (due != FLIGHT_GROUND) due &= ~(unsigned)FLIGHT_GROUND;
  const unsigned others = due & ~(unsigned)FLIGHT_INNER;
  unsigned now = due & FLIGHT_INNER   ? FLIGHT_INNER
                 : due & FLIGHT_OUTER ? FLIGHT_OUTER
                 : due & FLIGHT_LEARN ? FLIGHT_LEARN
                                      : due;
  if (f->waited > WAIT_MAX) now = (due & FLIGHT_INNER) | next_of(f, others);
  f->waiting = due & ~now;
  return now;
}

static unsigned due_after(unsigned phase, unsigned ms) {
  static const uint8_t next[10] = {
      [0] = FLIGHT_INNER,  [1] = FLIGHT_HEIGHT, [2] = FLIGHT_INNER, [3] = FLIGHT_LEARN, [4] = FLIGHT_INNER,
      [5] = FLIGHT_GROUND, [6] = FLIGHT_INNER,  [7] = FLIGHT_SCRUB, [8] = FLIGHT_INNER, [9] = FLIGHT_OUTER,
  };
  if (ms == 1) return next[phase]; // most calls by far
  return (passes(phase, ms, 10) ? FLIGHT_OUTER : 0u) | (passes(phase, ms, 4) ? FLIGHT_LEARN : 0u) |
         (passes(phase, ms, 2) ? FLIGHT_HEIGHT : 0u) | (passes(phase, ms, 8) ? FLIGHT_SCRUB : 0u) |
         FLIGHT_INNER; // the scrub is where no loop runs
}

// The ground's curve may not run while calls are missed, and its last result is for where the vehicle was.
static void lose_ground(flight_t *f) {
  outer_lose_ground(&f->outer);
  ground_rest(&f->ground);
}

bool watch_time(flight_t *f, uint32_t step) {
  if (!f->called) {
    f->called = true;
    f->phase = step % 10;
    f->inner_ms = 2;
    // The inner loop runs at once, because it gives the next command.
    f->due = FLIGHT_INNER;
    f->step_last = step - 1u;
  } else {
    const uint32_t since = step - f->step_last;
    if (f->phase > 9) f->phase = f->step_last % 10; // a flipped bit
    if (since != 1) f->guard.latched |= GUARD_TIME;
    if (since == 0) return false;
    const unsigned ms =
        EITHER(since <= MS_MAX, since, EITHER(since < 0x80000000u, MS_MAX, 1u)); // backwards: one
    f->due = one_of(f, due_after(f->phase, ms));
    if (ms != 1) lose_ground(f);
    const unsigned to = f->phase + ms;
    // The outer loop is told of periods that were skipped altogether.
    if (to >= 20) outer_miss(&f->outer, to / 10 - 1);
    f->phase = to % 10;
    f->inner_ms = EITHER(f->inner_ms < INNER_MS_MAX, f->inner_ms + (int)ms, INNER_MS_MAX);
    f->step_last = step - ms; // so that the guard can read the time
  }
  return true;
}

bool watch_setpoint_good(const flight_setpoint_t *sp) {
  if (!(fabsf(sp->roll_rad) <= BOUND_WANTED_ANGLE_RAD && fabsf(sp->pitch_rad) <= BOUND_WANTED_ANGLE_RAD))
    return false;
  if (!(fabsf(sp->yaw_rad) <= BOUND_WANTED_ANGLE_RAD && fabsf(sp->yaw_rate_radps) <= BOUND_WANTED_RATE_RADPS))
    return false;
  return fabsf(sp->thrust_N) <= BOUND_THRUST_N && v3_within(sp->pos_w_m, BOUND_POS_M) &&
         v3_within(sp->vel_mps, BOUND_VEL_MPS) && v3_within(sp->acc_w_mps2, BOUND_ACC_MPS2);
}

// Removes resets of the height estimate, which move neither the vehicle nor the ceiling.
static void take_jump_out(flight_t *f, flight_in_t *in, int ms) {
  const float z_m = in->pos_w_m.z;
  if (fabsf(z_m) <= BOUND_POS_M && fabsf(in->vel_w_mps.z) <= BOUND_VEL_MPS) {
    const float dz_m = z_m - f->height_m;
    const float most_m = BOUND_HEIGHT_JUMP_M + fabsf(in->vel_w_mps.z) * 0.001f * (float)(ms + 10);
    // A height_m beyond its bound is a flipped bit.
    const bool jumped = f->height_seen && fabsf(dz_m) > most_m && fabsf(f->height_m) <= BOUND_POS_M;
    FOR_WHOM(jumped, &f->height_off_m) {
      f->height_off_m = f_clamp(f->height_off_m + dz_m, -2.0f * BOUND_POS_M, 2.0f * BOUND_POS_M);
    }
    FOR_WHOM(jumped, &f->guard.latched) f->guard.latched |= GUARD_HEIGHT_JUMP;
    f->height_m = z_m;
    f->height_seen = true;
  }
  in->pos_w_m.z = z_m - f->height_off_m;
}

// Set field by field: zeroing the struct first takes a sixth of the millisecond's instructions.
static void see(guard_in_t *g, const flight_t *f, const flight_in_t *in, int ms, bool setpoint_good) {
  const outer_t *o = &f->outer;
  const float top_m = o->out.ceiling_z_m - f->outer.param.gap_min_m, asked_m = in->setpoint.pos_w_m.z;
  const float z_m = EITHER(asked_m > top_m, top_m, asked_m);
  g->ms = ms;
  g->wanted = in->setpoint.z != AXIS_OFF && !f->by_hand.held;
  g->carries = in->setpoint.z != AXIS_OFF && o->carrying_s > 0.0f;
  g->on_floor = outer_on_floor(o);
  g->rate_b_radps = in->rate_b_radps;
  g->acc_b_mps2 = in->acc_b_mps2;
  g->pos_w_m = in->pos_w_m;
  g->vel_w_mps = in->vel_w_mps;
  g->q_wb = in->q_wb;
  g->range_new = in->range_new;
  g->range_m = in->range_m;
  g->range_floor_m = f->outer.param.ceiling.floor_m;
  g->range_near_m = f->outer.param.ceiling.near_m;
  g->thrust_N = mixer_thrust_N(in->force_N);
  g->thrust_max_N = f->outer.param.pos.thrust_max_N;
  g->weight_N = f->outer.param.pos.mass_kg * GRAVITY_MPS2;
  g->zc_m = o->ceiling.zc_m;
  g->blind_s = o->ceiling.blind_s;
  g->ceiling_z_m = o->out.ceiling_z_m;
  g->zc_known = o->ceiling.known;
  g->setpoint_good = setpoint_good;
  g->height_off_m = f->height_off_m;
  g->find_bias = f->outer.param.bias.pole_radps > 0.0f;
  g->force_N = o->sample.force_N;
  g->thrust_now_N = o->sample.thrust_N;
  g->force_new = (f->due & FLIGHT_LEARN) != 0; // not in the outer loop's own call, which costs the most
  g->bias_known_mps2 = o->bias.bias_mps2.z;
  const bool by_height = in->setpoint.z == AXIS_POSITION;
  g->asked_z_m = EITHER(by_height, asked_m, NAN);
  g->setpoint_z_m = EITHER(by_height, z_m, NAN);
}

// Hands the settled bias over to the outer loop: if guard and outer loop each held a part of the
// accelerometer's bias, they would keep parts that cancel.
static void hand_bias_over(flight_t *f) {
  const float settled_mps2 = guard_settled_bias_mps2(&f->guard);
  if (ANY(settled_mps2 != 0.0f)) guard_give_bias(&f->guard, outer_take_bias(&f->outer, settled_mps2));
}

// Without an accelerometer, uses the acceleration by the thrust of the motors, plus the bias that the outer
// loop will subtract. Otherwise subtracts the guard's bias.
static void mend_acceleration(const flight_t *f, flight_in_t *in) {
  const guard_t *g = &f->guard;
  const bool lost = g->acc_lost && g->hover_N > 0.0f;
  FOR_WHOM(lost, &in->acc_b_mps2) {
    const v3_t model = {0.0f, 0.0f, GRAVITY_MPS2 * f->outer.sync.thrust.model_N / g->hover_N};
    in->acc_b_mps2 = v3_add(model, quat_to_body(quat_unit(in->q_wb), f->outer.bias.bias_mps2));
  }
  FOR_WHOM(!lost && g->acc_bias_mps2 != 0.0f, &in->acc_b_mps2) {
    const v3_t bias_b = quat_to_body(quat_unit(in->q_wb), (v3_t){0.0f, 0.0f, g->acc_bias_mps2});
    in->acc_b_mps2 = v3_sub(in->acc_b_mps2, bias_b);
  }
}

static void set_what_flies(const flight_t *f, flight_in_t *in) {
  const guard_t *g = &f->guard;
  flight_setpoint_t *const sp = &in->setpoint;
  FOR_WHOM(g->action == GUARD_RETREAT, sp) {
    sp->x = sp->y = sp->z = AXIS_POSITION;
    sp->pos_w_m = g->hold_w_m;
    sp->pos_w_m.z = guard_retreat_z_m(g, &f->outer.param.guard, in->pos_w_m.z, f->outer.out.ceiling_z_m,
                                      f->outer.param.pos.kp_z_per_s);
    sp->vel_mps = sp->acc_w_mps2 = (v3_t){0.0f, 0.0f, 0.0f};
  }
  FOR_WHOM(g->action == GUARD_HAND_OVER, sp) {
    *sp = (flight_setpoint_t){.yaw = YAW_RATE};
    sp->thrust_N = guard_thrust_N(g, &f->outer.param.guard, f->outer.param.pos.mass_kg * GRAVITY_MPS2);
  }
}

// Near a ceiling, turns a thrust by hand into a climb rate.
static APART void keep_out(flight_t *f, flight_in_t *in, int ms) {
  const flight_param_t *p = &f->outer.param;
  const by_hand_param_t param = {.kp_per_s = p->pos.kp_z_per_s,
                                 .gap_min_m = p->gap_min_m,
                                 .up_offset_m = p->up_offset_m,
                                 .floor_m = p->ceiling.floor_m,
                                 .weight_N = p->pos.mass_kg * GRAVITY_MPS2};
  const by_hand_in_t x = {.period_s = 0.001f * f_clamp((float)ms, 1.0f, (float)MS_MAX),
                          .thrust_N = in->setpoint.thrust_N,
                          .climb_mps = in->vel_w_mps.z,
                          .q_wb = in->q_wb,
                          .range_new = in->range_new,
                          .range_m = in->range_m,
                          .range_age_s = in->range_age_s};
  if (!by_hand_step(&f->by_hand, &param, &x, &in->setpoint.vel_mps.z)) return;
  in->setpoint.z = AXIS_VELOCITY;
  in->setpoint.acc_w_mps2.z = 0.0f;
}

void watch_inputs(flight_t *f, flight_in_t *in) {
  const int ms = (int)(in->step - f->step_last);
  f->step_last = in->step;
  const bool good = watch_setpoint_good(&in->setpoint);
  if (good)
    f->setpoint = in->setpoint;
  else
    in->setpoint = f->setpoint;
  if (in->setpoint.z == AXIS_OFF)
    keep_out(f, in, ms);
  else
    by_hand_init(&f->by_hand); // a ceiling seen by then is not known any more
  if (in->setpoint.z == AXIS_OFF) {
    f->height_off_m = 0.0f;
    f->height_seen = false;
    guard_rest(&f->guard);
  }
  take_jump_out(f, in, ms);
  guard_in_t guard_in;
  see(&guard_in, f, in, ms, good);
  guard_step(&f->guard, &f->outer.param.guard, &guard_in);
  hand_bias_over(f);
  FOR_WHOM(f->guard.vel_lost, &in->vel_w_mps) in->vel_w_mps = f->guard.vel_w_mps;
  mend_acceleration(f, in);
  in->range_m = EITHER(in->range_m < CEILING_RANGE_MIN_M, 0.0f, in->range_m); // "no sample"
  set_what_flies(f, in);
}
