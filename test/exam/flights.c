// flights.c - flights for an exam.
#include "exam/flights.h"

#include "body/body.h"
#include "crazyflie/stock_pid.h"
#include "exam/plan.h"
#include "pilots/param_spec.h"
#include "pilots/pilot_flight.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ACC_SD    0.5 // m/s2, white at 500 Hz
#define GYRO_SD   0.02
#define TURB_SD   0.06
#define TURB_TAU  0.3
#define ANGLE_SD  (0.3 * 3.14159265 / 180.0)
#define VEL_SD    0.03
#define POS_SD    0.008
#define VBAT_SD   0.015
#define TOF_SD    0.006
#define TOF_FLOOR 0.045
#define LOST_M    1.5 // distance from its track
#define DOWN_S    1.0 // total time on the floor

done_t exam_vehicle(model_t *m, why_t *why) {
  TRY(model_builtin("cf21_legacy", m, why));
  m->n_fx = 0;
  m->ceiling_m = EXAM_CEILING_M;
  return DONE;
}

// --- sensors ----------------------------------------------------------------------------------------------

typedef struct {
  body_t body;
  model_t model; // the truth, with turbulence
  random_t *random;
  double slow[10]; // errors of the estimates: position 3, velocity 3, attitude 3
  double tof_m;
} exam_t;

static double normal(const exam_t *e, double sd) {
  return sd * random_normal(e->random);
}
// Drawn one after the other, because a compiler may draw a call's arguments in any order.
static d3_t normal3(const exam_t *e, double sd) {
  d3_t n;
  n.z = normal(e, sd);
  n.y = normal(e, sd);
  n.x = normal(e, sd);
  return n;
}

// Errors of the estimates last for some 30 ms (first-order Gauss-Markov).
static void drift(exam_t *e) {
  const double keep = exp(-EXAM_TICK_S / 0.03), fresh = sqrt(1.0 - keep * keep);
  for (int i = 0; i < 9; i++)
    e->slow[i] = keep * e->slow[i] + normal(e, fresh * (i < 3 ? POS_SD : i < 6 ? VEL_SD : ANGLE_SD));
}

static pilot_in_t measure(exam_t *e, const pilot_in_t *before) {
  pilot_in_t in = *before;
  const double *y = e->body.y;
  fx_sensed_t sensed = {.acc_b_mps2 = body_specific_force_b_mps2(&e->body)};
  model_sense(&e->model, &sensed);
  in.gyro_b_radps = d3_add(d3_of(y + RIGID_RATE_RADPS), normal3(e, GYRO_SD));
  in.acc_b_mps2 = d3_add(sensed.acc_b_mps2, normal3(e, ACC_SD));
  in.pos_w_m = d3_add(d3_of(y + RIGID_POS_M), d3_of(e->slow));
  in.vel_w_mps = d3_add(d3_of(y + RIGID_VEL_MPS), d3_of(e->slow + 3));
  const dq_t wrong = dq_unit((dq_t){1.0, 0.5 * e->slow[6], 0.5 * e->slow[7], 0.5 * e->slow[8]});
  in.q_wb = dq_mul(dq_of(y + RIGID_Q_WB), wrong);
  in.vbat_V = e->body.vbat_V + normal(e, VBAT_SD);
  return in;
}

static double range_up(exam_t *e) {
  const double *y = e->body.y;
  const axes_t axes = axes_of(dq_of(y + RIGID_Q_WB));
  const double up = fmax(axes_up_b(&axes).z, 0.1);
  fx_sensed_t s = {.range_m = (e->model.ceiling_m - y[RIGID_POS_M + 2] - body_rotor_z_m(&e->model)) / up,
                   .range_rate_mps = -y[RIGID_VEL_MPS + 2] / up};
  model_sense(&e->model, &s);
  return fmax(s.range_m + normal(e, TOF_SD), TOF_FLOOR);
}

// --- the log ----------------------------------------------------------------------------------------------

