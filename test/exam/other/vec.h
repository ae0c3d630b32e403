// vec.h - vectors, rotations and random numbers for the exam's second plant, which shares nothing with the
// first.
#ifndef TEST_EXAM_OTHER_VEC_H
#define TEST_EXAM_OTHER_VEC_H

#include <math.h>
#include <stdint.h>

#define OTHER_PI 3.14159265358979323846

typedef struct {
  double x, y, z;
} vec_t;

static inline vec_t vec(double x, double y, double z) {
  return (vec_t){x, y, z};
}
static inline vec_t vec_add(vec_t a, vec_t b) {
  return vec(a.x + b.x, a.y + b.y, a.z + b.z);
}
// a + k b
static inline vec_t vec_more(vec_t a, double k, vec_t b) {
  return vec(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}
static inline vec_t vec_times(double k, vec_t a) {
  return vec(k * a.x, k * a.y, k * a.z);
}
static inline double vec_dot(vec_t a, vec_t b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline vec_t vec_cross(vec_t a, vec_t b) {
  return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vec_length(vec_t a) {
  return sqrt(vec_dot(a, a));
}

// A rotation from body to world, as a quaternion.
typedef struct {
  double w, x, y, z;
} turn_t;

static inline turn_t turn_unit(turn_t q) {
  const double n = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return (turn_t){q.w / n, q.x / n, q.y / n, q.z / n};
}
// Turns q by a small angle about a body axis.
static inline turn_t turn_by(turn_t q, vec_t a) {
  return turn_unit((turn_t){
      q.w - 0.5 * (q.x * a.x + q.y * a.y + q.z * a.z), q.x + 0.5 * (q.w * a.x + q.y * a.z - q.z * a.y),
      q.y + 0.5 * (q.w * a.y + q.z * a.x - q.x * a.z), q.z + 0.5 * (q.w * a.z + q.x * a.y - q.y * a.x)});
}
static inline vec_t turn_axis_x(turn_t q) {
  return vec(1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z),
             2.0 * (q.x * q.z - q.w * q.y));
}
static inline vec_t turn_axis_y(turn_t q) {
  return vec(2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
             2.0 * (q.y * q.z + q.w * q.x));
}
static inline vec_t turn_axis_z(turn_t q) {
  return vec(2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
             1.0 - 2.0 * (q.x * q.x + q.y * q.y));
}
static inline vec_t turn_to_world(turn_t q, vec_t b) {
  return vec_add(vec_times(b.x, turn_axis_x(q)),
                 vec_add(vec_times(b.y, turn_axis_y(q)), vec_times(b.z, turn_axis_z(q))));
}
static inline vec_t turn_to_body(turn_t q, vec_t w) {
  return vec(vec_dot(turn_axis_x(q), w), vec_dot(turn_axis_y(q), w), vec_dot(turn_axis_z(q), w));
}

// Random numbers: splitmix64, and normal ones by Box and Muller.
typedef struct {
  uint64_t at;
} dice_t;

// 0..1, both excluded
static inline double dice_share(dice_t *d) {
  uint64_t z = d->at += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}
static inline double dice_between(dice_t *d, double low, double high) {
  return low + (high - low) * dice_share(d);
}
static inline double dice_normal(dice_t *d) {
  const double radius = sqrt(-2.0 * log(dice_share(d)));
  return radius * cos(2.0 * OTHER_PI * dice_share(d));
}
static inline vec_t dice_vec(dice_t *d, double sd) {
  const double x = sd * dice_normal(d), y = sd * dice_normal(d);
  return vec(x, y, sd * dice_normal(d));
}

#endif
