// nominal_known.h - the pilot of nominal flights where the vehicle file says who flew its logs
// ([controller]): the firmware's PID with its gains, or the flight code itself, at the firmware's rates.
// Within sim/gap only.
//
// The pilot gets the log's set points. Where there are none it gets the track's place and speed. The PID
// takes no speed: its place lies so far ahead that it wants the track's speed.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_KNOWN_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_KNOWN_H

#include "gap/3_feedback/nominal_pilot.h"

typedef struct known known_t;

// Opens the pilot; call it after pilot_trim. BAD_INPUT: parameters that the flight code refuses; FAILED: no
// memory. free() it, also on an error.
MUST_CHECK done_t known_open(known_t **known, const nominal_flight_t *f, const grid_point_t *seen,
                             why_t *why);

// Sets the newton of each motor, step_s seconds after the last call.
void known_steer(known_t *known, double step_s, const grid_point_t *track, const grid_point_t *seen,
                 double motor_N[ROTORS]);

#endif
