// whiten.h - residual and columns made white by an autoregression per channel, and their sums of products.
//
// The colours (color.h) are fitted to the residual that the named effects leave. The sums of products are
// kept by block of BLOCK_S: everything that selection asks follows from them.
#ifndef SIM_GAP_5_INFER_WHITEN_H
#define SIM_GAP_5_INFER_WHITEN_H

#include "gap/2_predict/color.h"
#include "gap/4_candidates/candidates.h"

// Rows over which the rows' filter spreads a single one: half a period of its cut-off.
enum { FILTER_ROWS = ((int)RESIDUAL_HZ + 2 * RESIDUAL_SMOOTH_HZ - 1) / (2 * RESIDUAL_SMOOTH_HZ) };

// Groups of channels of one kind: what is right in one group is not wrong in another.
enum { GROUP_FORCES, GROUP_TURNING, GROUP_RANGE, GROUPS };

static inline int group_of(int channel) {
  return channel < CH_FORCES ? GROUP_FORCES : channel < CH_SMOOTH ? GROUP_TURNING : GROUP_RANGE;
}

typedef struct {
  int size, n_block, n_half, n_flight; // size: columns + 1
  int rows;                            // white rows of all channels
  const int *half;                     // half-flight of each block (the set's)
  double *block, *by_half, *total;
  double *others;           // by half-flight: sums of all the others
  double *by_group[GROUPS]; // by half-flight, one matrix each
  color_t color[CHANNELS];
} gram_t;

// True if anything that is compared depends on a column. Some sizes of an effect may show nowhere, such as a
// moment about an axis that is left out.
static inline bool gram_shows(const gram_t *g, int column) {
  return g->total[column * (g->size + 1)] > 0.0;
}

// Returns the flight of a block.
static inline int gram_flight(const gram_t *g, int block) {
  return g->half[block] / 2;
}

// What is taken to be known of the residual: columns and their values.
typedef struct {
  int n;
  const int *column;
  const double *b;
  bool plain; // no colour, spread alone
  // By channel: the least that flights differ by, whatever these rows show; null: as these rows show.
  const double *between;
} explained_t;

// Forms all sums, in the colours of what `known` leaves or, with a ridge (by column), of what all columns
// together leave. FAILED: no memory.
MUST_CHECK done_t gram_make(gram_t *g, const set_t *s, const design_t *t, const explained_t *known,
                            const double *ridge, why_t *why);
// Forms `total` anew for some columns (by column) and the residual, and sets the others in it to 0; all
// other sums stay as they are. known: as above, or null: in the present colours. FAILED: no memory.
MUST_CHECK done_t gram_renew(gram_t *g, const set_t *s, const design_t *t, const explained_t *known,
                             const bool *some, why_t *why);
// Forms `total` and the colours alone. ridge: as above, or null: in the colours of the residual. between: as
// in explained_t. FAILED: no memory.
MUST_CHECK done_t gram_make_total(gram_t *g, const set_t *s, const design_t *t, const double *ridge,
                                  const double *between, why_t *why);
void gram_free(gram_t *g);

// Sets what flights differ by, by channel, in what a model leaves (color_t.between). FAILED: no memory.
MUST_CHECK done_t whiten_between(set_t *s, const model_t *m, double between[CHANNELS], why_t *why);
// Sets *left to the white sum of squares that a model leaves, in the colours of another model's residual.
// FAILED: no memory.
MUST_CHECK done_t whiten_left(set_t *s, const model_t *m, const color_t color[CHANNELS], double *left,
                              why_t *why);

#endif
