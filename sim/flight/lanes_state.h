// lanes_state.h - the sensors, the estimator and the Crazyflie of eight flights, in lanes: flies their
// milliseconds and gives access to their numbers.
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

// Null: no memory, or built without AVX2.
lanes_state_t *lanes_state_open(void);
void lanes_state_close(lanes_state_t *s);

// Call before a millisecond's random numbers are put into block `drawn`.
void lanes_draw(lanes_state_t *s);

// Fly a millisecond of sensors and estimator, and of the Crazyflie, of the lanes `in` (a bit each). Return
// those that passed it; the others parted, and have to repeat it alone from the last copy.
unsigned lanes_senses_ms(lanes_state_t *s, unsigned in);
unsigned lanes_vehicle_ms(lanes_state_t *s, unsigned in);

// Call before each lanes_vehicle_ms(). Returns what the Crazyflies are told in it (pilot_in_t of eight):
// block `in`, or if edited a copy that may be edited.
void *lanes_told(lanes_state_t *s, bool edited);
// Call when a set point in block `in` has changed.
void lanes_set_new(lanes_state_t *s);

// Returns the lanes (a bit each) whose upward range is new in this millisecond.
unsigned lanes_range_new(const lanes_state_t *s);
// Begins another tick: returns where its truth goes, rows of 8 numbers in the order of truth_t. Then whether
// motors turn, a bit each, goes to lanes_take_motors().
double *lanes_truth(lanes_state_t *s);
void lanes_take_motors(lanes_state_t *s, unsigned motors);
// Call when all pilots have been called and their inputs are no longer read: block `in` becomes that of the
// next millisecond.
void lanes_step(lanes_state_t *s);

// Return where a block (lanes_blocks.h) lies, and its last copy.
void *lanes_block(lanes_state_t *s, int block);
const void *lanes_block_before(const lanes_state_t *s, int block);

// Returns the copy of block `app` as last looked at.
void *lanes_looked(lanes_state_t *s);

// Inputs since the last copy, a block for each millisecond: what was drawn and what was true, or pilot_in_t
// (truth is null).
typedef struct {
  int ms;
  const void *const *of, *const *truth;
} lanes_since_t;
lanes_since_t lanes_senses_since(const lanes_state_t *s);
lanes_since_t lanes_vehicle_since(const lanes_state_t *s);

// Call when all numbers were put in anew.
void lanes_begin_anew(lanes_state_t *s);
// True if the next millisecond of the senses, or of the Crazyflie, begins with a copy: flights may return to
// lanes. none: no flight is in lanes now, which makes a copy due.
bool lanes_senses_due(lanes_state_t *s, bool none);
bool lanes_vehicle_due(lanes_state_t *s, bool none);

// lanes_fields.cpp: return how many numbers a block has (-1: built without AVX2), and set where each lies.
int lanes_fields_of_one(int block, lane_field_t *to, int room, size_t *size);
int lanes_fields_of_eight(int block, lane_field_t *to, int room, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
