// unknown.h - what is left that no named effect explains: where it is, and whether nominal flights, in which
// nothing is hidden, show as much.
//
// A look is one way to search a residual: along a coordinate, on patches of the floor (windows.h), from
// flight to flight, for pulses, or for lines (in_time.h). Each look searches every channel that it applies
// to, and the lateral force in the body's axes and, level, in the world's. What feedback leaves differs from
// look to look by far more than chance does, so each look is held against what the same look finds in
// nominal flights. The one that explains most beyond that is told.
#ifndef SIM_GAP_5_INFER_UNKNOWN_H
#define SIM_GAP_5_INFER_UNKNOWN_H

#include "gap/2_predict/lines.h"
#include "gap/5_infer/limits.h"
#include "gap/5_infer/whiten.h"
#include "gap/5_infer/windows.h"
#include <math.h>

// --- the residual without what depends on anything --------------------------------------------------------

// Takes out of a residual what depends on any one coordinate, or on a sum of functions of several: what is
// left is noise. FAILED: no memory.
MUST_CHECK done_t unknown_clean(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                why_t *why);

// Fits the colours of the residual after such cleaning. FAILED: no memory.
MUST_CHECK done_t unknown_colors(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                 color_t color[CHANNELS], why_t *why);

// --- the largest cell of each channel, along coordinates, in the body's axes -------------------------------

// Finds the largest cells along the coordinates from..to-1. color: of unknown_colors(). residual: by channel
// and row. centred: as in look_t. FAILED: no memory.
MUST_CHECK done_t unknown_along(const set_t *s, const model_t *m, int from, int to,
                                double *const residual[CHANNELS], const color_t color[CHANNELS], bool centred,
                                cell_t cell[CHANNELS], why_t *why);

// --- all looks --------------------------------------------------------------------------------------------

// Looks before LOOK_FLOOR are along a coordinate, and have its number.
enum { LOOK_FLOOR = COORDINATES, LOOK_FLIGHTS, LOOK_PULSE, LOOK_LINE, UNKNOWN_LOOKS };

// Each channel, and the lateral force (the channels before CH_FZ) once more, in the world's axes.
enum { UNKNOWN_CELLS = (CHANNELS + CH_FZ) * UNKNOWN_LOOKS };

// The largest cell of each channel and look.
typedef struct {
  cell_t cell[UNKNOWN_CELLS];
} scan_t;

static inline int unknown_cell(int channel, int look, bool world) {
  return (world ? CHANNELS + channel : channel) * UNKNOWN_LOOKS + look;
}

// Runs all looks on a residual. FAILED: no memory.
MUST_CHECK done_t unknown_scan(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                               scan_t *scan, why_t *why);
// Returns the largest statistic along any coordinate.
double unknown_in_windows(const scan_t *scan);

typedef struct {
  double chance[UNKNOWN_CELLS]; // bound of the statistic that no nominal flight exceeds
  double bound[UNKNOWN_CELLS];  // the same, with what a right form with other numbers leaves
  cell_t cell;                  // what explains most beyond its bound or, in a tie, what is told first
  double cell_bound;
  bool found;  // it is beyond its bound
  cell_t also; // of the same force, along something else, in a tie with it; statistic 0: none
} judged_t;

// Share of what the best cell explains, from which on another is in a tie with it: a window ends on a bin,
// and may miss a fifth of what is there.
#define UNKNOWN_TIE 0.8

// Judges the scan of a log by n scans of nominal flights. misfit: by channel, rms of what a right model
// leaves; six times as much is the least that is told, as it is the least that is named.
void unknown_judge(const scan_t *log, const scan_t *nominal, int n, const double misfit[CHANNELS],
                   judged_t *to);

// Finds the size of what lies along a coordinate or on a patch, and its error: least squares of the rows
// inside against those outside it, beside a constant of each flight, and blocks of 2 s that are independent.
// The looks find it by white rows, which make most of its ends: there the rows' filter, and ends that are off
// by a part of a bin, take a third of what is crossed in half a second. FAILED: no memory.
MUST_CHECK done_t unknown_measure(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                  cell_t *cell, why_t *why);

// False if the size may as well be none. A look weighs white rows, in which a single kick counts much; where
// the rows inside are on the whole like those outside, nothing lies there.
static inline bool unknown_is_sure(const cell_t *cell) {
  return fabs(cell->size) > SCORE_ERRORS * cell_error(cell);
}

// Leaves a cell of the scan out of what is judged.
static inline void unknown_leave_out(scan_t *scan, const cell_t *cell) {
  for (int k = 0; k < UNKNOWN_CELLS; k++)
    if (scan->cell[k].statistic == cell->statistic && scan->cell[k].channel == cell->channel)
      scan->cell[k].statistic = scan->cell[k].explained = 0.0;
}

// Sets, by channel, what flights differ by in a residual where that is beyond its bound (as above; by n
// nominal flights, 1 or more); elsewhere its statistic is 0. FAILED: no memory.
MUST_CHECK done_t unknown_differ(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                 const scan_t *nominal, int n, const double misfit[CHANNELS],
                                 cell_t cell[CHANNELS], why_t *why);

// Returns the cell of the channel in a group (GROUP_..) that differs most from flight to flight, if it is
// beyond its bound and explains at least UNKNOWN_TIE of what any other look explains in the group; else
// null.
const cell_t *unknown_by_flight(const scan_t *log, const judged_t *judged, int group);

#endif
