// rig3.c - a vehicle for tests of the outer loop.
#include "rig/rig3.h"

#include "rig/test.h"
#include <string.h>

double rig3_ratio(double zc_m) {
  return 1.0 + 0.44 * exp(-80.0 * fmax(zc_m, 0.0));
}

rig3_t rig3_at(double x, double y, double z, double ceiling_m) {
  const double weight_N = 0.032 * 9.81 / rig3_ratio(ceiling_m - z);
  return (rig3_t){
      .pos = {x, y, z}, .up = {0, 0, 1}, .thrust_N = weight_N, .applied_N = weight_N, .ceiling_m = ceiling_m};
}

static double force_N(const rig3_t *v) {
  return v->thrust_N * rig3_ratio(v->ceiling_m - v->pos[2]);
}

void rig3_move(rig3_t *v, const outer_out_t *command) {
  const double to[3] = {(double)command->up_w.x, (double)command->up_w.y, (double)command->up_w.z};
  const double h = 0.001;
  v->applied_N = (double)command->thrust_N;
  for (int step = 0; step < 10; step++) {
    for (int i = 0; i < 3; i++) {
      const double acc = force_N(v) / 0.032 * v->up[i] - (i == 2 ? 9.81 : 0.0);
      v->pos[i] += h * (v->vel[i] + 0.5 * h * acc);
      v->vel[i] += h * acc;
    }
    v->thrust_N = v->applied_N + (v->thrust_N - v->applied_N) * exp(-h / 0.0625);
    double length = 0.0;
    for (int i = 0; i < 3; i++) {
      v->up[i] += (to[i] - v->up[i]) * h / 0.03;
      length += v->up[i] * v->up[i];
    }
    for (int i = 0; i < 3; i++) v->up[i] /= sqrt(length);
  }
  v->tick++;
}

quat_t rig3_attitude(const double up[3], double yaw) {
  const double w = sqrt(0.5 * (1.0 + up[2])), x = -up[1] / (2.0 * w), y = up[0] / (2.0 * w);
  const double c = cos(0.5 * yaw), s = sin(0.5 * yaw);
  return (quat_t){(float)(w * c), (float)(x * c + y * s), (float)(y * c - x * s), (float)(w * s)};
}

static v3_t v3_of(const double a[3]) {
  return (v3_t){(float)a[0], (float)a[1], (float)a[2]};
}

outer_in_t rig3_sense(const rig3_t *v, v3_t goal_m) {
  return (outer_in_t){.pos_w_m = v3_of(v->pos),
                      .vel_w_mps = v3_of(v->vel),
                      .acc_b_mps2 = {0, 0, (float)(force_N(v) / 0.032)},
                      .q_wb = rig3_attitude(v->up, v->yaw),
                      .thrust_N = (float)v->applied_N,
                      .range_new = v->tick % 10 == 0,
                      .range_m = (float)fmin((v->ceiling_m - v->pos[2]) / v->up[2], 32.767),
                      .setpoint = {.pos_w_m = goal_m}};
}

flight_param_t rig3_param(void) {
  flight_param_t p;
  params_default(&p);
  p.pos.mass_kg = 0.032f; // this vehicle's own
  p.motor_tau_s = 0.0625f;
  return p;
}

outer_t rig3_outer(const flight_param_t *p) {
  outer_t f;
  memset(&f, 0, sizeof f);
  CHECK_OK(outer_init(&f, p, RIG3_PERIOD_S));
  return f;
}

outer_out_t rig3_step(outer_t *f, const flight_param_t *p, const outer_in_t *in) {
  if (memcmp(p, &f->param, sizeof *p) != 0) (void)!outer_tune(f, p);
  const outer_out_t out = *outer_step(f, in);
  outer_learn(f);
  return out;
}

outer_out_t rig3_fly(outer_t *f, const flight_param_t *p, rig3_t *v, v3_t goal_m, int ticks) {
  outer_out_t out = f->out;
  for (int k = 0; k < ticks; k++) {
    const outer_in_t in = rig3_sense(v, goal_m);
    out = rig3_step(f, p, &in);
    rig3_move(v, &out);
  }
  return out;
}

outer_t rig3_in_flight(flight_param_t *p, rig3_t *v) {
  *p = rig3_param();
  p->curve.mode = CURVE_LIVE;
  outer_t f = rig3_outer(p);
  *v = rig3_at(0.1, -0.1, 0.80, 1.0);
  rig3_fly(&f, p, v, (v3_t){0, 0, 0.94f}, 503);
  CHECK(f.ceiling.known && f.learn.rls.count > 100);
  return f;
}

bool rig3_same_out(const outer_out_t *a, const outer_out_t *b) {
  const float x[] = {a->up_w.x, a->up_w.y, a->up_w.z, a->thrust_N, a->zc_m, a->at.ratio, a->at.slope_per_m};
  const float y[] = {b->up_w.x, b->up_w.y, b->up_w.z, b->thrust_N, b->zc_m, b->at.ratio, b->at.slope_per_m};
  return memcmp(x, y, sizeof x) == 0 && a->zc_known == b->zc_known;
}

// Returns a copy in which the padding bytes of `sample` are zero, because assignment need not copy them.
// `out` has padding, too, and is compared by its fields.
static outer_t without_padding(const outer_t *f) {
  outer_t copy;
  memcpy(&copy, f, sizeof copy);
  memset(&copy.sample, 0, sizeof copy.sample);
  learn_sample_t *const s = &copy.sample;
  s->zc_m = f->sample.zc_m;
  s->known = f->sample.known;
  s->blind_s = f->sample.blind_s;
  s->up = f->sample.up;
  s->force_N = f->sample.force_N;
  s->thrust_N = f->sample.thrust_N;
  s->weight_N = f->sample.weight_N;
  s->since_limit_s = f->sample.since_limit_s;
  return copy;
}

bool rig3_same_state(const outer_t *a, const outer_t *b) {
  const outer_t x = without_padding(a), y = without_padding(b);
  return rig3_same_out(&x.out, &y.out) && memcmp(&x, &y, offsetof(outer_t, out)) == 0;
}
_Static_assert(offsetof(outer_t, out) + sizeof(outer_out_t) == offsetof(outer_t, faults),
               "something behind `out` would not be compared");

unsigned rig3_faults(const outer_t *f) {
  unsigned sum = 0;
  for (int i = 0; i < ST_COUNT; i++) sum += f->faults[i];
  return sum;
}

bool rig3_is_command(const outer_out_t *out, const flight_param_t *p) {
  const double up2 = (double)v3_dot(out->up_w, out->up_w);
  const double side = hypot((double)out->up_w.x, (double)out->up_w.y);
  return fabs(up2 - 1.0) < 1e-5 && out->up_w.z > 0.0f && side <= sin((double)p->pos.tilt_max_rad) + 1e-5 &&
         out->thrust_N >= 0.0f && out->thrust_N <= p->pos.thrust_max_N && f_finite(out->zc_m) &&
         out->at.ratio >= p->curve.ratio_min && out->at.ratio <= p->curve.ratio_max &&
         f_finite(out->at.slope_per_m);
}
