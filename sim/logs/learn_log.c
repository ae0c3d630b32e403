// learn_log.c - the flight code's own learner over recorded flights.
#include "logs/learn_log.h"

#include "flight/ceiling.h"
#include "flight/curve.h"
#include "flight/sync.h"
#include "logs/flight_log.h"
#include <math.h>

static const signals_t NEED = SIGNAL_BIT(SIG_Z) | SIGNAL_BIT(SIG_AX) | SIGNAL_BIT(SIG_AY) |
                              SIGNAL_BIT(SIG_AZ) | SIGNAL_BIT(SIG_QW) | SIGNAL_BIT(SIG_QX) |
                              SIGNAL_BIT(SIG_QY) | SIGNAL_BIT(SIG_QZ) | SIGNAL_BIT(SIG_THRUST);

typedef struct {
  const learn_job_t *job;
  flight_log_t *log;
  sync_coef_t coef;
  sync_t sync;
  ceiling_t ceiling;
  float height_last_m;
} pass_t;

// What one tick shows, all through the same filter.
typedef struct {
  learn_sample_t sample; // as the learner sees it
  float lift_N;          // vertical share of the thrust in free air
  float force_up_N;      // mass times vertical specific force
  bool far;              // beyond LEARN_FAR_M, or nothing in sight
} view_t;

void learn_job_init(learn_job_t *job, const model_t *vehicle, int surface) {
  *job = (learn_job_t){.vehicle = *vehicle, .surface = surface, .columns = columns_crazyflie()};
  params_default(&job->param);
  job->param.cutoff_Hz = LEARN_CUTOFF_HZ;
  job->param.motor_tau_s = (float)vehicle->motor_tau_s;
  job->param.pos.mass_kg = job->stands_mass_kg = (float)vehicle->mass_kg;
  // No random walk: it forgets within ten seconds what it does not see, but weights that are typed in must
  // fit all flights alike.
  job->param.learn.rls.q = 0.0f;
  // The shipped start weights are a ceiling's.
  if (surface == SURFACE_GROUND) job->param.curve.fixed = (rbf_weights_t){.w = {1.0f}};
}

static v3_t v3_of(const double *v) {
  return (v3_t){(float)v[0], (float)v[1], (float)v[2]};
}

static void start(pass_t *p, const sync_in_t *in, const flight_tick_t *tick) {
  sync_start(&p->sync, in);
  ceiling_init(&p->ceiling, (float)FLIGHT_LOG_PERIOD_S);
  p->height_last_m = (float)tick->v[SIG_Z];
}

// The ceiling from the range sensor, or from the vehicle file; or the ground from the height. False: not
// known.
static bool find_surface(pass_t *p, const flight_tick_t *tick, float up, float *zc_m) {
  const learn_job_t *job = p->job;
  if (job->surface == SURFACE_GROUND) {
    *zc_m = (float)(tick->v[SIG_Z] - job->rest_height_m);
    return true;
  }
  if (!flight_log_has(p->log, SIG_RANGE)) {
    *zc_m = (float)(job->vehicle.ceiling_m - tick->v[SIG_Z]);
    return true;
  }
  const ceiling_param_t *param = &job->param.ceiling;
  const float z_m = (float)tick->v[SIG_Z];
  ceiling_predict(&p->ceiling, param, z_m - p->height_last_m);
  p->height_last_m = z_m;
  // A sample that is no distance leaves the estimate as it is, here as in flight.
  if (tick->range_new) (void)!ceiling_correct(&p->ceiling, param, (float)tick->v[SIG_RANGE] * up, 0.0f);
  *zc_m = p->ceiling.zc_m;
  return p->ceiling.known;
}

static void look_at_surface(pass_t *p, const flight_tick_t *tick, float up, view_t *view) {
  float zc_m;
  const bool in_sight = find_surface(p, tick, up, &zc_m);
  view->far = !in_sight || zc_m >= LEARN_FAR_M;
  view->sample.zc_m = sync_distance_m(&p->sync, &p->coef, in_sight, in_sight ? zc_m : 0.0f);
  view->sample.blind_s = p->ceiling.blind_s;
  // Contact is judged by the raw distance too: the filtered one comes to the ground late.
  view->sample.known = in_sight && zc_m >= p->job->param.learn.near_m;
}

// True if the vehicle is far from the surface but its rotors do not carry it: it stands on something. Not
// judged by param.pos.mass_kg: with a mass set by hand it could seem to stand all the time.
static bool stands(const learn_job_t *job, const view_t *view) {
  const float force_N = view->sample.force_N / job->param.pos.mass_kg * job->stands_mass_kg;
  return view->far && force_N > LEARN_STANDS_RATIO * view->sample.thrust_N;
}

static view_t look(pass_t *p, const flight_tick_t *tick) {
  const double *const q = &tick->v[SIG_QW];
  const sync_in_t in = {
      .acc_b_mps2 = v3_of(&tick->v[SIG_AX]),
      .q_wb = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]},
      .thrust_N = (float)tick->applied_N,
      .at_limit = tick->at_limit,
  };
  if (tick->split) start(p, &in, tick);
  const float mass_kg = p->job->param.pos.mass_kg;
  sync_out_t x;
  sync_step(&p->sync, &p->coef, &in, &x);
  view_t view = {
      .sample = learn_sample(&p->sync, &x, mass_kg),
      .lift_N = x.thrust_N * x.up_w.z,
      .force_up_N = mass_kg * (x.acc_w_mps2.z + GRAVITY_MPS2),
  };
  look_at_surface(p, tick, quat_up(p->sync.att_last).z, &view);
  if (stands(p->job, &view)) view.sample.known = view.far = false;
  return view;
}

