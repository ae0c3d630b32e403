// whiten.h - residual and columns made white by an autoregression per channel, and their sums of products.
//
// The colours (color.h) are fitted to the residual that the named effects leave. The sums of products are
// kept by block of BLOCK_S: everything that selection asks follows from them.
#ifndef SIM_GAP_5_INFER_WHITEN_H
#define SIM_GAP_5_INFER_WHITEN_H

#include "gap/2_predict/color.h"
#include "gap/4_candidates/candidates.h"

// Rows that one is spread over by their filter: half a period of its cut-off.
enum { FILTER_ROWS = ((int)RESIDUAL_HZ + 2 * RESIDUAL_SMOOTH_HZ - 1) / (2 * RESIDUAL_SMOOTH_HZ) };

// Channels of one kind: what is right in one of them is not wrong in another.
enum { GROUP_FORCES, GROUP_TURNING, GROUP_RANGE, GROUPS };

static inline int group_of(int channel) {
  return channel < CH_FORCES ? GROUP_FORCES : channel < CH_SMOOTH ? GROUP_TURNING : GROUP_RANGE;
}

typedef struct {
  int size, n_block, n_half, n_flight; // size: columns + 1
  int rows;                            // white ones, of all channels
  const int *half;                     // of each block (the set's)
  double *block, *by_half, *total;
  double *others;           // by half-flight: of all the others
  double *by_group[GROUPS]; // of all half-flights, one matrix each
  color_t color[CHANNELS];
} gram_t;

// Whether something that is compared depends on a column. Of an effect's sizes some may have none, as a
// moment about an axis that is left out.
static inline bool gram_shows(const gram_t *g, int column) {
  return g->total[column * (g->size + 1)] > 0.0;
}

// The flight of a block.
static inline int gram_flight(const gram_t *g, int block) {
  return g->half[block] / 2;
}

// What is taken to be known of the residual: columns and their values.
typedef struct {
  int n;
  const int *column;
  const double *b;
  bool plain; // no colour, spread alone
  // By channel: flights differ by that much at least, whatever these rows show; null: as these rows show.
  const double *between;
} explained_t;

// The colours are those of what `known` leaves, or with a ridge (by column) of what all columns together
// leave.
MUST_CHECK done_t gram_make(gram_t *g, const set_t *s, const design_t *t, const explained_t *known,
                            const double *ridge, why_t *why);
// Of some columns (by column) and the residual, `total` anew, the others 0 there; the rest of it stays as it
// is. known: as above, or null: in the colours that it has. FAILED: no memory.
MUST_CHECK done_t gram_renew(gram_t *g, const set_t *s, const design_t *t, const explained_t *known,
                             const bool *some, why_t *why);
// Their `total` and colours alone. ridge: as above, or null: in the colours of the residual. between: as
// explained_t has it.
MUST_CHECK done_t gram_make_total(gram_t *g, const set_t *s, const design_t *t, const double *ridge,
                                  const double *between, why_t *why);
void gram_free(gram_t *g);

// What flights differ by, by channel, in what a model leaves (color.h). FAILED: no memory.
MUST_CHECK done_t whiten_between(set_t *s, const model_t *m, double between[CHANNELS], why_t *why);
// White sum of squares that a model leaves, in the colours of another one's residual.
MUST_CHECK done_t whiten_left(set_t *s, const model_t *m, const color_t color[CHANNELS], double *left,
                              why_t *why);

#endif
