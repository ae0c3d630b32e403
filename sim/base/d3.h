// d3.h - three-vectors, unit quaternions and rotations in double, by value. Header only.
//
// World and body axes: x forward, y left, z up, right-handed. A quaternion q_wb turns body into world.
#ifndef SIM_BASE_D3_H
#define SIM_BASE_D3_H

#include "base/where.h"
#include <math.h>

typedef struct {
  double x, y, z;
} d3_t;

typedef struct {
  double w, x, y, z;
} dq_t;

// The body's axes in world axes: the columns of the rotation matrix from body to world.
typedef struct {
  d3_t x, y, z;
} axes_t;

static inline d3_t d3(double x, double y, double z) {
  return (d3_t){x, y, z};
}
static inline d3_t d3_add(d3_t a, d3_t b) {
  return d3(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline d3_t d3_sub(d3_t a, d3_t b) {
  return d3(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline d3_t d3_scale(double s, d3_t a) {
  return d3(s * a.x, s * a.y, s * a.z);
}
// a + s b
static inline d3_t d3_add_scaled(d3_t a, double s, d3_t b) {
  return d3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
static inline double d3_dot(d3_t a, d3_t b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline d3_t d3_cross(d3_t a, d3_t b) {
  return d3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double d3_norm(d3_t a) {
  return sqrt(d3_dot(a, a));
}
#define D3_WHERE(holds, a, b)                                                                                \
  d3(where(holds, (a).x, (b).x), where(holds, (a).y, (b).y), where(holds, (a).z, (b).z))
static inline d3_t d3_of(const double *p) {
  return d3(p[0], p[1], p[2]);
}
static inline void d3_put(double *p, d3_t a) {
  p[0] = a.x;
  p[1] = a.y;
  p[2] = a.z;
}

static inline dq_t dq_of(const double *p) {
  return (dq_t){p[0], p[1], p[2], p[3]};
}

// The product a b: the rotation b, then a.
static inline dq_t dq_mul(dq_t a, dq_t b) {
  return (dq_t){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, //
                a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, //
                a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, //
                a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

// The inverse rotation; q must be of unit length.
static inline dq_t dq_inverse(dq_t q) {
  return (dq_t){q.w, -q.x, -q.y, -q.z};
}

// q must be of unit length.
static inline axes_t axes_of(dq_t q) {
  const double x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const double xx = q.x * x2, xy = q.x * y2, xz = q.x * z2, yy = q.y * y2, yz = q.y * z2, zz = q.z * z2;
  const double wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return (axes_t){{1.0 - (yy + zz), xy + wz, xz - wy},
                  {xy - wz, 1.0 - (xx + zz), yz + wx},
                  {xz + wy, yz - wx, 1.0 - (xx + yy)}};
}

static inline d3_t axes_to_world(const axes_t *a, d3_t b) {
  return d3(a->x.x * b.x + a->y.x * b.y + a->z.x * b.z, a->x.y * b.x + a->y.y * b.y + a->z.y * b.z,
            a->x.z * b.x + a->y.z * b.y + a->z.z * b.z);
}
static inline d3_t axes_to_body(const axes_t *a, d3_t w) {
  return d3(d3_dot(a->x, w), d3_dot(a->y, w), d3_dot(a->z, w));
}
// The world's z axis in body axes.
static inline d3_t axes_up_b(const axes_t *a) {
  return d3(a->x.z, a->y.z, a->z.z);
}

// q scaled to unit length; it must not be zero.
static inline dq_t dq_unit(dq_t q) {
  const double k = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return (dq_t){k * q.w, k * q.x, k * q.y, k * q.z};
}

// The rotation about the axis v by an angle of |v| rad.
static inline dq_t dq_turn(d3_t v) {
  const double angle = sqrt(d3_dot(v, v)), k = where(angle > 1e-9, sin(0.5 * angle) / angle, 0.5);
  return (dq_t){cos(0.5 * angle), k * v.x, k * v.y, k * v.z};
}

// The point at `share` (0..1) of the straight line from q to the goal; not of unit length.
static inline dq_t dq_towards(dq_t q, dq_t goal, double share) {
  const double k = 1.0 - share;
  return (dq_t){k * q.w + share * goal.w, k * q.x + share * goal.x, k * q.y + share * goal.y,
                k * q.z + share * goal.z};
}

// v + 2 w (u x v) + 2 u x (u x v), where u is the vector part of q.
static inline d3_t dq_to_world(dq_t q_wb, d3_t v_b) {
  const d3_t u = {q_wb.x, q_wb.y, q_wb.z};
  const d3_t t = d3_scale(2.0, d3_cross(u, v_b));
  return d3_add(v_b, d3_add(d3_scale(q_wb.w, t), d3_cross(u, t)));
}
static inline d3_t dq_to_body(dq_t q_wb, d3_t v_w) {
  return dq_to_world(dq_inverse(q_wb), v_w);
}

#endif
