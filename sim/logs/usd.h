// usd.h - the Crazyflie's uSD log files, versions 1 and 2, one row at a time, in fixed memory (CRC: zlib).
//
//   0xBC | u16 version | u16 events | per event: u16 id, name\0, u16 variables, then `group.name(T)\0` each
//   records: u16 event id, u64 microseconds (version 1: u32 milliseconds), packed little-endian values
//   last 4 bytes: CRC-32 of all before
//
// T is one of B b H h I i f e. Rows are the records of the event `fixedFrequency`; a file without it: of all
// events, merged by time, NaN where an event does not hold a column. Everything before a damage is good:
// there the rows end, and usd_damage says where. Files may be pipes and of any length.
#ifndef SIM_LOGS_USD_H
#define SIM_LOGS_USD_H

#include "base/error.h"
#include <stdbool.h>
#include <stdio.h>

#define USD_MAGIC      0xBC
#define USD_EVENT_MAX  64
#define USD_COLUMN_MAX 256
#define USD_NAME_MAX   64

typedef struct usd_file usd_file_t;

// Reads the header. The stream is closed with the file, also where this fails. BAD_INPUT: another version,
// an unknown type, no events or too many, a header that is cut off (all with the byte); *file is null then.
MUST_CHECK done_t usd_open(usd_file_t **file, FILE *stream, const char *path, why_t *why);

// A null pointer is allowed.
void usd_close(usd_file_t *file);

// The column called `name` (`timestamp`: milliseconds), counted from 0; -1 if there is none.
int usd_find(const usd_file_t *file, const char *name);

// The name of a column that there is.
const char *usd_name(const usd_file_t *file, int column);

// From now on rows are the records of these events alone, in the order of the file. False: it names none of
// them, and nothing has changed.
bool usd_only(usd_file_t *file, const char *const *events, int n);

// True if that event has this column.
bool usd_has(const usd_file_t *file, const char *event, int column);

// The name of the event that the present row is a record of.
const char *usd_event(const usd_file_t *file);

// The next row; false at the end or at a damage.
bool usd_next(usd_file_t *file);

// Of the present row.
double usd_value(const usd_file_t *file, int column);

// The number of the present record, from 1, over all events.
long usd_record(const usd_file_t *file);

// After the last row: what is damaged and at which byte; a null pointer if nothing is.
const char *usd_damage(const usd_file_t *file);

#endif
