// pilot.c - see pilot.h.
#include "exam/other/pilot.h"

#include <string.h>

#define OUTER       5   // calls per step of the position and speed loops
#define TILT_MAX    0.5 // of g, sideways
#define CLIMB_MAX   1.5 // m/s
#define SPEED_MAX   3.0
#define SUM_MAX     2.5 // m/s2
#define PUSH_MAX    0.6 // of g, up and down
#define TURN_MAX    6.0 // rad/s
#define YAW_GAIN    3.0
#define LEAST_LAG_S 0.015

static double limited(double x, double most) {
  return fmin(fmax(x, -most), most);
}
static vec_t limited_vec(vec_t a, double level, double up) {
  const double far = hypot(a.x, a.y), k = far > level ? level / far : 1.0;
  return vec(k * a.x, k * a.y, limited(a.z, up));
}

void pilot_start(pilot_state_t *p, const nature_t *known, double briskness) {
  memset(p, 0, sizeof *p);
  p->known = *known;
  // The derivative compensates half of the lag.
  const double slow_s = fmax(known->lag_s + known->delay_s, LEAST_LAG_S);
  p->rate_gain = briskness * fmin(30.0, 0.9 / slow_s);
  p->rate_lead = 0.5 * slow_s;
  p->att_gain = 0.4 * p->rate_gain;
  p->vel_gain = fmin(3.0, 0.35 * p->att_gain);
  p->pos_gain = 0.4 * p->vel_gain;
  p->up_gain = 5.0 * briskness;
}

// Computes the wanted acceleration, world axes.
static void outer(pilot_state_t *p, const pilot_view_t *v, const pilot_wish_t *wish) {
  const double dt = OUTER * PILOT_S;
  const vec_t off = vec_more(wish->pos_m, -1.0, v->pos_m);
  const vec_t go =
      limited_vec(vec_add(wish->vel_mps, vec(p->pos_gain * off.x, p->pos_gain * off.y, 2.5 * off.z)),
                  SPEED_MAX, CLIMB_MAX);
  const vec_t e = vec_more(go, -1.0, v->vel_mps);
  p->vel_sum = limited_vec(vec_more(p->vel_sum, dt, vec(0.4 * e.x, 0.4 * e.y, 5.0 * e.z)), SUM_MAX, SUM_MAX);
  const vec_t a = vec_add(vec(p->vel_gain * e.x, p->vel_gain * e.y, p->up_gain * e.z), p->vel_sum);
  p->acc_mps2 = limited_vec(a, TILT_MAX * NATURE_G_MPS2, PUSH_MAX * NATURE_G_MPS2);
}

// Returns body rates that bring the thrust axis and the yaw to where they are wanted.
static vec_t rates(const pilot_state_t *p, const pilot_view_t *v, const pilot_wish_t *wish, vec_t want) {
  const vec_t up = vec_times(1.0 / vec_length(want), want), x = turn_axis_x(v->q);
  const vec_t lean = turn_to_body(v->q, vec_cross(turn_axis_z(v->q), up));
  const double yaw = atan2(x.y, x.x), turn = remainder(wish->yaw_rad - yaw, 2.0 * OTHER_PI);
  return vec(limited(p->att_gain * lean.x, TURN_MAX), limited(p->att_gain * lean.y, TURN_MAX),
             limited(YAW_GAIN * turn, 2.0));
}

// Rotor commands for a thrust and angular accelerations, by the known vehicle.
static void mix(const nature_t *k, double push_N, vec_t a, double command_radps[4]) {
  double xx = 0.0, yy = 0.0, ss = 0.0;
  for (int i = 0; i < 4; i++) {
    xx += k->x_m[i] * k->x_m[i];
    yy += k->y_m[i] * k->y_m[i];
    ss += k->torque_m * k->torque_m;
  }
  for (int i = 0; i < 4; i++) {
    const double N = 0.25 * push_N + k->inertia_kgm2[0] * a.x * k->y_m[i] / yy -
                     k->inertia_kgm2[1] * a.y * k->x_m[i] / xx -
                     k->inertia_kgm2[2] * a.z * k->spin[i] * k->torque_m / ss;
    command_radps[i] = fmin(sqrt(fmax(N, 0.0) / k->k_Ns2), k->most_radps);
  }
}

void pilot_fly(pilot_state_t *p, const pilot_view_t *v, const pilot_wish_t *wish, double command_radps[4]) {
  if (p->calls++ % OUTER == 0) outer(p, v, wish);
  const vec_t want = vec_add(p->acc_mps2, vec(0.0, 0.0, NATURE_G_MPS2));
  const vec_t e = vec_more(rates(p, v, wish, want), -1.0, v->rate_radps);
  const vec_t grows = vec_times(1.0 / PILOT_S, vec_more(v->rate_radps, -1.0, p->rate_before));
  p->rate_before = v->rate_radps;
  p->rate_sum = vec_more(p->rate_sum, PILOT_S, e);
  p->rate_sum = vec(limited(p->rate_sum.x, 1.0), limited(p->rate_sum.y, 1.0), limited(p->rate_sum.z, 1.0));
  vec_t a = vec_more(vec_times(p->rate_gain, e), 0.6 * p->rate_gain, p->rate_sum);
  a = vec_more(a, -p->rate_lead * p->rate_gain, grows);
  a.z = limited(0.4 * p->rate_gain * e.z + 0.5 * p->rate_sum.z, 15.0); // a rotor's torque is small
  const double push_N = p->known.mass_kg * fmax(vec_dot(want, turn_axis_z(v->q)), 2.0);
  mix(&p->known, push_N, a, command_radps);
}
