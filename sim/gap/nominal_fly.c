// nominal_fly.c - the model in closed loop along a log's track.
#include "gap/nominal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define STEP_S   0.002
#define LEVEL    2.0 // 1/s: position errors to velocity, level
#define PUSH     3.0 // 1/s: velocity errors to acceleration, level
#define TILT_MAX 0.5
#define YAW      2.0
#define LOST_M   3.0 // so far off its track the vehicle is lost

// Disturbing force and moment. Not in the table: a part of the nominal flight, not of the model.
static void tick(const fx_use_t *use, const fx_tick_t *t, fx_plant_t *plant) {
  const double *p = use->p;
  double *const m = t->memory;
  for (int i = 0; i < 6; i++) {
    const double keep = m[6] > 0.0 ? exp(-t->span_s / p[i < 3 ? 6 : 7]) : 0.0;
    m[i] = keep * m[i] + p[i] * sqrt(1.0 - keep * keep) * random_normal(t->random);
  }
  m[6] = 1.0;
  plant->force_w_N = d3_add(plant->force_w_N, d3_of(m));
  plant->moment_b_Nm = d3_add(plant->moment_b_Nm, d3_of(m + 3));
}

static const fx_t disturb = {.name = "disturbance", .n_param = FX_PARAM_MAX, .tick = tick};

static status_t disturbed(const model_t *m, const manner_t *w, model_t *out, why_t *why) {
  fx_use_t use = {.fx = &disturb};
  for (int i = 0; i < 3; i++) {
    use.p[i] = m->mass_kg * w->force_mps2[i];
    use.p[3 + i] = m->frame.inertia_kgm2[i] * w->turn_radps2[i];
  }
  use.p[6] = w->force_tau_s;
  use.p[7] = w->turn_tau_s;
  *out = *m;
  return model_add_fx(out, &use, why);
}

typedef struct {
  const grid_t *g;
  const model_t *m;
  const manner_t *w;
  body_t body;
  random_t *random;
  gap_flight_t *log;
  int from, to, at; // points of the track
  double lift_trim; // thrust over weight that holds it
} flight_t6;

// --- the pilot
// ----------------------------------------------------------------------------------------------------

static d3_t wanted_acc(const flight_t6 *f, const point_t *track, const point_t *seen) {
  const d3_t off = d3_sub(track->pos_w_m, seen->pos_w_m), slip = d3_sub(track->vel_w_mps, seen->vel_w_mps);
  const manner_t *w = f->w;
  const bool place = f->g->has_position;
  const double x = place ? LEVEL * PUSH * off.x : 0.0, y = place ? LEVEL * PUSH * off.y : 0.0;
  return d3(fmax(-6.0, fmin(6.0, x + PUSH * slip.x)), fmax(-6.0, fmin(6.0, y + PUSH * slip.y)),
            fmax(-5.0, fmin(5.0, w->height_gain * off.z + w->climb_gain * slip.z)));
}

static void mix(const model_t *m, double lift_N, d3_t turn_radps2, double motor_N[ROTORS]) {
  const frame_t *f = &m->frame;
  const double roll = turn_radps2.x * f->inertia_kgm2[0], pitch = turn_radps2.y * f->inertia_kgm2[1];
  const double yaw = turn_radps2.z * f->inertia_kgm2[2];
  for (int k = 0; k < ROTORS; k++) {
    const double x = f->rotor_x_m[k], y = f->rotor_y_m[k];
    const double turn = f->torque_ratio_m > 0.0 ? -f->rotor_spin[k] * yaw / (4.0 * f->torque_ratio_m) : 0.0;
    motor_N[k] = 0.25 * lift_N + 0.25 * roll / y - 0.25 * pitch / x + turn;
  }
}

