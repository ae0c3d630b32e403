// usd_rows.c - a uSD log with rows left out or changed.
#include "rig/usd_rows.h"

#include "rig/scratch.h"
#include "rig/usd_bytes.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EVENTS 8
#define HEAD   10 // bytes of a row: event, microseconds

typedef struct {
  unsigned id;
  const char *name;
  size_t bytes;
} event_t;

typedef struct {
  usd_bytes_t file;
  event_t event[EVENTS];
  int n;
  size_t start; // of the rows
} log_t;

static uint64_t number(const unsigned char *at, int bytes) {
  uint64_t value = 0;
  for (int i = bytes - 1; i >= 0; i--) value = value << 8 | at[i];
  return value;
}

static bool load(const char *name, log_t *log) {
  FILE *const file = fopen(scratch_path(name), "rb");
  if (!file) return false;
  for (int c; (c = getc(file)) != EOF;) usd_put(&log->file, (uint64_t)c, 1);
  fclose(file);
  const unsigned char *const b = log->file.byte;
  log->n = (int)number(b + 3, 2);
  size_t at = 5;
  for (int i = 0; i < log->n && i < EVENTS; i++) {
    event_t *const e = &log->event[i];
    e->id = (unsigned)number(b + at, 2);
    e->name = (const char *)b + at + 2;
    at += 2 + strlen(e->name) + 1;
    const int variables = (int)number(b + at, 2);
    at += 2;
    for (int k = 0; k < variables; k++) {
      const char *const variable = (const char *)b + at;
      e->bytes += variable[strlen(variable) - 2] == 'B' ? 1 : 4;
      at += strlen(variable) + 1;
    }
  }
  log->start = at;
  return log->n <= EVENTS;
}

static const event_t *event_of(const log_t *log, unsigned id) {
  for (int i = 0; i < log->n; i++)
    if (log->event[i].id == id) return &log->event[i];
  return NULL;
}

long usd_rows_edit(const char *from, const char *to, usd_keep_t keep, void *context) {
  log_t log = {.n = 0};
  if (!load(from, &log)) return -1;
  unsigned char *const b = log.file.byte;
  usd_bytes_t edited = {0};
  long left_out = 0;
  for (size_t i = 0; i < log.start; i++) usd_put(&edited, b[i], 1);
  for (size_t at = log.start; at + 4 < log.file.n;) {
    const event_t *const e = event_of(&log, (unsigned)number(b + at, 2));
    if (!e) abort();
    const double t_s = 1e-6 * (double)number(b + at + 2, 8);
    const bool kept = keep(context, e->name, t_s, b + at + HEAD, e->bytes);
    for (size_t i = 0; kept && i < HEAD + e->bytes; i++) usd_put(&edited, b[at + i], 1);
    left_out += !kept;
    at += HEAD + e->bytes;
  }
  usd_put_crc(&edited);
  (void)scratch_file(to, (const char *)edited.byte, (long)edited.n);
  usd_bytes_free(&edited);
  usd_bytes_free(&log.file);
  return left_out;
}
