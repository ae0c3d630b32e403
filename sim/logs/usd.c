// usd.c - the Crazyflie's uSD log files.
#include "logs/usd.h"

#include "base/number.h"
#include "logs/crc_stream.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define MERGED 32 // records that wait for older ones of another event

typedef struct {
  unsigned id;
  char name[USD_NAME_MAX];
  int n, bytes;               // variables; bytes of a record without its head
  int column[USD_COLUMN_MAX]; // of each variable
  char type[USD_COLUMN_MAX];
  bool read;      // its records are rows
  double last_ms; // time of its last record
} event_t;

typedef struct {
  long record;
  const event_t *event;
  double value[USD_COLUMN_MAX];
} row_t;

struct usd_file {
  crc_stream_t in;
  char path[256];
  unsigned version;
  int n_event, n_column;
  event_t event[USD_EVENT_MAX];
  char name[USD_COLUMN_MAX][USD_NAME_MAX];
  long records;
  bool ended;
  bool in_order; // of the file: rows do not wait
  char damage[160];
  int n_waiting;
  row_t row, waiting[MERGED + 1]; // oldest last
};

// --- header --------------------------------------------------------------------------------------------

static done_t refuse(const usd_file_t *f, why_t *why, const char *what) {
  return error_set(why, "%s: byte %llu: %s", f->path, (unsigned long long)f->in.taken, what);
}

static done_t take_number(usd_file_t *f, int bytes, unsigned *value, why_t *why) {
  *value = 0;
  if (!crc_stream_have(&f->in, (size_t)bytes)) return refuse(f, why, "the file is cut off in its header");
  *value = (unsigned)crc_stream_take(&f->in, bytes);
  return DONE;
}

static done_t take_name(usd_file_t *f, char name[USD_NAME_MAX + 3], why_t *why) {
  for (int i = 0; i < USD_NAME_MAX + 3; i++) {
    unsigned c;
    TRY(take_number(f, 1, &c, why));
    name[i] = (char)c;
    if (c == 0) return DONE;
  }
  return refuse(f, why, "a name is too long; allowed: 63 bytes");
}

static done_t take_variable(usd_file_t *f, event_t *event, why_t *why) {
  char name[USD_NAME_MAX + 3], shown[NUMBER_SHOWN], what[120];
  TRY(take_name(f, name, why));
  const size_t size = strlen(name);
  const char type = size > 3 && name[size - 3] == '(' && name[size - 1] == ')' ? name[size - 2] : '?';
  if (!strchr(CRC_STREAM_TYPES, type)) {
    snprintf(what, sizeof what, "variable `%s`: unknown type; allowed: NAME(T) with T one of %s",
             number_shown(name, shown), CRC_STREAM_TYPES);
    return refuse(f, why, what);
  }
  name[size - 3] = '\0';
  int column = usd_find(f, name);
  if (column < 0) {
    if (f->n_column == USD_COLUMN_MAX) return refuse(f, why, "too many variables; allowed: 255");
    column = f->n_column++;
    memcpy(f->name[column], name, size - 2);
  }
  if (event->n == USD_COLUMN_MAX) return refuse(f, why, "too many variables; allowed: 255");
  event->column[event->n] = column;
  event->type[event->n++] = type;
  event->bytes += crc_stream_bytes(type);
  return DONE;
}

static done_t take_event(usd_file_t *f, bool *fixed, why_t *why) {
  event_t *const event = &f->event[f->n_event];
  char name[USD_NAME_MAX + 3];
  unsigned n;
  TRY(take_number(f, 2, &event->id, why));
  TRY(take_name(f, name, why));
  TRY(take_number(f, 2, &n, why));
  *fixed = strcmp(name, "fixedFrequency") == 0;
  snprintf(event->name, sizeof event->name, "%.*s", USD_NAME_MAX - 1, name);
  for (unsigned i = 0; i < n; i++) TRY(take_variable(f, event, why));
  event->last_ms = -HUGE_VAL;
  f->n_event++;
  return DONE;
}

static done_t take_header(usd_file_t *f, why_t *why) {
  unsigned magic, events;
  int main_event = -1;
  TRY(take_number(f, 1, &magic, why));
  TRY(take_number(f, 2, &f->version, why));
  if (magic != USD_MAGIC || f->version < 1 || f->version > 2)
    return refuse(f, why, "not a uSD log of version 1 or 2");
  TRY(take_number(f, 2, &events, why));
  if (events < 1 || events > USD_EVENT_MAX) return refuse(f, why, "number of events; allowed: 1 to 64");
  f->n_column = 1;
  strcpy(f->name[0], "timestamp");
  for (unsigned i = 0; i < events; i++) {
    bool fixed;
    TRY(take_event(f, &fixed, why));
    if (fixed) main_event = (int)i;
  }
  for (int i = 0; i < f->n_event; i++) f->event[i].read = main_event < 0 || i == main_event;
  return DONE;
}

