// loop.c - one flight.
#include "flight/loop.h"

#include "base/cpu_time.h"
#include "body/world.h"
#include "sense/kalman_z.h"
#include <math.h>

#define RECORD_PERIOD_S  0.01
#define DOWN_PERIOD_S    0.02 // downward range sensor
#define UP_PERIOD_S      0.1  // upward range sensor
#define KALMAN_ACC_MPS2  0.5  // what the estimator expects of the accelerometer
#define INTEGRATE_STEP_S 0.002

typedef struct {
  const plan_t *plan;
  const controller_t *controller;
  world_t world;
  random_t *random;
  kalman_z_t kalman;
  sense_t sense;
  thoughts_t thoughts;
  double gust_mps2, gap_min_m;
  int way;
} flight_loop_t;

// Every how many ticks something of that period happens; at least every tick.
static long ticks_of(double period_s, double tick_s) {
  return lround(fmax(1.0, period_s / tick_s));
}

static void measure(flight_loop_t *f, long tick) {
  const noise_t *noise = &f->plan->noise;
  const double dt = f->controller->period_s;
  const double true_acc = world_acc_mps2(&f->world), true_z = f->world.y[VERTICAL_Z_M];
  f->sense.acc_mps2 = true_acc;
  if (noise->acc_mps2 > 0.0) f->sense.acc_mps2 += noise->acc_mps2 * random_normal(f->random);
  if (noise->down_m > 0.0) {
    if (tick > 0) kalman_z_predict(&f->kalman, f->sense.acc_mps2, dt);
    if (tick % ticks_of(DOWN_PERIOD_S, dt) == 0)
      kalman_z_correct(&f->kalman, true_z + noise->down_m * random_normal(f->random));
    f->sense.z_m = f->kalman.z_m;
    f->sense.climb_mps = f->kalman.climb_mps;
  } else {
    f->sense.z_m = true_z;
    f->sense.climb_mps = f->world.y[VERTICAL_CLIMB_MPS];
  }
  f->sense.range_new = tick % ticks_of(UP_PERIOD_S, dt) == 0;
  if (f->sense.range_new) f->sense.range_m = sensors_up_m(noise, f->random, world_ceiling_gap_m(&f->world));
  f->sense.motor_N = f->world.y[VERTICAL_THRUST_N];
}

static done_t keep(flight_loop_t *f, record_t *record, double t_s, double command_N) {
  const world_t *w = &f->world;
  const double gap_m = world_ceiling_gap_m(w);
  const sample_t sample = {
      .t_s = t_s,
      .setpoint_m = f->sense.setpoint_m,
      .z_m = w->y[VERTICAL_Z_M],
      .climb_mps = w->y[VERTICAL_CLIMB_MPS],
      .acc_mps2 = world_acc_mps2(w),
      .gap_m = gap_m,
      .gap_min_m = fmin(f->gap_min_m, gap_m),
      .thrust_N = w->y[VERTICAL_THRUST_N],
      .command_N = command_N,
      .ratio = world_thrust_ratio(w),
      .contacts = w->contacts,
      .touching = w->vehicle.contact == CONTACT_CEILING,
      .sense = f->sense,
      .thoughts = f->thoughts,
  };
  f->gap_min_m = HUGE_VAL;
  return record_add(record, &sample);
}

static done_t run(flight_loop_t *f, record_t *record, outcome_t *outcome) {
  const plan_t *plan = f->plan;
  const double dt = f->controller->period_s;
  const long ticks = lround(plan->end_s / dt), record_every = ticks_of(RECORD_PERIOD_S, dt);
  for (long tick = 0; tick <= ticks && outcome->finite; tick++) {
    const double t_s = (double)tick * dt;
    while (f->way + 1 < plan->n_way && t_s >= plan->way[f->way + 1].at_s - 1e-9) f->way++;
    f->sense.setpoint_m = plan->way[f->way].setpoint_m;
    measure(f, tick);
    const double command_N = f->controller->step(f->controller->state, &f->sense, &f->thoughts);
    if (tick % record_every == 0) TRY(keep(f, record, t_s, command_N));
    outcome->finite = isfinite(command_N) && isfinite(f->world.y[VERTICAL_Z_M]) && !f->world.broken;
    f->gust_mps2 = sensors_gust(&plan->noise, f->random, f->gust_mps2, dt);
    f->sense.applied_N = world_tick(&f->world, command_N, f->world.model->mass_kg * f->gust_mps2, dt);
    f->gap_min_m = fmin(f->gap_min_m, world_ceiling_gap_m(&f->world));
  }
  return DONE;
}

done_t loop_fly(const plan_t *plan, const model_t *model, const controller_t *controller, record_t *record,
                outcome_t *outcome, why_t *why) {
  flight_loop_t f = {.plan = plan, .controller = controller, .gap_min_m = HUGE_VAL};
  f.sense.applied_N = plan->start_thrust_N;
  f.thoughts = (thoughts_t){.zc_m = (double)NAN, .ceiling_z_m = (double)NAN, .ratio = 1.0, .y = (double)NAN};
  *outcome = (outcome_t){.finite = true};
  const double start_s = cpu_time_s();
  kalman_z_init(&f.kalman, KALMAN_ACC_MPS2, fmax(plan->noise.down_m, 1e-4), controller->period_s,
                (int)ticks_of(DOWN_PERIOD_S, controller->period_s), plan->start_z_m);
  f.random = random_open(plan->seed);
  done_t status = f.random ? DONE : FAILED;
  if (status == DONE)
    status =
        world_open(&f.world, model, plan->integrate, plan->step_s > 0.0 ? plan->step_s : INTEGRATE_STEP_S,
                   plan->start_z_m, plan->start_thrust_N);
  if (status == DONE) status = run(&f, record, outcome);
  outcome->contacts = f.world.contacts;
  outcome->realtime_factor = cpu_time_factor(plan->end_s, start_s);
  if (f.world.integrate) world_close(&f.world);
  random_close(f.random);
  return status == DONE ? DONE : error_failed(why, "the flight could not be run: out of memory");
}