static const signal_id_t LOGGED[] = {SIG_X,  SIG_Y,  SIG_Z,  SIG_VX, SIG_VY, SIG_VZ, SIG_AX,
                                     SIG_AY, SIG_AZ, SIG_QW, SIG_QX, SIG_QY, SIG_QZ, SIG_GX,
                                     SIG_GY, SIG_GZ, SIG_M1, SIG_M2, SIG_M3, SIG_M4, SIG_VBAT};
static const signal_id_t TOLD[] = {SIG_SET_X,  SIG_SET_Y,  SIG_SET_Z,  SIG_SET_VX,
                                   SIG_SET_VY, SIG_SET_VZ, SIG_SET_YAW};
#define N_TOLD (sizeof TOLD / sizeof *TOLD)

static bool log_room(gap_flight_t *f, size_t n, bool told) {
  *f = (gap_flight_t){.motors_N = true, .rate_Hz = 1.0 / EXAM_TICK_S};
  bool good = (f->t_s = malloc(n * sizeof(double))) != NULL;
  good = (f->v[SIG_RANGE] = malloc(n * sizeof(double))) && good;
  for (unsigned i = 0; i < sizeof LOGGED / sizeof *LOGGED; i++)
    good = (f->v[LOGGED[i]] = malloc(n * sizeof(double))) && good;
  for (unsigned i = 0; told && i < N_TOLD; i++) good = (f->v[TOLD[i]] = malloc(n * sizeof(double))) && good;
  snprintf(f->name, sizeof f->name, "exam");
  return good;
}

static void write(gap_flight_t *f, const exam_t *e, const pilot_in_t *in, const double motor_N[4], double t_s,
                  double range_m) {
  const int i = f->n++;
  const double values[] = {in->pos_w_m.x,      in->pos_w_m.y,      in->pos_w_m.z - body_rest_z_m(&e->model),
                           in->vel_w_mps.x,    in->vel_w_mps.y,    in->vel_w_mps.z,
                           in->acc_b_mps2.x,   in->acc_b_mps2.y,   in->acc_b_mps2.z,
                           in->q_wb.w,         in->q_wb.x,         in->q_wb.y,
                           in->q_wb.z,         in->gyro_b_radps.x, in->gyro_b_radps.y,
                           in->gyro_b_radps.z, motor_N[0],         motor_N[1],
                           motor_N[2],         motor_N[3],         in->vbat_V};
  for (unsigned k = 0; k < sizeof LOGGED / sizeof *LOGGED; k++) f->v[LOGGED[k]][i] = values[k];
  const pilot_setpoint_t *set = &in->set;
  const double told[] = {set->pos_w_m.x, set->pos_w_m.y, set->pos_w_m.z - body_rest_z_m(&e->model),
                         set->vel_mps.x, set->vel_mps.y, set->vel_mps.z,
                         set->yaw_rad};
  for (unsigned k = 0; k < N_TOLD && f->v[TOLD[k]]; k++) f->v[TOLD[k]][i] = told[k];
  f->t_s[i] = t_s;
  f->v[SIG_RANGE][i] = range_m;
}

// --- the flight -------------------------------------------------------------------------------------------

static void order(pilot_in_t *in, const wish_t *w) {
  for (int i = 0; i < 3; i++) in->set.mode[i] = PILOT_POSITION;
  in->set.pos_w_m = w->pos;
  in->set.vel_mps = w->vel;
  in->set.yaw_rad = w->yaw;
}

