// lift.c - the factor, row by row, of a flight's own constant.
#include "gap/2_predict/lift.h"

#include "gap/2_predict/lines.h"
#include "gap/2_predict/residual.h"

// False: no memory.
static bool lift_of(set_t *s, int flight, const model_t *m, flight_lines_t *l) {
  grid_t *const g = &s->grid[flight];
  const lag_t lag = model_lag(m, 0.0);
  const lagged_t *const motors = grid_motors(g, &lag, m->frame.motor_delay_s);
  if (!motors) return false;
  for (int j = 0; j < g->n; j++) {
    l->base[CH_FZ][j] = 0.0;
    for (int k = 0; k < ROTORS; k++) l->base[CH_FZ][j] += motors->thrust_N[k][j];
  }
  const double *const series[CHANNELS] = {[CH_FZ] = l->base[CH_FZ]};
  double *const row[CHANNELS] = {[CH_FZ] = s->smooth.lift};
  residual_rows(s, flight, SERIES_PREDICTED, series, l->scratch, row);
  return true;
}

done_t lift_find(set_t *s, const model_t *m, why_t *why) {
  flight_lines_t l = {.room = NULL};
  s->smooth.lift = calloc((size_t)s->smooth.n + 1, sizeof(double));
  bool good = s->smooth.lift && flight_lines_make(&l, s);
  for (int f = 0; f < s->n_grid && good; f++) good = lift_of(s, f, m, &l);
  free(l.room);
  if (!good) return error_failed(why, "out of memory");
  double mean = 0.0;
  for (int i = 0; i < s->smooth.n; i++) mean += s->smooth.lift[i] / s->smooth.n;
  for (int i = 0; i < s->smooth.n; i++) s->smooth.lift[i] = mean > 0.0 ? s->smooth.lift[i] / mean : 1.0;
  return DONE;
}
