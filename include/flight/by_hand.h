// by_hand.h - the keep-out below a ceiling while the height is flown by hand.
//
// A thrust by hand takes no account of a ceiling. If one is near for the rate at which the vehicle rises, the
// stick commands a climb rate instead: the thrust beyond the weight asks for a velocity, upwards at most what
// the remaining room allows. The outer loop flies it, and the guard is active. Away from the ceiling the
// stick is thrust again.
//
//   climb = min(BY_HAND_STICK_MPS (T / m g - 1), kp room),  room = gap - ceil.min - BY_HAND_ROOM_M
#ifndef FLIGHT_BY_HAND_H
#define FLIGHT_BY_HAND_H

#include "flight/v3.h"
#include <stdbool.h>

// test: by_hand_takes_the_stick_for_a_climb_where_the_room_is_less_than_it_takes_to_stop
#define BY_HAND_ROOM_M     0.08f // added to ceil.min, so that the sensor, blind below 4 cm, sees the ceiling
#define BY_HAND_NEAR_M     0.3f  // of room: with less, the stick is a climb rate even at rest
#define BY_HAND_REACT_S    0.4f  // a sample's age (0.1) and interval (0.1), lag of motors and loop (0.2)
#define BY_HAND_BRAKE_MPS2 5.0f  // half of gravity, which is all that brakes a climb
#define BY_HAND_STICK_MPS  2.0f  // climb rate at a thrust of twice the weight
// test: by_hand_leaves_the_ceiling_farther_away_than_it_met_it_and_minds_tilt_and_offset
#define BY_HAND_LEAVE_M 0.1f // of additional room: with more, the stick is thrust again
// test: by_hand_knows_where_the_ceiling_is_between_samples_and_for_half_a_second
#define BY_HAND_BELIEVE_S 0.5f // how long the ceiling is believed to be there without a sample

typedef struct {
  float gap_m;   // propellers to ceiling, moved on by the climb between samples
  float since_s; // since the last sample that saw it; from BY_HAND_BELIEVE_S on none is known
  bool held;     // the stick is a climb rate
} by_hand_t;

typedef struct {
  float kp_per_s, gap_min_m, up_offset_m, floor_m, weight_N;
} by_hand_param_t;

typedef struct {
  float period_s;
  float thrust_N; // asked for
  float climb_mps;
  quat_t q_wb;
  bool range_new;
  float range_m, range_age_s;
} by_hand_in_t;

// No ceiling is known.
void by_hand_init(by_hand_t *s);

// Runs one call. True if the height is to be flown at the climb rate *climb_mps.
bool by_hand_step(by_hand_t *s, const by_hand_param_t *p, const by_hand_in_t *in, float *climb_mps);

#endif