static done_t run(exam_t *e, const pilot_t *pilot, const plan_t6 *plan, gap_flight_t *f, why_t *why) {
  pilot_in_t in = {.q_wb = {.w = 1.0}};
  double motor_N[4], z_m = 0.4, down_s = 0.0;
  for (int i = 0; i < 4; i++) in.applied_N[i] = e->body.command_N[i];
  pilot->reset(pilot->state);
  for (long tick = 0; tick < lround(EXAM_SPAN_S / EXAM_TICK_S); tick++) {
    const double t_s = (double)tick * EXAM_TICK_S;
    wish_t wish = plan_wish(plan, t_s);
    z_m += (wish.pos.z - z_m) * EXAM_TICK_S /
           (fabs(wish.pos.z - 0.4) < 0.21 ? 0.03 : 0.25); // no step into a surface
    wish.pos.z = z_m;
    drift(e);
    in = measure(e, &in);
    order(&in, &wish);
    in.range_new = tick % 50 == 0;
    if (in.range_new) in.range_m = range_up(e);
    for (int ms = 0; ms < 2; ms++, in.step++, in.range_new = false) pilot->step(pilot->state, &in, motor_N);
    for (int i = 0; i < 4; i++) motor_N[i] = fmin(fmax(motor_N[i], 0.0), 0.25 * e->model.thrust_max_N);
    write(f, e, &in, motor_N, t_s, tick % 50 == 0 ? in.range_m : (double)NAN);
    body_tick(&e->body, motor_N, EXAM_TICK_S);
    for (int i = 0; i < 4; i++) in.applied_N[i] = e->body.command_N[i];
    const d3_t at = d3_of(e->body.y + RIGID_POS_M);
    down_s += at.z < body_rest_z_m(&e->model) + 1e-3 ? EXAM_TICK_S : 0.0;
    if (e->body.broken || !(d3_norm(d3_sub(at, wish.pos)) < LOST_M) || down_s > DOWN_S)
      return error_failed(why, "the exam's vehicle crashed");
  }
  return DONE;
}

static done_t start(exam_t *e, const exam_flight_t *job, why_t *why) {
  body_start_t at = {.pos_w_m = {0.0, 0.0, 0.4}, .seed = job->seed};
  for (int k = 0; k < 4; k++) at.thrust_N[k] = 0.25 * e->model.mass_kg * G_MPS2;
  e->random = random_open(job->seed * 31u + 7u);
  if (!e->random) return error_failed(why, "out of memory");
  at.discharged = random_uniform(e->random, 0.05, 0.85);
  if (body_open(&e->body, &e->model, INTEGRATE_RK4, EXAM_TICK_S, &at) == DONE) return DONE;
  return error_failed(why, "the exam's vehicle cannot fly");
}

static done_t turbulence(exam_t *e, why_t *why) {
  for (int i = 0; i < e->model.n_fx; i++) {
    if (e->model.fx[i].fx != fx_find("wind")) continue; // the exam has its own, too
    e->model.fx[i].p[3] = TURB_SD * e->model.mass_kg;
    e->model.fx[i].p[4] = TURB_TAU;
    return DONE;
  }
  fx_use_t wind = fx_use(fx_find("wind"));
  wind.p[0] = 0.0;
  wind.p[3] = TURB_SD * e->model.mass_kg;
  wind.p[4] = TURB_TAU;
  return model_add_fx(&e->model, &wind, why);
}

done_t exam_fly(const exam_flight_t *job, gap_flight_t *f, why_t *why) {
  exam_t *const e = calloc(1, sizeof *e);
  pilot_flight_t *const own = malloc(sizeof *own);
  stock_pid_t pid;
  const stock_pid_param_t pid_param = stock_pid_default();
  pilot_t pilot = stock_pid_pilot(&pid, &pid_param);
  done_t status = e && own ? DONE : error_failed(why, "out of memory");
  if (status == DONE && job->indi) {
    flight_param_t param;
    params_default(&param);
    param_thesis(&param); // what the exam's published marks are of
    param.pos.mass_kg = (float)job->truth->mass_kg;
    param.motor_tau_s = (float)job->truth->motor_tau_s;
    param.gap_min_m = 0.0f;
    param.curve.mode = CURVE_OFF;
    status = pilot_flight_init(own, &param, job->truth, &pilot);
  }
  if (status == DONE) {
    e->model = *job->truth;
    status = turbulence(e, why);
  }
  if (status == DONE && !log_room(f, (size_t)(EXAM_SPAN_S / EXAM_TICK_S) + 8, job->set_points))
    status = error_failed(why, "out of memory");
  if (status == DONE) status = start(e, job, why);
  if (status == DONE) {
    const plan_t6 plan = plan_make(e->random, job->hover_only);
    status = run(e, &pilot, &plan, f, why);
  }
  if (e && e->body.integrate) body_close(&e->body);
  if (e) random_close(e->random);
  free(e);
  free(own);
  return status;
}
