// d3.h - three-vectors and quaternions by value, in double: what nature computes with. A quaternion q turns
// body axes into world axes: v_world = q v_body q*.
#ifndef SIM_PLANT_D3_H
#define SIM_PLANT_D3_H

#include <math.h>

typedef struct {
  double x, y, z;
} d3_t;

typedef struct {
  double w, x, y, z;
} dq_t;

static inline d3_t d3_add(d3_t a, d3_t b) {
  return (d3_t){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline d3_t d3_sub(d3_t a, d3_t b) {
  return (d3_t){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline d3_t d3_scale(double k, d3_t a) {
  return (d3_t){k * a.x, k * a.y, k * a.z};
}

static inline double d3_dot(d3_t a, d3_t b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline d3_t d3_cross(d3_t a, d3_t b) {
  return (d3_t){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// First b, then a: dq_to_world(dq_mul(a, b), v) = dq_to_world(a, dq_to_world(b, v)).
static inline dq_t dq_mul(dq_t a, dq_t b) {
  return (dq_t){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

// Of length 1; q must not be zero.
static inline dq_t dq_unit(dq_t q) {
  const double k = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return (dq_t){k * q.w, k * q.x, k * q.y, k * q.z};
}

// q must have length 1: v + 2 w (u x v) + 2 u x (u x v), u the vector part.
static inline d3_t dq_to_world(dq_t q, d3_t v) {
  const d3_t u = {q.x, q.y, q.z}, t = d3_scale(2.0, d3_cross(u, v));
  return d3_add(v, d3_add(d3_scale(q.w, t), d3_cross(u, t)));
}

static inline d3_t dq_to_body(dq_t q, d3_t v) {
  return dq_to_world((dq_t){q.w, -q.x, -q.y, -q.z}, v);
}

#endif
