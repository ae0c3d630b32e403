// floor.c - stage 1: finds what z is while the vehicle stands on the floor.
//
// A tracked marker or the centre of mass is not at the feet, and an estimate has an error. These few
// centimetres matter to ground and ceiling effects, and decide whether a row before take-off or at a
// touch-down is taken for flight. The columns file gives them, or the rows before take-off do.
#include "gap/1_read/read.h"

#include "base/by_size.h"
#include <math.h>
#include <stdlib.h>

#define STANDS_S 0.5  // least time at rest before take-off
#define STILL_M  0.01 // z's middle four fifths lie within this; a z this near 0 counts as the floor

// True if row i has a command, or else a rotor speed, that is known and too low for flight.
static bool stands(const raw_t *raw, const model_t *vehicle, int i) {
  const double command = raw->v[raw->v[SIG_THRUST] ? SIG_THRUST : SIG_W1][i];
  return isfinite(command) && raw_flies(raw, vehicle, i) == 0;
}

// Returns the number of rows before take-off; 0: the vehicle stands for less than STANDS_S, or nobody knows.
static int rows_before(const raw_t *raw, const model_t *vehicle) {
  int n = 0;
  if (!raw->v[SIG_THRUST] && !has(raw->v, SPEEDS)) return 0;
  while (n < raw->n && stands(raw, vehicle, n)) n++;
  return n < raw->n && n > 0 && raw->t_s[n - 1] - raw->t_s[0] >= STANDS_S ? n : 0;
}

// Finds the median of z in the first n rows; NaN: z moves, or has no value.
static done_t height_in(const raw_t *raw, int n, double *height_m, why_t *why) {
  double *const z_m = malloc((size_t)n * sizeof *z_m);
  int known = 0;
  if (!z_m) return error_failed(why, "out of memory");
  for (int i = 0; i < n; i++)
    if (isfinite(raw->v[SIG_Z][i])) z_m[known++] = raw->v[SIG_Z][i];
  qsort(z_m, (size_t)known, sizeof *z_m, by_size);
  const bool still = known > 0 && z_m[known * 9 / 10] - z_m[known / 10] < STILL_M;
  *height_m = still ? z_m[known / 2] : (double)NAN;
  free(z_m);
  return DONE;
}

// Returns the vehicle's width over the rotors: no point of it is further above its feet.
static double width_m(const model_t *m) {
  return 2.0 * (hypot(m->frame.rotor_x_m[0], m->frame.rotor_y_m[0]) + m->rotor_radius_m);
}

static void lower(raw_t *raw, double by_m) {
  static const signal_id_t heights[] = {SIG_Z, SIG_SET_Z};
  for (unsigned k = 0; k < sizeof heights / sizeof *heights; k++)
    for (int i = 0; raw->v[heights[k]] && i < raw->n; i++) raw->v[heights[k]][i] -= by_m;
}

done_t raw_from_floor(gap_flight_t *f, raw_t *raw, const log_rows_t *rows, why_t *why) {
  const double told_m = rows->columns.rest_height_m;
  double stands_m = (double)NAN;
  f->floor_known = isfinite(told_m);
  if (f->floor_known) lower(raw, told_m);
  const int n = raw->v[SIG_Z] && !f->floor_known ? rows_before(raw, &rows->vehicle) : 0;
  if (n > 0) TRY(height_in(raw, n, &stands_m, why));
  if (isnan(stands_m)) return DONE;
  f->floor_known = fabs(stands_m) <= width_m(&rows->vehicle);
  if (!f->floor_known)
    gap_note(f,
             "before take-off z stands at %.3g m: on what, the log does not say; z is taken to count from "
             "the floor",
             stands_m);
  if (!f->floor_known || fabs(stands_m) <= STILL_M) return DONE;
  f->floor_m = stands_m;
  lower(raw, stands_m);
  gap_note(f,
           "before take-off z stands at %.3g m: that is taken for the floor (if it stood on something, "
           "rest_height_m = 0 in the columns file)",
           stands_m);
  return DONE;
}
