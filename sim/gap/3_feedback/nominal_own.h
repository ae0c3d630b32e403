// nominal_own.h - the flight code as the pilot of nominal flights. A file of its own, because the firmware's
// headers have a point_t, too. Within sim/gap only.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_OWN_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_OWN_H

#include "base/error.h"
#include "crazyflie/pilot.h"
#include "pilots/flown_by.h"
#include "vehicle/model.h"

typedef struct own own_t;

// With the parameters of `by` (pilots/controller_file.h). FAILED: no memory, or parameters that it
// refuses. Close it, also on an error.
MUST_CHECK done_t own_open(own_t **own, const model_t *m, const flown_by_t *by, pilot_t *pilot, why_t *why);

// A null pointer is allowed.
void own_close(own_t *own);

#endif