static void steer(const flight_t6 *f, const point_t *track, const point_t *seen, double motor_N[ROTORS]) {
  const manner_t *w = f->w;
  const axes_t axes = axes_of(seen->q_wb), track_axes = axes_of(track->q_wb);
  const d3_t acc = d3_add(wanted_acc(f, track, seen), d3(0.0, 0.0, PLANT_GRAVITY_MPS2));
  const d3_t pull_b = axes_to_body(&axes, d3_scale(1.0 / d3_norm(acc), acc));
  const double roll = fmax(-TILT_MAX, fmin(TILT_MAX, -pull_b.y)),
               pitch = fmax(-TILT_MAX, fmin(TILT_MAX, pull_b.x));
  const d3_t nose_b = axes_to_body(&axes, track_axes.x);
  const double yaw = atan2(nose_b.y, nose_b.x);
  const d3_t rate = seen->rate_b_radps;
  const d3_t turn =
      d3(w->tilt_gain * roll - w->rate_gain[0] * rate.x, w->tilt_gain * pitch - w->rate_gain[1] * rate.y,
         w->rate_gain[2] * (YAW * yaw - rate.z));
  const double up = fmax(axes_up_b(&axes).z, 0.5);
  mix(f->m, f->m->mass_kg * acc.z / up, turn, motor_N);
}

// --- sensors
// ------------------------------------------------------------------------------------------------------

static double noisy(const flight_t6 *f, double v, double sd) {
  return v + sd * random_normal(f->random);
}
static d3_t noisy3(const flight_t6 *f, d3_t v, double sd) {
  return d3(noisy(f, v.x, sd), noisy(f, v.y, sd), noisy(f, v.z, sd));
}

static point_t see(const flight_t6 *f) {
  const body_t *b = &f->body;
  const manner_t *w = f->w;
  const dq_t wrong = dq_unit((dq_t){1.0, noisy(f, 0.0, 0.5 * w->angle_rad), noisy(f, 0.0, 0.5 * w->angle_rad),
                                    noisy(f, 0.0, 0.5 * w->angle_rad)});
  return (point_t){.pos_w_m = noisy3(f, d3_of(b->y + RIGID_POS_M), w->pos_m),
                   .vel_w_mps = noisy3(f, d3_of(b->y + RIGID_VEL_MPS), w->vel_mps),
                   .q_wb = dq_mul(dq_of(b->y + RIGID_Q_WB), wrong),
                   .rate_b_radps = noisy3(f, d3_of(b->y + RIGID_RATE_RADPS), w->gyro_radps),
                   .acc_b_mps2 = noisy3(f, body_specific_force_b_mps2(b), w->acc_mps2),
                   .vbat_V = f->g->point[f->at].vbat_V};
}

static void put3(const gap_flight_t *log, int signal, int i, d3_t v) {
  const double x[3] = {v.x, v.y, v.z};
  for (int k = 0; k < 3; k++)
    if (log->v[signal + k]) log->v[signal + k][i] = x[k];
}

static double range_seen(const flight_t6 *f) {
  const body_t *b = &f->body;
  const axes_t axes = axes_of(dq_of(b->y + RIGID_Q_WB));
  const double up = fmax(axes_up_b(&axes).z, 0.1), z = b->y[RIGID_POS_M + 2];
  const double far_m = f->g->range_up ? f->m->ceiling_m - z - body_rotor_z_m(f->m) : z - body_rest_z_m(f->m);
  return noisy(f, far_m / up, f->w->range_m);
}

static void write(const flight_t6 *f, const point_t *p, const double motor_N[ROTORS], double t_s) {
  gap_flight_t *const log = f->log;
  const int i = log->n++;
  log->t_s[i] = t_s;
  put3(log, SIG_X, i, d3_add(p->pos_w_m, d3(0.0, 0.0, -body_rest_z_m(f->m))));
  put3(log, SIG_VX, i, p->vel_w_mps);
  put3(log, SIG_AX, i, p->acc_b_mps2);
  put3(log, SIG_GX, i, p->rate_b_radps);
  put3(log, SIG_QX, i, d3(p->q_wb.x, p->q_wb.y, p->q_wb.z));
  if (log->v[SIG_QW]) log->v[SIG_QW][i] = p->q_wb.w;
  if (log->v[SIG_VBAT]) log->v[SIG_VBAT][i] = p->vbat_V;
  double sum_N = 0.0;
  for (int k = 0; k < ROTORS; k++) {
    if (log->v[SIG_M1 + k]) log->v[SIG_M1 + k][i] = motor_N[k];
    sum_N += motor_N[k];
  }
  if (log->v[SIG_THRUST]) log->v[SIG_THRUST][i] = sum_N;
  double *const range = log->range_up_m ? log->range_up_m : log->range_down_m;
  if (range) range[i] = isfinite(f->g->point[f->at].range_m) ? range_seen(f) : (double)NAN;
}

