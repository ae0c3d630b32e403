// windows.h - in which part of a coordinate, or of the floor, a residual is largest, and from flight to
// flight.
//
// A coordinate is cut into bins that hold equally many rows, and again into bins of equal width; the floor
// into strips of x and of y that hold equally many, and a patch of strips is fitted to parts of them at its
// ends. For a window of neighbouring bins the statistic is the generalised least squares estimate of a
// constant inside it, over its standard error, with the autoregression of the channel and a constant over all
// rows taken into account.
#ifndef SIM_GAP_5_INFER_WINDOWS_H
#define SIM_GAP_5_INFER_WINDOWS_H

#include "gap/2_predict/color.h"
#include "gap/5_infer/windows_cut.h"

typedef struct {
  int channel;
  int along; // coordinate; NOWHERE: of the spectrum
  const char *coordinate, *unit;
  double from, to;  // of the coordinate
  double size;      // mean of the residual inside, in the channel's unit; of a line its amplitude
  double statistic; // 0: nothing could be judged. It is measured by that of nominal flights
  int spreads;      // over so many cells like it the misfit of a name spreads at least; 0: it may lie in one
  double explained; // by it, of the white sum of squares
  int flights;      // from flight to flight: that have rows
  bool first, last; // no row is before `from`, beyond `to`
  bool world;       // force_x and force_y are along the world's x and y: it stays where the vehicle turns
  bool is_patch;    // from..to is of x, and
  double y_from_m, y_to_m;
} cell_t;

// Behind the channels the lateral force (those before CH_FZ) once more, in the world's axes.
enum {
  LOOKED = CHANNELS + CH_FZ,
  LOOKED_SMOOTH = CH_SMOOTH + CH_FZ, // of the smooth rows, side by side
  LOOK_ROOM = 2 + LOOKED_SMOOTH
};

// Number k of those of a list of rows (0: smooth, 1: range).
static inline int look_channel(int list, int k) {
  return list ? CH_RANGE : k < CH_SMOOTH ? k : CHANNELS - CH_SMOOTH + k;
}

// What is looked at. color: of the residual after the cleaning of unknown.h; one that is not used is not
// looked at. centred: a constant over all rows says nothing.
typedef struct {
  const set_t *s;
  const model_t *m;
  bool centred;
  double *room; // LOOK_ROOM times as many numbers as rows
  int *bin;     // three times as many
  const double *residual[LOOKED];
  color_t color[LOOKED];
} look_t;

// Without room, and without the world's axes.
static inline look_t look_of(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                             const color_t color[CHANNELS], bool centred) {
  look_t l = {s, m, centred, .room = NULL};
  for (int ch = 0; ch < CHANNELS; ch++) {
    l.residual[ch] = residual[ch];
    l.color[ch] = color[ch];
  }
  return l;
}

// Each puts in place of cell[] of a channel what has a larger statistic.
void windows_along(const look_t *l, int coordinate, cell_t cell[LOOKED]);
void windows_on_floor(const look_t *l, cell_t cell[LOOKED]);
// By how much flights differ, each by a constant of its own, all together; in the body's axes.
void windows_by_flight(const look_t *l, cell_t cell[LOOKED]);

#endif
