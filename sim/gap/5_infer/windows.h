// windows.h - in which part of a coordinate, or of the floor, a residual is largest, and how much it differs
// from flight to flight.
//
// A coordinate is cut into bins that hold equally many rows, and again into bins of equal width. The floor
// is cut into strips of x and of y that hold equally many rows, and the ends of a patch of strips are fitted
// to parts of a strip. The statistic of a window of neighbouring bins is the generalised least squares
// estimate of a constant inside it over its standard error, with the autoregression of the channel and a
// constant over all rows taken into account.
#ifndef SIM_GAP_5_INFER_WINDOWS_H
#define SIM_GAP_5_INFER_WINDOWS_H

#include "gap/2_predict/color.h"
#include "gap/5_infer/windows_cut.h"
#include <math.h>

typedef struct {
  int channel;
  int along; // coordinate; BY_FLIGHT; NOWHERE: a line in the spectrum
  const char *coordinate, *unit;
  double from, to;  // of the coordinate
  double size;      // mean of the residual inside, in the channel's unit; amplitude of a line; rms BY_FLIGHT
  double error;     // standard error of the size (unknown_measure); 0: size over statistic
  double statistic; // held against that of nominal flights; 0: nothing could be judged
  int spreads;      // a name's misfit spreads over at least so many cells like it; 0: it may lie in one
  double explained; // what it takes from the white sum of squares
  int flights;      // BY_FLIGHT: how many have rows
  bool first, last; // no row is before `from`, beyond `to`
  bool world;       // force_x and force_y along the world's x and y: it stays where the vehicle turns
  bool is_pulse;    // in one flight, at that time
  const gap_flight_t *log; // that flight
  bool is_patch;           // from..to is along x, and this along y
  double y_from_m, y_to_m;
} cell_t;

static inline double cell_error(const cell_t *c) {
  return c->error > 0.0 ? c->error : fabs(c->size) / c->statistic;
}

// After the channels the lateral force (those before CH_FZ) once more, in the world's axes.
enum {
  LOOKED = CHANNELS + CH_FZ,
  LOOKED_SMOOTH = CH_SMOOTH + CH_FZ, // of the smooth rows, side by side
  LOOK_ROOM = 2 + LOOKED_SMOOTH
};

// Returns the channel that is number k of a list of rows (0: smooth, 1: range).
static inline int look_channel(int list, int k) {
  return list ? CH_RANGE : k < CH_SMOOTH ? k : CHANNELS - CH_SMOOTH + k;
}

// What is searched. color: of the residual after the cleaning of unknown.h; channels whose colour is not
// used are left out. centred: a constant over all rows is taken out.
typedef struct {
  const set_t *s;
  const model_t *m;
  bool centred;
  double *room; // LOOK_ROOM numbers for each row
  int *bin;     // three numbers for each row
  const double *residual[LOOKED];
  color_t color[LOOKED];
} look_t;

// Returns a look without room, and without the world's axes.
static inline look_t look_of(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                             const color_t color[CHANNELS], bool centred) {
  look_t l = {s, m, centred, .room = NULL};
  for (int ch = 0; ch < CHANNELS; ch++) {
    l.residual[ch] = residual[ch];
    l.color[ch] = color[ch];
  }
  return l;
}

// Each replaces the cell[] of a channel where it finds a larger statistic.
void windows_along(const look_t *l, int coordinate, cell_t cell[LOOKED]);
void windows_on_floor(const look_t *l, cell_t cell[LOOKED]);
// Finds how much flights differ by constants of their own, all together; in the body's axes only.
void windows_by_flight(const look_t *l, cell_t cell[LOOKED]);

#endif
