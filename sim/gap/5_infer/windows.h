// windows.h - in which part of a coordinate, or of the floor, a residual is largest.
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
  double explained; // by it, of the white sum of squares
  bool last;        // no row is beyond `to`
  bool world;       // force_x and force_y are along the world's x and y: it stays where the vehicle turns
  bool is_patch;    // from..to is of x, and
  double y_from_m, y_to_m;
} cell_t;

enum { LOOK_ROOM = 2 + 8 }; // 8: of all channels, side by side

// What is looked at. color: of the residual after the cleaning of unknown.h, by channel; one that is not used
// is not looked at. centred: a constant over all rows says nothing.
typedef struct {
  const set_t *s;
  const model_t *m;
  double *const *residual; // by channel and row
  const color_t *color;
  bool centred;
  double *room; // LOOK_ROOM times as many numbers as rows
  int *bin;     // three times as many
} look_t;

// Each puts in place of cell[channel] what has a larger statistic.
void windows_along(const look_t *l, int coordinate, cell_t cell[CHANNELS]);
void windows_on_floor(const look_t *l, cell_t cell[CHANNELS]);

#endif
