// nominal_known.h - the pilot of nominal flights where the vehicle file says who flew its logs
// ([controller]): the firmware's PID with its gains, or the flight code itself, at the firmware's rates.
// Within sim/gap only.
//
// It gets the log's set points. Where there are none it is given those along the track: its place and speed,
// for the PID, which takes no speed, the place ahead at which it wants the track's speed.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_KNOWN_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_KNOWN_H

#include "gap/3_feedback/nominal_pilot.h"

typedef struct known known_t;

// After pilot_trim. BAD_INPUT: parameters that the flight code refuses; FAILED: no memory. free() it, also on
// an error.
MUST_CHECK done_t known_open(known_t **known, const nominal_flight_t *f, const grid_point_t *seen,
                             why_t *why);

// Newton of each motor after so many seconds more.
void known_steer(known_t *known, double step_s, const grid_point_t *track, const grid_point_t *seen,
                 double motor_N[ROTORS]);

#endif