done_t usd_open(usd_file_t **file, FILE *stream, const char *path, why_t *why) {
  *file = calloc(1, sizeof **file);
  if (!*file) {
    fclose(stream);
    return error_failed(why, "%s: out of memory", path);
  }
  crc_stream_init(&(*file)->in, stream);
  snprintf((*file)->path, sizeof(*file)->path, "%s", path);
  const done_t status = take_header(*file, why);
  if (status != DONE) {
    usd_close(*file);
    *file = NULL;
  }
  return status;
}

void usd_close(usd_file_t *file) {
  if (!file) return;
  fclose(file->in.stream);
  free(file);
}

// --- records -------------------------------------------------------------------------------------------

static bool stop(usd_file_t *f, const char *what) {
  f->ended = true;
  if (what)
    snprintf(f->damage, sizeof f->damage, "byte %llu, behind record %ld: %s", (unsigned long long)f->in.taken,
             f->records, what);
  return false;
}

static bool at_end(usd_file_t *f) {
  switch (crc_stream_end(&f->in)) {
  case CRC_WRONG: return stop(f, "the CRC is wrong: something before is not as it was written");
  case CRC_CUT_OFF: return stop(f, "the file is cut off");
  case CRC_GOOD: break;
  }
  return stop(f, NULL);
}

static event_t *find_event(usd_file_t *f, unsigned id) {
  for (int i = 0; i < f->n_event; i++)
    if (f->event[i].id == id) return &f->event[i];
  return NULL;
}

// The next record into `row`; *is_row: its event is one that is read. False at the end or at a damage.
static bool take_record(usd_file_t *f, row_t *row, bool *is_row) {
  const int head = f->version == 1 ? 6 : 10;
  if (!crc_stream_have(&f->in, (size_t)head)) return at_end(f);
  const unsigned id = (unsigned)crc_stream_peek(&f->in, 2);
  event_t *const event = find_event(f, id);
  if (!event) return stop(f, "a record of an event that the header does not name");
  if (!crc_stream_have(&f->in, (size_t)(head + event->bytes))) return stop(f, "the file is cut off");
  crc_stream_take(&f->in, 2);
  const uint64_t stamp = crc_stream_take(&f->in, head - 2);
  const double t_ms = f->version == 1 ? (double)stamp : 1e-3 * (double)stamp;
  f->records++;
  if (t_ms < event->last_ms) return stop(f, "time runs back within an event");
  event->last_ms = t_ms;
  for (int i = 0; i < f->n_column; i++) row->value[i] = (double)NAN;
  row->value[0] = t_ms;
  row->record = f->records;
  row->event = event;
  for (int i = 0; i < event->n; i++) row->value[event->column[i]] = crc_stream_value(&f->in, event->type[i]);
  *is_row = event->read;
  return true;
}

// Events are written by several tasks: each is in order, all together are only nearly so.
static void keep_waiting(usd_file_t *f, const row_t *row) {
  int i = f->n_waiting++;
  for (; i > 0 && f->waiting[i - 1].value[0] <= row->value[0]; i--) f->waiting[i] = f->waiting[i - 1];
  f->waiting[i] = *row;
}

bool usd_next(usd_file_t *f) {
  const int wait = !f->in_order && f->n_event > 1 && f->event[0].read && f->event[1].read ? MERGED : 0;
  while (!f->ended && f->n_waiting <= wait) {
    bool is_row;
    if (take_record(f, &f->row, &is_row) && is_row) keep_waiting(f, &f->row);
  }
  if (f->n_waiting == 0) return false;
  f->row = f->waiting[--f->n_waiting];
  return true;
}

bool usd_only(usd_file_t *f, const char *const *events, int n) {
  bool wanted[USD_EVENT_MAX], any = false;
  for (int i = 0; i < f->n_event; i++) {
    wanted[i] = false;
    for (int k = 0; k < n; k++) wanted[i] = wanted[i] || strcmp(f->event[i].name, events[k]) == 0;
    any = any || wanted[i];
  }
  for (int i = 0; any && i < f->n_event; i++) f->event[i].read = wanted[i];
  f->in_order = f->in_order || any;
  return any;
}

bool usd_has(const usd_file_t *f, const char *event, int column) {
  for (int i = 0; i < f->n_event; i++)
    for (int k = 0; k < f->event[i].n && strcmp(f->event[i].name, event) == 0; k++)
      if (f->event[i].column[k] == column) return true;
  return false;
}

const char *usd_event(const usd_file_t *f) {
  return f->row.event->name;
}

int usd_find(const usd_file_t *f, const char *name) {
  for (int i = 0; i < f->n_column; i++)
    if (strcmp(f->name[i], name) == 0) return i;
  return -1;
}

const char *usd_name(const usd_file_t *f, int column) {
  return f->name[column];
}

double usd_value(const usd_file_t *f, int column) {
  return f->row.value[column];
}

long usd_record(const usd_file_t *f) {
  return f->row.record;
}

const char *usd_damage(const usd_file_t *f) {
  return f->damage[0] ? f->damage : NULL;
}