// --- the flight
// ---------------------------------------------------------------------------------------------------

static double *column(size_t n) {
  return malloc(n * sizeof(double));
}

// The signals that the log has. Motors are newton.
static bool log_room(gap_flight_t *log, const grid_t *g, size_t n) {
  const gap_flight_t *like = g->flight;
  *log = (gap_flight_t){.motors_N = true};
  bool good = (log->t_s = column(n)) != NULL;
  for (int i = SIG_X; i <= SIG_VBAT; i++)
    if (like->v[i] || (i >= SIG_M1 && i <= SIG_M4 && g->has_moments)) good = (log->v[i] = column(n)) && good;
  if (g->range_up)
    good = (log->range_up_m = log->v[SIG_RANGE] = column(n)) && good;
  else if (like->range_down_m)
    good = (log->range_down_m = log->v[SIG_RANGE_DOWN] = column(n)) && good;
  snprintf(log->name, sizeof log->name, "nominal flight");
  return good;
}

static status_t fly(flight_t6 *f, why_t *why) {
  const double log_s = f->g->period_s / f->g->every;
  const int inner = (int)fmax(1.0, round(log_s / STEP_S)), per_point = f->g->every;
  const double step_s = log_s / inner, start_s = f->g->point[f->from].t_s;
  double motor_N[ROTORS];
  for (f->at = f->from; f->at < f->to; f->at++)
    for (int i = 0; i < per_point; i++) {
      const double t_s = start_s + ((f->at - f->from) * per_point + i) * log_s;
      for (int k = 0; k < inner; k++) {
        const point_t seen = see(f);
        steer(f, &f->g->point[f->at], &seen, motor_N);
        for (int r = 0; r < ROTORS; r++)
          motor_N[r] = fmax(0.0, fmin(motor_N[r], f->m->thrust_max_N / ROTORS));
        if (k == 0) write(f, &seen, motor_N, t_s);
        body_tick(&f->body, motor_N, step_s);
      }
      const d3_t off = d3_sub(d3_of(f->body.y + RIGID_POS_M), f->g->point[f->at].pos_w_m);
      if (f->body.broken || (f->g->has_position && d3_norm(off) > LOST_M))
        return error_failed(why, "%s: the model cannot fly along this track", f->g->flight->name);
    }
  f->log->rate_Hz = 1.0 / log_s;
  return ST_OK;
}

static status_t take_off(flight_t6 *f, const model_t *m, unsigned long seed, why_t *why) {
  const point_t *p = &f->g->point[f->from];
  body_start_t start = {.pos_w_m = p->pos_w_m, .vel_w_mps = p->vel_w_mps, .q_wb = p->q_wb, .seed = seed};
  for (int k = 0; k < ROTORS; k++) start.thrust_N[k] = 0.25 * m->mass_kg * PLANT_GRAVITY_MPS2;
  // Motors faster than the step need a finer one.
  if (body_open(&f->body, m, INTEGRATE_RK4, fmin(STEP_S, 0.5 * m->motor_tau_s), &start) != ST_OK)
    return error_failed(why, "%s: a model that cannot be flown", m->name);
  f->random = random_open(seed + 1);
  return f->random ? ST_OK : error_failed(why, "out of memory");
}

status_t nominal_fly(const grid_t *g, const model_t *m, const manner_t *w, unsigned long seed,
                     gap_flight_t *flight, why_t *why) {
  flight_t6 f = {.g = g, .m = m, .w = w, .log = flight, .to = g->n};
  model_t with;
  *flight = (gap_flight_t){.n = 0};
  TRY(disturbed(m, w, &with, why));
  while (f.from < g->n && !g->point[f.from].ok) f.from++;
  while (f.to > f.from && !g->point[f.to - 1].ok) f.to--;
  if (f.to <= f.from) return error_failed(why, "%s: it does not fly", g->flight->name);
  if (!log_room(flight, g, (size_t)(f.to - f.from + 1) * (size_t)g->every))
    return error_failed(why, "out of memory");
  status_t status = take_off(&f, &with, seed, why);
  if (status == ST_OK) status = fly(&f, why);
  if (f.body.integrate) body_close(&f.body);
  random_close(f.random);
  if (status != ST_OK) gap_flight_free(flight);
  return status;
}
