// senses.c - see senses.h.
#include "exam/other/senses.h"

#include <string.h>

#define OUTSIDE    5    // ticks
#define RANGE      50   // ticks
#define PLACE_GAIN 0.15 // share of the position error corrected by each sample
#define SPEED_GAIN 1.2  // 1/s, of the same
#define TURN_GAIN  0.05

double senses_late_s(double pole_Hz) {
  return sqrt(2.0) / (2.0 * OTHER_PI * pole_Hz);
}

// Each pole delays by half of the total.
static vec_t through(poles_t *p, vec_t in, double pole_Hz) {
  const double k = 1.0 - exp(-PILOT_S / (0.5 * senses_late_s(pole_Hz)));
  p->first = vec_more(p->first, k, vec_more(in, -1.0, p->first));
  p->second = vec_more(p->second, k, vec_more(p->first, -1.0, p->second));
  return p->second;
}

static vec_t felt(const senses_t *s, const nature_flight_t *f) {
  const vec_t a = vec_times(1.0 / f->nature->mass_kg, f->force_b_N);
  return vec_add(s->wrong.acc_mps2, vec_add(a, vec_cross(a, s->wrong.acc_turn_rad)));
}

void senses_start(senses_state_t *s, const senses_t *senses, const nature_flight_t *f) {
  memset(s, 0, sizeof *s);
  s->senses = senses;
  s->view = (pilot_view_t){f->s.pos_m, f->s.vel_mps, f->s.rate_radps, f->s.q};
  s->acc_poles.first = s->acc_poles.second = vec(0.0, 0.0, NATURE_G_MPS2);
  s->range_up_m = (double)NAN;
}

static void from_outside(senses_state_t *s, const nature_flight_t *f, dice_t *d) {
  const vec_t seen = vec_add(f->s.pos_m, dice_vec(d, s->senses->place_m));
  const vec_t off = vec_more(seen, -1.0, s->view.pos_m);
  s->view.pos_m = vec_more(s->view.pos_m, PLACE_GAIN, off);
  s->view.vel_mps = vec_more(s->view.vel_mps, SPEED_GAIN, off);
  const turn_t q = turn_by(f->s.q, dice_vec(d, s->senses->angle_rad)), p = s->view.q;
  // twice the vector part of conj(p) q
  const double sign = p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0 ? -2.0 : 2.0;
  const vec_t turn = vec(sign * (p.w * q.x - p.x * q.w - p.y * q.z + p.z * q.y),
                         sign * (p.w * q.y - p.y * q.w - p.z * q.x + p.x * q.z),
                         sign * (p.w * q.z - p.z * q.w - p.x * q.y + p.y * q.x));
  s->view.q = turn_by(p, vec_times(TURN_GAIN, turn));
}

static double range_up_m(const senses_state_t *s, const nature_flight_t *f, dice_t *d) {
  const double up = fmax(turn_axis_z(f->s.q).z, 0.1);
  const double height_m = f->s.pos_m.z - s->senses->wrong.range_late_s * f->s.vel_mps.z;
  const double m =
      (f->nature->ceiling_m - height_m) / up + s->senses->wrong.range_m + s->senses->range_m * dice_normal(d);
  return m < 4.0 ? fmax(m, 0.0) : (double)NAN;
}

void senses_see(senses_state_t *s, const nature_flight_t *f, dice_t *d) {
  const senses_t *const how = s->senses;
  const vec_t gyro = vec_add(f->s.rate_radps, dice_vec(d, how->gyro_radps));
  const vec_t acc = vec_add(felt(how, f), dice_vec(d, how->acc_mps2));
  s->gyro_radps = through(&s->gyro_poles, gyro, how->gyro_pole_Hz);
  s->acc_mps2 = through(&s->acc_poles, acc, how->acc_pole_Hz);
  const vec_t a_w = vec_add(turn_to_world(s->view.q, acc), vec(0.0, 0.0, -NATURE_G_MPS2));
  s->view.pos_m = vec_more(s->view.pos_m, PILOT_S, s->view.vel_mps);
  s->view.vel_mps = vec_more(s->view.vel_mps, PILOT_S, a_w);
  s->view.q = turn_by(s->view.q, vec_times(PILOT_S, gyro));
  s->view.rate_radps = s->gyro_radps;
  if (s->ticks % OUTSIDE == 0) from_outside(s, f, d);
  if (s->ticks % RANGE == 0) s->range_up_m = range_up_m(s, f, d);
  s->volt = f->volt + how->volt * dice_normal(d);
  s->ticks++;
}
