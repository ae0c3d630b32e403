// weave.h - copies numbers of one flight into a lane and back.
#ifndef SIM_FLIGHT_WEAVE_H
#define SIM_FLIGHT_WEAVE_H

#include "flight/lanes_state.h"

#define WEAVE_RUNS 256

// n numbers of one kind that are contiguous in the struct of one flight and in that of eight, from these
// bytes on.
typedef struct {
  uint32_t one, eight;
  int n;
  lane_field_kind_t kind;
} weave_run_t;

typedef struct {
  int block, n;
  weave_run_t run[WEAVE_RUNS];
} weave_t;

// Returns all numbers of a block (lanes_blocks.h). Null: the processor cannot do it, or a struct of one and
// that of eight differ in their numbers; then nothing may be copied.
const weave_t *weave_block(int block);

// Returns those that lie in bytes from..to of the struct of one.
weave_t weave_part(int block, size_t from, size_t to);

// Copy into a lane, and out of it. eight: where the block lies.
void weave_put(const weave_t *w, void *eight, int lane, const void *one);
void weave_get(const weave_t *w, const void *eight, int lane, void *one);

// The same for all eight flights, at less than half the cost.
void weave_put_all(const weave_t *w, void *eight, const void *const one[LANES]);
void weave_get_all(const weave_t *w, const void *eight, void *const one[LANES]);
// Copies only runs that differ from *was, which has the layout of *eight and is updated to it.
void weave_get_changed(const weave_t *w, const void *eight, void *was, void *const one[LANES]);

#endif
