// v3.h - scalars with bounds, three-vectors and unit quaternions, all by value. Header only.
//
// World axes: x forward, y left, z up, right-handed. A quaternion q_wb turns body into world
// coordinates. Nothing here calls libm but sqrtf and fabsf (both are instructions, not calls).
#ifndef FLIGHT_V3_H
#define FLIGHT_V3_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#define GRAVITY_MPS2 9.81f

typedef struct {
  float x, y, z;
} v3_t;

typedef struct {
  float w, x, y, z;
} quat_t;

// a if `holds`, else b. The simulator redefines these macros to compute many vehicles at a time
// (sim/base/lane_c.hpp), and then evaluates both.
#ifndef EITHER
#define EITHER(holds, a, b) ((holds) ? (a) : (b))
#endif
// True if `holds` for any of the vehicles: work that is begun for one is computed for all.
#ifndef ANY
#define ANY(holds) (holds)
#endif
// Runs the statement that follows for the vehicles for which `holds`. It may change *state and its own
// locals, nothing else; the state of the other vehicles stays.
#ifndef FOR_WHOM
#define FOR_WHOM(holds, state) if (holds)
#endif
// Element i of a list; i may differ from vehicle to vehicle.
#ifndef PICK
#define PICK(list, i)         ((list)[i])
#define PLACE(list, i, value) ((list)[i] = (value))
#endif

// False for NaN and both infinities.
static inline bool f_finite(float x) {
  return fabsf(x) <= FLT_MAX;
}

// x limited to lo..hi; NaN gives lo, so that lo must be a value that does no harm.
static inline float f_clamp(float x, float lo, float hi) {
  return EITHER(!(x >= lo), lo, EITHER(x > hi, hi, x));
}

// x limited to +-bound; NaN gives 0. For values that do most harm at a bound.
static inline float f_bound(float x, float bound) {
  return EITHER(fabsf(x) <= bound, x, EITHER(x > 0.0f, bound, EITHER(x < 0.0f, -bound, 0.0f)));
}

// The larger one; NaN in x gives lo. (fmaxf is a libm call.)
static inline float f_max(float x, float lo) {
  return EITHER(x > lo, x, lo);
}

// The smaller one; NaN in x gives hi.
static inline float f_min(float x, float hi) {
  return EITHER(x < hi, x, hi);
}

// True if every component is within +-bound; NaN and infinities are not.
static inline bool v3_within(v3_t a, float bound) {
  return fabsf(a.x) <= bound && fabsf(a.y) <= bound && fabsf(a.z) <= bound;
}

static inline v3_t v3_add(v3_t a, v3_t b) {
  return (v3_t){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline v3_t v3_sub(v3_t a, v3_t b) {
  return (v3_t){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline v3_t v3_scale(float k, v3_t a) {
  return (v3_t){k * a.x, k * a.y, k * a.z};
}
static inline float v3_dot(v3_t a, v3_t b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline v3_t v3_cross(v3_t a, v3_t b) {
  return (v3_t){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float quat_dot(quat_t a, quat_t b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

// True if q can be an estimator's attitude: length 0.5 to 2, nothing NaN or infinite.
static inline bool quat_plausible(quat_t q) {
  const float norm2 = quat_dot(q, q);
  return norm2 >= 0.25f && norm2 <= 4.0f;
}

// q of length 1; the identity if q is shorter than 0.1 or not finite, which no attitude is.
static inline quat_t quat_unit(quat_t q) {
  const float norm2 = quat_dot(q, q);
  if (!(norm2 >= 0.01f && norm2 <= FLT_MAX)) return (quat_t){1.0f, 0.0f, 0.0f, 0.0f};
  const float k = 1.0f / sqrtf(norm2);
  return (quat_t){k * q.w, k * q.x, k * q.y, k * q.z};
}

static inline quat_t quat_conj(quat_t q) {
  return (quat_t){q.w, -q.x, -q.y, -q.z};
}

// First b, then a: quat_mul(q_wb, q_bc) turns c into world coordinates.
static inline quat_t quat_mul(quat_t a, quat_t b) {
  return (quat_t){
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
  };
}

// Body coordinates to world coordinates: R(q) v = v + 2 u x (u x v + w v), u the vector part.
static inline v3_t quat_to_world(quat_t q_wb, v3_t v_b) {
  const v3_t u = {q_wb.x, q_wb.y, q_wb.z};
  const v3_t t = v3_add(v3_cross(u, v_b), v3_scale(q_wb.w, v_b));
  return v3_add(v_b, v3_scale(2.0f, v3_cross(u, t)));
}

// World coordinates to body coordinates.
static inline v3_t quat_to_body(quat_t q_wb, v3_t v_w) {
  return quat_to_world(quat_conj(q_wb), v_w);
}

// The body's z axis in world coordinates: the direction of thrust.
static inline v3_t quat_up(quat_t q) {
  return (v3_t){2.0f * (q.x * q.z + q.w * q.y), 2.0f * (q.y * q.z - q.w * q.x),
                1.0f - 2.0f * (q.x * q.x + q.y * q.y)};
}

#endif
