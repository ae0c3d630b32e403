// unknown.h - what is left that no name explains: where it is, and whether flights in which nothing is hidden
// show as much.
//
// A look is one way to look at a residual: along a coordinate, on patches of the floor (windows.h), from
// flight to flight, for pulses, for lines (in_time.h). Each channel is looked at in each way; the lateral
// force in the body's axes and, level, in the world's. What feedback leaves differs from look to look by far
// more than chance: each is measured against what the same look finds in nominal flights, and the one that
// explains most beyond that tells.
#ifndef SIM_GAP_5_INFER_UNKNOWN_H
#define SIM_GAP_5_INFER_UNKNOWN_H

#include "gap/2_predict/lines.h"
#include "gap/5_infer/whiten.h"
#include "gap/5_infer/windows.h"

// --- the residual without what depends on anything --------------------------------------------------------

// Takes out of a residual what depends on any one coordinate, or on several of them added: what is left is
// noise. FAILED: no memory.
MUST_CHECK done_t unknown_clean(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                why_t *why);

// Colours of the residual after such cleaning. FAILED: no memory.
MUST_CHECK done_t unknown_colors(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                 color_t color[CHANNELS], why_t *why);

// --- the largest cell of each channel, along coordinates, in the body's axes -------------------------------

// Along those from..to-1. color: of unknown_colors. residual: by channel and row. FAILED: no memory.
MUST_CHECK done_t unknown_along(const set_t *s, const model_t *m, int from, int to,
                                double *const residual[CHANNELS], const color_t color[CHANNELS], bool centred,
                                cell_t cell[CHANNELS], why_t *why);

// --- all looks --------------------------------------------------------------------------------------------

// Those before the floor are along a coordinate.
enum { LOOK_FLOOR = COORDINATES, LOOK_FLIGHTS, LOOK_PULSE, LOOK_LINE, UNKNOWN_LOOKS };

// Each channel, and the lateral force (the channels before CH_FZ) in the world's axes, too.
enum { UNKNOWN_CELLS = (CHANNELS + CH_FZ) * UNKNOWN_LOOKS };

// The largest cell of each channel and look.
typedef struct {
  cell_t cell[UNKNOWN_CELLS];
} scan_t;

static inline int unknown_cell(int channel, int look, bool world) {
  return (world ? CHANNELS + channel : channel) * UNKNOWN_LOOKS + look;
}

// FAILED: no memory.
MUST_CHECK done_t unknown_scan(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                               scan_t *scan, why_t *why);
// The largest statistic along any coordinate.
double unknown_in_windows(const scan_t *scan);

typedef struct {
  double chance[UNKNOWN_CELLS]; // of the statistics: no nominal flight goes beyond
  double bound[UNKNOWN_CELLS];  // with what a right form with other numbers leaves
  cell_t cell;                  // of those that explain most beyond what their bound would: a place first
  double cell_bound;
  bool found;  // it is beyond its bound
  cell_t also; // of the same force, along something else, explains as much but for a fifth; statistic 0: none
} judged_t;

// Of what explains most, that explains as much: a window ends on a bin, and may miss a fifth of what is
// there.
#define UNKNOWN_TIE 0.8

// nominal: n scans of flights in which nothing is hidden. misfit: by channel, what a right model leaves, rms:
// six times as much is as large as an effect that is named.
void unknown_judge(const scan_t *log, const scan_t *nominal, int n, const double misfit[CHANNELS],
                   judged_t *to);

// By channel, what flights differ by in a residual, where that is beyond its bound (as above; of n nominal
// flights, 1 or more); else its statistic is 0. FAILED: no memory.
MUST_CHECK done_t unknown_differ(const set_t *s, const model_t *m, double *const residual[CHANNELS],
                                 const scan_t *nominal, int n, const double misfit[CHANNELS],
                                 cell_t cell[CHANNELS], why_t *why);

// Of a group of channels (GROUP_..) the one that differs most from flight to flight, if that is beyond its
// bound and no other look explains more in the group, but for a fifth; else null.
const cell_t *unknown_by_flight(const scan_t *log, const judged_t *judged, int group);

#endif
