// lanes_fields.cpp - where the numbers of each block of a flight lie, in the order of its struct. Compiled
// twice: for one vehicle, and (LANE_FIELDS) for eight.
#include "flight/lanes_state.h"

#if defined LANE_FIELDS && !defined __AVX2__
int lanes_fields_of_eight(int, lane_field_t *, int, size_t *) {
  return -1;
}
#else
#ifdef LANE_FIELDS
#include "base/lane_c.hpp"
#define MADE_OF   lanes
#define FIELDS_OF lanes_fields_of_eight
#else
#include "base/lane_one.hpp"
#define MADE_OF   lane_one
#define FIELDS_OF lanes_fields_of_one
#endif

namespace MADE_OF {
#include "flight/lanes_blocks.h"
}

#undef float
#undef double
#undef int
#undef unsigned
#undef bool
#undef volatile

#define FIELDS(name, type, where) lane_fields_of<MADE_OF::type>,

int FIELDS_OF(int block, lane_field_t *to, int room, size_t *size) {
  typedef int fields_of_t(lane_field_t * to, int room, size_t *size);
  static fields_of_t *const of_block[] = {LANES_BLOCKS(FIELDS)};
  return of_block[block](to, room, size);
}
#endif
