// unknown.h - where a residual is largest: by coordinate, range of it and channel.
//
// Every coordinate is cut into bins that hold equally many rows. For a window of neighbouring bins the
// statistic is the generalised least squares estimate of a constant inside it, over its standard error, with
// the autoregression of the channel and a constant over all rows taken into account. Such a maximum means
// something against the same maximum on nominal flights. The lateral force is looked at in the body's axes
// and, level, in the world's.
#ifndef SIM_GAP_5_INFER_UNKNOWN_H
#define SIM_GAP_5_INFER_UNKNOWN_H

#include "gap/5_infer/whiten.h"

typedef struct {
  int channel;
  const char *coordinate, *unit; // of the coordinate
  double from, to;               // of the coordinate
  double size;                   // mean of the residual inside, in the channel's unit
  double statistic;              // 0: nothing could be judged
  bool last;                     // no row is beyond `to`
  bool world; // force_x and force_y are along the world's x and y: it stays where the vehicle turns
} cell_t;

// Takes out of a residual what depends on any one coordinate, or on several of them added: what is left is
// noise. FAILED: no memory.
MUST_CHECK done_t unknown_clean(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                why_t *why);

// Colours of the residual after such cleaning. FAILED: no memory.
MUST_CHECK done_t unknown_colors(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                 color_t color[CHANNELS], why_t *why);

// color: of the residual after such cleaning, in the body's axes, which alone are then looked at; a null
// pointer: they are formed, and the world's axes are looked at, too. FAILED: no memory. residual: by channel
// and row.
MUST_CHECK done_t unknown_largest(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                  const color_t *color, bool centred, cell_t *cell, why_t *why);

// The same along one coordinate.
MUST_CHECK done_t unknown_along(const set_t *s, const model_t *m, int coordinate,
                                double *const residual[CHANNELS], const color_t *color, cell_t *cell,
                                why_t *why);

#define UNKNOWN_BINS 12

// The bin of every row of a list (0: smooth, 1: range) along a coordinate. False: it is not there or does not
// move. room: twice as many numbers as rows.
bool unknown_bins(const set_t *s, const model_t *m, int coordinate, int list, double *room, int *bin);

// Coordinates, for those who look where something lies.
extern const int coordinate_count;
const char *coordinate_name(int i);
const char *coordinate_unit(int i);
bool coordinate_is_place(int i); // or a time
// NaN where the log has it not.
double coordinate_of(int i, const grid_t *g, const model_t *m, int point);

#endif
