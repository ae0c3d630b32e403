// lanes_state.h - the sensors, the estimator and the Crazyflie of eight flights, in lanes: their
// milliseconds, and the way of their numbers in and out.
#ifndef SIM_FLIGHT_LANES_STATE_H
#define SIM_FLIGHT_LANES_STATE_H

#include "base/lane.h"
#include "base/lane_fields.h"
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lanes_state lanes_state_t;

// Null: no memory.
lanes_state_t *lanes_state_open(void);
void lanes_state_close(lanes_state_t *s);

// What is drawn for a millisecond comes after this, into block `drawn`.
void lanes_draw(lanes_state_t *s);

// A millisecond of sensors and estimator, and of the Crazyflie, of the lanes `in` (a bit each). Those that
// are returned have passed it; the others parted, and are to do it alone from what they were before.
unsigned lanes_senses_ms(lanes_state_t *s, unsigned in);
unsigned lanes_vehicle_ms(lanes_state_t *s, unsigned in);

// Before the latter, each time: what the Crazyflie of each is told in it, block `in`, or a copy of it that
// may be edited.
void *lanes_told(lanes_state_t *s, bool edited);
// A set point in block `in` is another one.
void lanes_set_new(lanes_state_t *s);

// What is new of the upward range sensor since the last millisecond, a bit each.
unsigned lanes_range_new(const lanes_state_t *s);
// Where what is true at another tick's begin goes: so many rows of 8 numbers in the order of truth_t; and
// whether their motors turn, a bit each.
double *lanes_truth(lanes_state_t *s);
void lanes_take_motors(lanes_state_t *s, unsigned motors);
// All have called their pilot, and what it was told is looked at no more: block `in` is that of the next
// millisecond.
void lanes_step(lanes_state_t *s);

// Where a block (lanes_blocks.h) lies, and where it lay some milliseconds ago.
void *lanes_block(lanes_state_t *s, int block);
const void *lanes_block_before(const lanes_state_t *s, int block);

// Where block `app` as it was looked at last is kept.
void *lanes_looked(lanes_state_t *s);

// What came in since, a block for each millisecond: what was drawn and what was true, or pilot_in_t.
typedef struct {
  int ms;
  const void *const *of, *const *truth;
} lanes_since_t;
lanes_since_t lanes_senses_since(const lanes_state_t *s);
lanes_since_t lanes_vehicle_since(const lanes_state_t *s);

// All numbers were put in anew.
void lanes_begin_anew(lanes_state_t *s);
// Whether the next millisecond of the senses, of the Crazyflie begins with a copy: numbers may be put in
// anew. It does, if none is in lanes now.
bool lanes_senses_due(lanes_state_t *s, bool none);
bool lanes_vehicle_due(lanes_state_t *s, bool none);

// lanes_fields.cpp: how many numbers a block has, and where each lies.
int lanes_fields_of_one(int block, lane_field_t *to, int room, size_t *size);
int lanes_fields_of_eight(int block, lane_field_t *to, int room, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
