// faults_watch.c - what is measured in a flight, every millisecond, with knowledge of the truth.
#include "faults/faults.h"

#include "base/larger.h"
#include <string.h>

#define DEG (180.0 / 3.14159265358979)

static bool learner_in_box(const rls_t *rls) {
  for (int i = 0; i < RBF_N; i++)
    if (!(fabsf(rls->theta.w[i]) <= RLS_WEIGHT_MAX)) return false;
  for (int i = 0; i < RBF_N; i++)
    for (int j = 0; j <= i; j++) {
      const float a = rls->P[i][j], b = rls->P[j][i];
      if (!(fabsf(a) <= 1000.0f && fabsf(a - b) <= 1e-4f * (fabsf(a) + 1e-6f) && rls->P[i][i] > 0.0f))
        return false;
    }
  return true;
}

// True if the learner's memory has changed since the last millisecond. Most of what is looked at is this
// memory, so that it is compared only where it can have changed: in lanes by a lesson alone; where the pilot
// is called for this flight alone, a row may have changed it, too.
static bool learned(case_t *c) {
  const rls_t *rls = &c->pilot.flight->outer.learn.rls;
  const bool in_lanes = c->pilot.vehicle.bring_home != NULL && c->t_s > 0.0;
  if (in_lanes && !(c->pilot.flight->due & FLIGHT_LEARN)) return false;
  if (memcmp(rls, &c->learner, sizeof *rls) == 0) return false;
  memcpy(&c->learner, rls, sizeof *rls);
  c->learner_in_box = learner_in_box(rls);
  return true;
}

// True if all is finite and within limits (G1, G2 of the fault list). After the row broke the learner's
// memory, the learner has 25 ms to mend it.
static bool in_box(const case_t *c, double since_s) {
  const flight_t *f = c->pilot.flight;
  if (!(c->memory_broken && since_s < 0.025) && !c->learner_in_box) return false;
  const outer_out_t *o = &f->out.outer;
  if (!(o->zc_m >= 0.0f && o->zc_m <= 4.0f && o->at.ratio >= 0.5f && o->at.ratio <= 3.0f)) return false;
  if (!(f->out.motors.thrust_N >= 0.0f &&
        f->out.motors.thrust_N <= f->outer.param.pos.thrust_max_N * 1.0001f))
    return false;
  for (int i = 0; i < MOTORS; i++)
    if (!(f->out.motors.force_N[i] >= 0.0f && f->out.motors.force_N[i] <= f->outer.param.mixer.force_max_N))
      return false;
  return true;
}

// Once per tick, because the truth is the same in both of its milliseconds.
static void look_anew(case_t *c, const body_t *truth) {
  c->again = c->seen_tick && c->tick_s == truth->t_s;
  if (c->again) return;
  c->seen_tick = true;
  c->tick_s = truth->t_s;
  c->nearest_m = HUGE_VAL;
  for (int i = 0; i < ROTORS; i++) c->nearest_m = smaller(c->nearest_m, body_ceiling_gap_m(truth, i));
  c->told_N = 0.0;
  for (int i = 0; i < ROTORS; i++) c->told_N += truth->command_N[i];
  const axes_t axes = axes_of(dq_of(truth->y + RIGID_Q_WB));
  c->up = axes_up_b(&axes).z;
}

// Position and motion.
static void motion(case_t *c, const body_t *truth, double since_s) {
  flown_fault_t *s = &c->seen;
  const double gap_m = c->nearest_m, z_m = truth->y[RIGID_POS_M + 2], climb = truth->y[RIGID_VEL_MPS + 2];
  s->end_gap_m = gap_m;
  s->gap_min_m = smaller(s->gap_min_m, gap_m);
  if (s->touched_s < 0.0 && truth->ceiling_contacts > 0) s->touched_s = since_s;
  if (gap_m < 0.05) s->up_max_mps = larger(s->up_max_mps, climb);
  if (since_s < 0.0) {
    s->onset_z_m = z_m;
    return;
  }
  if (since_s < 0.3) s->rise_m = larger(s->rise_m, z_m - s->onset_z_m);
  if (s->moved_s < 0.0 && fabs(z_m - s->onset_z_m) > 0.02) s->moved_s = since_s;
  const double height_gap_m = FAULTS_CEILING_M - z_m - body_rotor_z_m(&c->model);
  const double error_m = height_gap_m - c->goal_m;
  s->rise_max_m = larger(s->rise_max_m, -error_m);
  if (s->n < FAULTS_ERRORS && since_s >= 0.01 * s->n - 1e-6) s->error_m[s->n++] = (float)error_m;
}

// Computes the angle only where it is larger than any before.
static void most_tilt(double *cosine, double *tilt_deg, double up) {
  if (!(up < *cosine)) return;
  *cosine = up;
  *tilt_deg = DEG * acos(larger(-1.0, up));
}
static void most_yaw(case_t *c, dq_t q) {
  const double sine = fabs(2.0 * (q.w * q.z + q.x * q.y)), cosine = 1.0 - 2.0 * (q.y * q.y + q.z * q.z);
  if (!(sine * c->yaw_cosine > cosine * c->yaw_sine)) return;
  c->yaw_sine = sine;
  c->yaw_cosine = cosine;
  c->seen.yaw_late_deg = DEG * atan2(sine, cosine);
}