static done_t pass_open(pass_t *p, const learn_job_t *job, const char *path, why_t *why) {
  *p = (pass_t){.job = job};
  const flight_param_t *param = &job->param;
  if (sync_tune(&p->coef, param->cutoff_Hz, param->motor_tau_s, (float)FLIGHT_LOG_PERIOD_S) != ST_OK)
    return error_set(why, "indiPos.cutoff = %g: out of range", (double)job->param.cutoff_Hz);
  TRY(flight_log_open(&p->log, path, &job->columns, &job->vehicle, NEED, why));
  const bool blind = !flight_log_has(p->log, SIG_RANGE) && !isfinite(job->vehicle.ceiling_m);
  if (job->surface != SURFACE_CEILING || !blind) return DONE;
  flight_log_close(p->log);
  const char *range = job->columns.of[SIG_RANGE].column;
  return error_set(why,
                   "%s:1: column %s: missing; --surface ceiling needs the upward range sensor, or a vehicle "
                   "with ceiling_m",
                   path, range[0] ? range : "for the signal `range`");
}

// Goes over a flight and hands every tick to `take`.
static done_t each(const learn_job_t *job, const char *path,
                   void (*take)(const learn_job_t *, const view_t *, void *), void *into, learn_bad_t *bad,
                   why_t *why) {
  pass_t p;
  TRY(pass_open(&p, job, path, why));
  done_t status;
  flight_tick_t tick;
  bool more;
  while ((status = flight_log_next(p.log, &tick, &more, why)) == DONE && more) {
    const view_t view = look(&p, &tick);
    take(job, &view, into);
  }
  if (status == DONE && flight_log_count(p.log).ticks == 0)
    status = error_set(why, "%s: no row has all the signals that are needed", path);
  if (bad) bad->n = flight_log_bad(p.log, &bad->first);
  flight_log_close(p.log);
  return status;
}

static void add_mass(const learn_job_t *job, const view_t *view, void *into) {
  learn_mass_t *const sum = into;
  const learn_sample_t *const x = &view->sample;
  if (!view->far || x->up < job->param.learn.up_min || x->since_limit_s < job->param.learn.settle_s) return;
  sum->thrust_N += (double)x->thrust_N;
  sum->force_mps2 += (double)(x->force_N / job->param.pos.mass_kg);
  sum->n++;
}

done_t learn_log_mass(const learn_job_t *job, const char *path, learn_mass_t *sum, learn_bad_t *bad,
                      why_t *why) {
  return each(job, path, add_mass, sum, bad, why);
}

double learn_mass_kg(const learn_mass_t *sum) {
  return sum->n >= LEARN_MASS_TICKS_MIN ? sum->thrust_N / sum->force_mps2 : (double)NAN;
}

static void teach(const learn_job_t *job, const view_t *view, void *into) {
  // The learner counts samples that may not teach; nothing else can fail with checked parameters.
  learn_t *const learn = into;
  if (learn_update(learn, &job->param.learn, &view->sample, 0.0f) != ST_OK || !job->points) return;
  fprintf(job->points, "%.5f,%.5f\n", (double)view->sample.zc_m, (double)learn->y);
}

done_t learn_log_teach(const learn_job_t *job, const char *path, learn_t *learn, why_t *why) {
  return each(job, path, teach, learn, NULL, why);
}

// Running mean and sum of squared deviations (Welford), and sums over the near ticks.
typedef struct {
  curve_param_t curve;
  double mean_before, mean_after, square_before, square_after, near_before, near_after, nearest_m;
  long n, near;
} residual_t;

static void add(double x, long n, double *mean, double *square) {
  const double step = x - *mean;
  *mean += step / (double)n;
  *square += step * (x - *mean);
}

static void add_residual(const learn_job_t *job, const view_t *view, void *into) {
  residual_t *const r = into;
  const float zc_m = view->sample.zc_m;
  if (!view->sample.known || zc_m < job->param.learn.near_m) return;
  const float ratio = curve_at(&r->curve, &r->curve.fixed, true, zc_m).ratio;
  const double before_N = (double)(view->force_up_N - view->lift_N);
  const double after_N = (double)(view->force_up_N - ratio * view->lift_N);
  r->n++;
  add(before_N, r->n, &r->mean_before, &r->square_before);
  add(after_N, r->n, &r->mean_after, &r->square_after);
  if (r->n == 1 || (double)zc_m < r->nearest_m) r->nearest_m = (double)zc_m;
  if (zc_m >= LEARN_NEAR_M) return;
  r->near++;
  r->near_before += before_N * before_N;
  r->near_after += after_N * after_N;
}

done_t learn_log_score(const learn_job_t *job, const char *path, const rbf_weights_t *curve,
                       learn_score_t *score, learn_bad_t *bad, why_t *why) {
  // The curve as it flies (1 beyond ceil.zOn), but not clipped: the clip is for control.
  residual_t r = {.curve = job->param.curve};
  r.curve.mode = CURVE_FIXED;
  r.curve.clip = 0;
  r.curve.fixed = *curve;
  TRY(each(job, path, add_residual, &r, bad, why));
  if (r.n == 0) return error_set(why, "%s: the surface is never in sight", path);
  const double n = (double)r.n, near = (double)r.near;
  *score = (learn_score_t){
      .ticks = r.n,
      .near = r.near,
      .all_before_N = sqrt(r.square_before / n),
      .all_after_N = sqrt(r.square_after / n),
      .near_before_N = sqrt(r.near_before / near), // 0/0 is NaN
      .near_after_N = sqrt(r.near_after / near),
      .bias_N = r.mean_after,
      .nearest_m = r.nearest_m,
  };
  return DONE;
}
