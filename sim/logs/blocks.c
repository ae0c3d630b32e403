// blocks.c - the files of one flight that cfclient writes, as one table.
#include "logs/blocks.h"

#include "base/stream.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double t_ms, v[CSV_COLUMN_MAX];
  bool any;
} stand_t;

typedef struct {
  csv_file_t *csv;
  const char *path;
  int columns, time;
  stand_t before, after; // the file's rows around the table's present row
  bool ended;
  double late_ms, apart_ms; // sums over its rows (blocks_times_t)
  int fresh;
} block_t;

struct blocks {
  int n, rows; // rows: the file whose rows are those of the table
  block_t block[BLOCKS_MAX];
};

// Column c of file k is number k * CSV_COLUMN_MAX + c.
static const block_t *of(const blocks_t *b, int column) {
  return &b->block[column / CSV_COLUMN_MAX];
}

static done_t open_block(block_t *block, const char *path, why_t *why) {
  FILE *stream;
  TRY(stream_open(&stream, path, why));
  TRY(csv_open_stream(&block->csv, stream, path, why));
  block->path = path;
  block->columns = csv_columns(block->csv);
  block->time = csv_find(block->csv, "Timestamp");
  if (block->time < 0) block->time = csv_find(block->csv, "timestamp");
  if (block->time >= 0) return DONE;
  return csv_refuse(block->csv, -1, why,
                    "no column Timestamp; allowed: files of cfclient, one for each log block of a flight");
}

static done_t check_names(const blocks_t *b, why_t *why) {
  for (int k = 1; k < b->n; k++)
    for (int c = 0; c < b->block[k].columns; c++) {
      if (c == b->block[k].time) continue;
      for (int other = 0; other < k; other++)
        if (csv_find(b->block[other].csv, csv_name(b->block[k].csv, c)) >= 0)
          return csv_refuse(
              b->block[k].csv, c, why,
              "stands in %.150s, too; allowed: files of one flight, each with a log block of its own",
              b->block[other].path);
    }
  return DONE;
}

done_t blocks_open(blocks_t **blocks, const char *const *path, int n, why_t *why) {
  *blocks = NULL;
  if (n > BLOCKS_MAX)
    return error_set(why, "%.300s and others: %d files of one flight; allowed: %d", path[0], n, BLOCKS_MAX);
  blocks_t *const b = calloc(1, sizeof *b);
  if (!b) return error_failed(why, "out of memory");
  done_t status = DONE;
  for (int k = 0; k < n && status == DONE; k++) {
    status = open_block(&b->block[k], path[k], why);
    b->n += status == DONE;
    if (status == DONE && csv_find(b->block[k].csv, "motor.m1") >= 0) b->rows = k;
  }
  if (status == DONE) status = check_names(b, why);
  if (status == DONE)
    *blocks = b;
  else
    blocks_close(b);
  return status;
}

void blocks_close(blocks_t *b) {
  if (!b) return;
  for (int k = 0; k < BLOCKS_MAX; k++) csv_close(b->block[k].csv);
  free(b);
}

int blocks_find(const blocks_t *b, const char *name) {
  for (int i = 0; i < b->n; i++) {
    const int k = (b->rows + i) % b->n, c = csv_find(b->block[k].csv, name); // the time is that of the rows
    if (c >= 0) return k * CSV_COLUMN_MAX + c;
  }
  return -1;
}

const char *blocks_name(const blocks_t *b, int column) {
  return csv_name(of(b, column)->csv, column % CSV_COLUMN_MAX);
}

long blocks_line(const blocks_t *b) {
  return csv_line(b->block[b->rows].csv);
}

void blocks_forgive_cut(blocks_t *b) {
  for (int k = 0; k < b->n; k++) csv_forgive_cut(b->block[k].csv);
}

bool blocks_cut_off(const blocks_t *b) {
  bool any = false;
  for (int k = 0; k < b->n; k++) any = any || csv_cut_off(b->block[k].csv);
  return any;
}

const char *blocks_path(const blocks_t *b, int column) {
  return column < 0 ? b->block[b->rows].path : of(b, column)->path;
}

