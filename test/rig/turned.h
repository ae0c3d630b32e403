// turned.h - an attitude for a test to start from.
#ifndef TEST_RIG_TURNED_H
#define TEST_RIG_TURNED_H

#include "base/d3.h"

// The rotation by angle_rad about a unit vector.
static inline dq_t turned_about(d3_t unit, double angle_rad) {
  const double s = sin(0.5 * angle_rad);
  return (dq_t){cos(0.5 * angle_rad), s * unit.x, s * unit.y, s * unit.z};
}

#endif
