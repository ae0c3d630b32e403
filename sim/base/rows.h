// rows.h - transposes numbers of eight into rows of eight, and back: number i of one[k] is number k of row i.
//
// Blocks of 4 or 8 rows are transposed in registers. Only where lane_possible().
#ifndef SIM_BASE_ROWS_H
#define SIM_BASE_ROWS_H

#include "base/lane.h"

#ifdef __cplusplus
extern "C" {
#endif

// n contiguous numbers of 64 or of 32 bits from each; rows need not be aligned.
void rows_put_64(int n, char *rows, const char *const one[LANES]);
void rows_get_64(int n, const char *rows, char *const one[LANES]);
void rows_put_32(int n, char *rows, const char *const one[LANES]);
void rows_get_32(int n, const char *rows, char *const one[LANES]);

// Flags of one byte each, into rows of 32 bits that are all set or all clear.
void rows_put_flags(int n, char *rows, const char *const one[LANES]);
void rows_get_flags(int n, const char *rows, char *const one[LANES]);

#ifdef __cplusplus
}
#endif

#endif
