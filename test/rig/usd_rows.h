// usd_rows.h - a uSD log with rows left out or changed, as a card that is too slow, or a task that
// interrupts, would leave it; the CRC is recomputed.
#ifndef TEST_RIG_USD_ROWS_H
#define TEST_RIG_USD_ROWS_H

#include <stdbool.h>
#include <stddef.h>

// Called with each row: its event's name, time and values, which it may change. False: leave the row out.
typedef bool (*usd_keep_t)(void *context, const char *event, double t_s, unsigned char *value, size_t n);

// Edits the file `from` of the scratch folder into `to`. Returns how many rows were left out; -1: no such
// log.
long usd_rows_edit(const char *from, const char *to, usd_keep_t keep, void *context);

#endif