static void attitude(case_t *c, const body_t *truth, double since_s) {
  flown_fault_t *s = &c->seen;
  if (since_s < 0.0) return;
  most_tilt(&c->tilt_cosine, &s->tilt_max_deg, c->up);
  if (since_s > 2.0) most_tilt(&c->late_cosine, &s->tilt_late_deg, c->up);
  if (since_s > 2.0) most_yaw(c, dq_of(truth->y + RIGID_Q_WB));
  const double *w = truth->y + RIGID_RATE_RADPS, shake2 = w[0] * w[0] + w[1] * w[1];
  if (since_s < 1.0) s->shake2_early += 1e-3 * shake2;
  if (since_s >= 4.0 && since_s < 5.0) s->shake2_late += 1e-3 * shake2;
  if (s->tilt_cut_deg < 0.0 && c->told_N <= 0.0)
    s->tilt_cut_deg = DEG * acos(larger(-1.0, smaller(1.0, c->up)));
}

static void thrust(case_t *c, const body_t *truth, double since_s) {
  flown_fault_t *s = &c->seen;
  const double told_N = c->told_N;
  const double wanted_N = (double)c->pilot.flight->out.outer.thrust_N;
  if (since_s >= 0.0 && since_s < 1.0) s->step_max_N = larger(s->step_max_N, fabs(wanted_N - s->wanted_N));
  const double given_N = (double)c->pilot.flight->outer.sync.thrust.model_N;
  if (since_s >= 0.0 && since_s < 1.0 && c->pilot.flight->outer.started)
    s->ahead_N = larger(s->ahead_N, fabs(wanted_N - given_N));
  const double ms = 1e3 * since_s + 0.5;
  if (ms >= 0.0 && ms < FAULTS_FIRST_MS) s->first_N[(int)ms] = (float)wanted_N;
  s->wanted_N = wanted_N;
  s->smooth_N += (told_N - s->smooth_N) / (c->t_s < 0.5 ? 1.0 : 50.0);
  for (int i = 0; i < ROTORS && !c->again; i++) {
    const double kick_N = fabs(truth->command_N[i] - c->last_N[i]);
    if (c->t_s > 0.1 && since_s < 0.0) s->kick_usual_N = larger(s->kick_usual_N, kick_N);
    if (since_s >= 0.0 && since_s < c->length_s + 0.2) s->kick_N = larger(s->kick_N, kick_N);
    c->last_N[i] = truth->command_N[i];
  }
  if (since_s < 0.0) {
    s->hover_N += 0.002 * (told_N - s->hover_N);
    return;
  }
  if (since_s < c->length_s) s->pulse_N = larger(s->pulse_N, s->smooth_N - s->hover_N);
  if (c->pilot.flight->guard.action == GUARD_HAND_OVER && ++s->handed_ms > 4)
    s->over_N = larger(s->over_N, told_N - s->hover_N);
  const bool full = told_N > 0.98 * (double)c->param.pos.thrust_max_N;
  s->full_s = full && c->nearest_m < 0.15 ? s->full_s + 1e-3 : 0.0;
  s->full_total_s += full ? 1e-3 : 0.0;
  s->full_max_s = larger(s->full_max_s, s->full_s);
}

static void mind(case_t *c, const body_t *truth, bool learned_now, double since_s) {
  flown_fault_t *s = &c->seen;
  const flight_t *f = c->pilot.flight;
  const unsigned latched = f->guard.latched;
  if (since_s < 0.0) {
    s->early |= latched;
    c->weights = f->outer.learn.rls.theta;
    return;
  }
  if (s->seen_s < 0.0 && (latched & ~s->early & c->row->reasons) != 0) s->seen_s = since_s;
  if (learned_now && since_s < c->length_s + 0.2)
    for (int i = 0; i < RBF_N; i++) {
      const float w = c->weights.w[i], now = f->outer.learn.rls.theta.w[i];
      s->weight_change = larger(s->weight_change, (double)(fabsf(now - w) / (fabsf(w) + 1e-3f)));
    }
  if (since_s < 0.5 || !f->out.outer.zc_known) return;
  const double true_m = FAULTS_CEILING_M - truth->y[RIGID_POS_M + 2] - body_rotor_z_m(&c->model);
  s->zc_error_m = larger(s->zc_error_m, fabs((double)f->out.outer.zc_m - true_m));
}

void faults_watch(case_t *c, const body_t *truth) {
  const double since_s = c->t_s - c->onset_s;
  const bool learned_now = learned(c);
  look_anew(c, truth);
  c->seen.bad = c->seen.bad || truth->broken || (c->t_s > 0.05 && !in_box(c, since_s));
  motion(c, truth, since_s);
  attitude(c, truth, since_s);
  thrust(c, truth, since_s);
  mind(c, truth, learned_now, since_s);
}