// Reads the file's next row into `after`.
static done_t step(block_t *block, why_t *why) {
  bool more;
  block->before = block->after;
  block->after.any = false;
  TRY(csv_next(block->csv, &more, why));
  block->ended = !more;
  if (!more) return DONE;
  stand_t *const now = &block->after;
  for (int c = 0; c < block->columns; c++) TRY(csv_number(block->csv, c, CSV_GAP_MARKED, &now->v[c], why));
  TRY(csv_number(block->csv, block->time, CSV_GAP_REFUSED, &now->t_ms, why));
  now->any = true;
  if (!block->before.any || now->t_ms >= block->before.t_ms) return DONE;
  return csv_refuse(block->csv, block->time, why,
                    "%.9g ms after %.9g ms; allowed: time that increases from row to row", now->t_ms,
                    block->before.t_ms);
}

// Adds to the sums if the file has a newer row than at the table's last row.
static void count(block_t *block, double last_ms, double now_ms) {
  if (!block->before.any || !(block->before.t_ms > last_ms)) return;
  block->fresh++;
  block->late_ms += now_ms - block->before.t_ms;
  block->apart_ms += block->before.t_ms - last_ms;
}

done_t blocks_next(blocks_t *b, bool *more, why_t *why) {
  block_t *const rows = &b->block[b->rows];
  TRY(step(rows, why));
  *more = rows->after.any;
  for (int k = 0; k < b->n && *more; k++) {
    block_t *const other = &b->block[k];
    const double last_ms = other->before.any ? other->before.t_ms : HUGE_VAL;
    while (other != rows && !other->ended && !(other->after.any && other->after.t_ms > rows->after.t_ms))
      TRY(step(other, why));
    if (other != rows) count(other, last_ms, rows->after.t_ms);
  }
  return DONE;
}

// Returns the angle without the whole turns by which a heading may jump.
static double near(double angle_deg, double to_deg) {
  return angle_deg - 360.0 * nearbyint((angle_deg - to_deg) / 360.0);
}

static bool ends_in(const char *name, const char *end) {
  const size_t n = strlen(name), m = strlen(end);
  return n >= m && strcmp(name + n - m, end) == 0;
}

static double drawn(const block_t *block, int c, double t_ms) {
  const stand_t *const a = &block->before, *const z = &block->after;
  const char *const name = csv_name(block->csv, c);
  if (!a->any || t_ms - a->t_ms > BLOCKS_APART_MS) return (double)NAN;
  if (strncmp(name, "range.", 6) == 0 || t_ms <= a->t_ms) return a->v[c];
  if (!z->any || z->t_ms - a->t_ms > BLOCKS_APART_MS) return (double)NAN;
  const double end = ends_in(name, ".yaw") ? near(z->v[c], a->v[c]) : z->v[c];
  return a->v[c] + (t_ms - a->t_ms) / (z->t_ms - a->t_ms) * (end - a->v[c]);
}

done_t blocks_number(const blocks_t *b, int column, csv_gap_t gap, double *value, why_t *why) {
  const block_t *const block = of(b, column), *const rows = &b->block[b->rows];
  const int c = column % CSV_COLUMN_MAX;
  if (block == rows) return csv_number(block->csv, c, gap, value, why);
  *value = drawn(block, c, rows->after.t_ms);
  if (gap != CSV_GAP_MARKED && isinf(*value))
    return csv_refuse(block->csv, c, why, "not a number; allowed: a number");
  if (gap == CSV_GAP_REFUSED && isnan(*value))
    return csv_refuse(block->csv, c, why, "a gap; allowed: a number");
  if (isnan(*value) && !isnan(block->before.v[c]) && isinf(block->after.v[c])) *value = HUGE_VAL;
  return DONE;
}

blocks_times_t blocks_times(const blocks_t *b, int column) {
  const block_t *const block = of(b, column);
  const double per_row_s = block->fresh ? 1e-3 / block->fresh : 0.0;
  return (blocks_times_t){per_row_s * block->late_ms, per_row_s * block->apart_ms};
}
