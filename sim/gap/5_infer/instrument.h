// instrument.h - the instruments of the confirming step (confirm.h): what the names' columns
// would be on a flight of the model along the set points, without noise or disturbance. Within sim/gap only.
#ifndef SIM_GAP_5_INFER_INSTRUMENT_H
#define SIM_GAP_5_INFER_INSTRUMENT_H

#include "gap/5_infer/found.h"

#define CONFIRM_LAGS  3
#define CONFIRM_LAG_S 0.08                    // from one to the next
#define INSTRUMENTS   (CONFIRM_LAGS * GROUPS) // of a column: forces, turning and range have their own

typedef struct {
  candidates_t names; // those that are in the model alone
  int of[NAMED_MAX * 2];
  set_t *s;
  const model_t *base;
  model_t now; // with them
  const manner_t *manner;
  table_t table; // columns of the names, of the instruments, and the residual
} confirming_t;

// The names' columns, with room for the instruments' behind them. FAILED: no memory.
MUST_CHECK done_t confirm_table(confirming_t *t, why_t *why);

// Fills these. flew: false: the model cannot be flown along the set points. FAILED: no memory.
MUST_CHECK done_t confirm_instruments(confirming_t *t, bool *flew, why_t *why);

#endif
