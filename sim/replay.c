// replay.c - a recorded flight's inputs through the flight code.
#include "replay.h"

#include "crazyflie/sections.h"
#include "crazyflie/values.h"
#include "firmware/glue.h"
#include "io/csv.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

#define FIELDS_MAX  64
#define MOTOR_MAX_N 200.0 // as of any log (io/columns.c)

typedef struct {
  int column, type;
  ptrdiff_t offset; // in flight_in_t
} field_t;

typedef struct {
  csv_file_t *file;
  field_t field[FIELDS_MAX];
  int n, motor[MOTORS];
  flight_in_t in;
  flight_t flight;
} player_t;

static status_t find(const player_t *p, const char *name, int *column, why_t *why) {
  *column = csv_find(p->file, name);
  if (*column >= 0) return ST_OK;
  return csv_refuse(p->file, -1, why, "column %s: missing; fly --log-rate 1000 writes it", name);
}

// The app's own logs say which column is which field.
static status_t find_all(player_t *p, why_t *why) {
  char name[32];
  const section_log_t *log;
  for (int i = 0; (log = sections_log_at(i, name)) != NULL; i++) {
    if (strncmp(name, "indiIn.", 7) != 0 && strncmp(name, "indiSet.", 8) != 0) continue;
    field_t *const f = &p->field[p->n++];
    *f = (field_t){.type = log->type, .offset = (const char *)log->address - (const char *)&glue_static.in};
    TRY(find(p, name, &f->column, why));
  }
  for (int i = 0; i < MOTORS; i++) {
    snprintf(name, sizeof name, "indi.m%d", i + 1);
    TRY(find(p, name, &p->motor[i], why));
  }
  return ST_OK;
}

static status_t take_row(player_t *p, why_t *why) {
  for (int i = 0; i < p->n; i++) {
    double value;
    TRY(csv_number(p->file, p->field[i].column, CSV_GAP_NAN, &value, why));
    values_put_log(p->field[i].type, (char *)&p->in + p->field[i].offset, value);
  }
  return ST_OK;
}

static status_t compare(const player_t *p, replay_t *r, why_t *why) {
  bool differs = false;
  for (int i = 0; i < MOTORS; i++) {
    double logged;
    TRY(csv_number(p->file, p->motor[i], CSV_GAP_REFUSED, &logged, why));
    if (!(fabs(logged) <= MOTOR_MAX_N))
      return csv_refuse(p->file, p->motor[i], why, "%g N is not plausible; allowed: -%g to %g N", logged,
                        MOTOR_MAX_N, MOTOR_MAX_N);
    const float now_N = p->flight.out.motors.force_N[i], then_N = (float)logged;
    differs = differs || memcmp(&now_N, &then_N, sizeof now_N) != 0;
    r->worst_N = fmax(r->worst_N, fabs((double)now_N - (double)then_N));
  }
  r->calls++;
  r->differ += differs;
  if (differs && r->first_line == 0) r->first_line = csv_line(p->file);
  return ST_OK;
}

static status_t play(player_t *p, const flight_param_t *param, replay_t *r, why_t *why) {
  TRY(find_all(p, why));
  if (flight_init(&p->flight, param) != ST_OK)
    return error_set(why, "--set: parameters that contradict each other");
  for (bool more;;) {
    TRY(csv_next(p->file, &more, why));
    if (!more) return ST_OK;
    const uint32_t last = p->in.step;
    TRY(take_row(p, why));
    const uint32_t since = p->in.step - last;
    if (r->calls > 0 && since > 1 && since < 0x80000000u) r->missing += since - 1;
    (void)flight_step(&p->flight, &p->in);
    TRY(compare(p, r, why));
  }
}

status_t replay_fly(const char *path, const flight_param_t *param, replay_t *result, why_t *why) {
  player_t p = {.n = 0};
  *result = (replay_t){.calls = 0};
  TRY(csv_open(&p.file, path, why));
  const status_t status = play(&p, param, result, why);
  csv_close(p.file);
  return status;
}
