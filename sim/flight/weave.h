// weave.h - numbers of one flight into a lane, and back.
#ifndef SIM_FLIGHT_WEAVE_H
#define SIM_FLIGHT_WEAVE_H

#include "flight/lanes_state.h"

#define WEAVE_RUNS 256

// Numbers of a kind that lie one behind the other, in the struct of one and among eight.
typedef struct {
  uint32_t one, eight;
  int n;
  lane_field_kind_t kind;
} weave_run_t;

typedef struct {
  int block, n;
  weave_run_t run[WEAVE_RUNS];
} weave_t;

// All numbers of a block (lanes_blocks.h). Null: the structs of one and of eight have not the same numbers,
// or the processor cannot do it, and nothing must be woven.
const weave_t *weave_block(int block);

// Those that lie from..to in the struct of one.
weave_t weave_part(int block, size_t from, size_t to);

// eight: where that block lies.
void weave_put(const weave_t *w, void *eight, int lane, const void *one);
void weave_get(const weave_t *w, const void *eight, int lane, void *one);

// The same of all eight flights, for less than half.
void weave_put_all(const weave_t *w, void *eight, const void *const one[LANES]);
void weave_get_all(const weave_t *w, const void *eight, void *const one[LANES]);
// The same of what is another than in *was, which lies as *eight does and is as that afterwards.
void weave_get_changed(const weave_t *w, const void *eight, void *was, void *const one[LANES]);

#endif
