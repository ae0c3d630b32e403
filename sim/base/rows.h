// rows.h - numbers of eight into rows of eight, and back: number i of one[k] is number k of row i.
//
// A block of 4 or 8 rows is turned in registers. Only where lane_possible().
#ifndef SIM_BASE_ROWS_H
#define SIM_BASE_ROWS_H

#include "base/lane.h"

#ifdef __cplusplus
extern "C" {
#endif

// n numbers of 64 bits or 32 of each, one behind the other; no row need be aligned.
void rows_put_64(int n, char *rows, const char *const one[LANES]);
void rows_get_64(int n, const char *rows, char *const one[LANES]);
void rows_put_32(int n, char *rows, const char *const one[LANES]);
void rows_get_32(int n, const char *rows, char *const one[LANES]);

// Flags, of a byte each, into rows of 32 bits that are all set or none.
void rows_put_flags(int n, char *rows, const char *const one[LANES]);
void rows_get_flags(int n, const char *rows, char *const one[LANES]);

#ifdef __cplusplus
}
#endif

#endif
