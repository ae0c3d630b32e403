// usd_rows.h - a uSD log with rows left out or changed, as a card that was too slow, or a task that came
// between, would have left it; the CRC is made anew.
#ifndef TEST_RIG_USD_ROWS_H
#define TEST_RIG_USD_ROWS_H

#include <stdbool.h>
#include <stddef.h>

// A row: its event's name, its time, and its values, which may be changed. False: it is left out.
typedef bool (*usd_keep_t)(void *context, const char *event, double t_s, unsigned char *value, size_t n);

// The file `from` of the scratch folder, edited, as `to`. How many rows were left out; -1: no such log.
long usd_rows_edit(const char *from, const char *to, usd_keep_t keep, void *context);

#endif
