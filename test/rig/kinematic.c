// kinematic.c - vehicles that follow a prescribed path.
#include "rig/kinematic.h"

#include <math.h>

#define G_MPS2 9.81
#define STEP_S 1e-4

// From 0 to 1, with four derivatives of zero at both ends.
static double smooth(double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  return x * x * x * x * x * (126.0 + x * (-420.0 + x * (540.0 + x * (-315.0 + x * 70.0))));
}

static d3_t position(const kinematic_t *k, double t) {
  const double share = smooth((t - k->start_s) / k->span_s),
               sway = sin(2.0 * 3.14159265358979 * k->sway_Hz * t);
  return d3_add(d3_add(k->from_m, d3_scale(share, d3_sub(k->to_m, k->from_m))), d3_scale(sway, k->sway_m));
}

static d3_t velocity(const kinematic_t *k, double t) {
  return d3_scale(0.5 / STEP_S, d3_sub(position(k, t + STEP_S), position(k, t - STEP_S)));
}

// The specific force in world axes: acceleration minus gravity.
static d3_t force(const kinematic_t *k, double t) {
  const double h = 10.0 * STEP_S; // larger, because rounding errors in the second difference grow as 1/h^2
  const d3_t sum = d3_add(position(k, t + h), position(k, t - h));
  return d3_add(d3_scale(1.0 / (h * h), d3_sub(sum, d3_scale(2.0, position(k, t)))),
                (d3_t){0.0, 0.0, G_MPS2});
}

// The shortest turn of body z onto the force, after the yaw.
static dq_t attitude(const kinematic_t *k, double t) {
  const double share = smooth((t - k->start_s) / k->span_s);
  const double half = 0.5 * (k->yaw_from_rad + share * (k->yaw_to_rad - k->yaw_from_rad));
  const d3_t f = force(k, t), n = d3_scale(1.0 / sqrt(d3_dot(f, f)), f);
  const dq_t tilt = dq_unit((dq_t){1.0 + n.z, -n.y, n.x, 0.0});
  return dq_mul(tilt, (dq_t){cos(half), 0.0, 0.0, sin(half)});
}

truth_t kinematic_at(const kinematic_t *k, double t) {
  const dq_t q = attitude(k, t), a = attitude(k, t - STEP_S), b = attitude(k, t + STEP_S);
  const dq_t turn = dq_mul((dq_t){a.w, -a.x, -a.y, -a.z}, b);
  const d3_t f = force(k, t), up_w = dq_to_world(q, (d3_t){0.0, 0.0, 1.0});
  truth_t truth = {.pos_w_m = position(k, t), .vel_w_mps = velocity(k, t), .q_wb = q};
  truth.rate_b_radps = d3_scale(1.0 / STEP_S, (d3_t){turn.x, turn.y, turn.z});
  truth.force_b_mps2 = dq_to_body(q, f);
  truth.up_m = (k->ceiling_m - truth.pos_w_m.z) / up_w.z;
  truth.down_m = truth.pos_w_m.z / up_w.z;
  truth.motors = t >= k->motors_on_s;
  return truth;
}
