// nominal_own.c - the flight code as the pilot of nominal flights.
#include "gap/3_feedback/nominal_own.h"

#include "pilots/pilot_flight.h"
#include <stdlib.h>

struct own {
  pilot_flight_t pilot;
};

done_t own_open(own_t **own, const model_t *m, const flown_by_t *by, pilot_t *pilot, why_t *why) {
  flight_param_t param;
  *own = calloc(1, sizeof **own);
  if (!*own) return error_failed(why, "out of memory");
  params_default(&param);
  param.pos.mass_kg = (float)m->mass_kg;
  param.motor_tau_s = (float)m->motor_tau_s;
  for (int i = 0; i < by->n_set; i++) {
    const param_row_t *const row = params_find(by->set[i].name);
    if (!row || params_set(&param, row, (float)by->set[i].value) != ST_OK)
      return error_failed(why, "%s: the flight code has no such parameter", by->set[i].name);
  }
  if (pilot_flight_init(&(*own)->pilot, &param, m, pilot) == DONE) return DONE;
  return error_failed(why, "%s: the flight code cannot fly it with its [controller]", m->name);
}

void own_close(own_t *own) {
  free(own);
}
