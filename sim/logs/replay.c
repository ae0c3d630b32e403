// replay.c - a recorded flight's inputs through the flight code.
#include "logs/replay.h"

#include "crazyflie/sections.h"
#include "crazyflie/values.h"
#include "firmware/glue.h"
#include "logs/table.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

replay_part_t replay_all(const replay_t *r) {
  const replay_part_t *const part[] = {&r->known, &r->settling, &r->settled};
  replay_part_t all = {0};
  for (int i = 0; i < 3; i++) {
    const bool first =
        part[i]->first_line > 0 && (all.first_line == 0 || part[i]->first_line < all.first_line);
    all.calls += part[i]->calls;
    all.differ += part[i]->differ;
    all.worst_N = fmax(all.worst_N, part[i]->worst_N);
    if (first) all.first_line = part[i]->first_line;
  }
  return all;
}

#define FIELDS_MAX  64
#define MOTOR_MAX_N 200.0 // as of any log (logs/columns.c)
#define LEAP_CALLS  49    // the flight code follows a pause of up to 50 ms

enum { CALL, STATE, SET, EVENTS };
static const char *const EVENT[EVENTS] = {"indiCall", "indiState", "indiSet"};

typedef struct {
  int column, type, event;
  ptrdiff_t offset; // in flight_in_t
} field_t;

typedef struct {
  table_t table;
  const flight_param_t *param;
  field_t field[FIELDS_MAX];
  int n, motor[MOTORS];
  // Columns of the stamps; -1: the log has none (tunes, and in a CSV any).
  int calls, step_end, state, state_end, set, set_end, tunes;
  double has_state, has_set; // stamps of the last whole rows; NaN: none
  double tuned;              // sets of parameters taken so far; NaN: not known
  bool known;                // the history is known
  long since;                // calls since something was lost
  uint32_t call;             // number of the last one; 0: not known
  flight_in_t in;
  flight_t flight;
} player_t;

// --- columns ----------------------------------------------------------------------------------------------

static done_t find(const player_t *p, const char *name, int *column, why_t *why) {
  *column = table_find(&p->table, name);
  if (*column >= 0) return DONE;
  return table_refuse(&p->table, 0, -1, why, "column %s: missing; %s", name,
                      p->table.csv ? "fly --log-rate 1000 writes it" : "tools/usd/config.txt has it logged");
}

// Returns the event whose rows hold the column; CALL in a CSV.
static int event_of(const player_t *p, int column) {
  for (int i = 0; p->table.usd && i < EVENTS; i++)
    if (usd_has(p->table.usd, EVENT[i], column)) return i;
  return CALL;
}

static done_t find_stamps(player_t *p, why_t *why) {
  p->calls = table_find(&p->table, "indiRec.calls");
  p->tunes = table_find(&p->table, "indiRec.tunes");
  p->step_end = p->state = p->state_end = p->set = p->set_end = -1;
  if (p->table.csv) return DONE;
  TRY(find(p, "indiRec.calls", &p->calls, why));
  TRY(find(p, "indiRec.stepEnd", &p->step_end, why));
  TRY(find(p, "indiRec.state", &p->state, why));
  TRY(find(p, "indiRec.stateEnd", &p->state_end, why));
  TRY(find(p, "indiRec.set", &p->set, why));
  return find(p, "indiRec.setEnd", &p->set_end, why);
}

// Finds all columns; the app's own log groups say which field each one is.
static done_t find_all(player_t *p, why_t *why) {
  char name[32];
  const section_log_t *log;
  if (p->table.usd && !usd_only(p->table.usd, EVENT, EVENTS))
    return table_refuse(&p->table, 0, -1, why,
                        "no event indiCall: missing; tools/usd/config.txt has it logged");
  for (int i = 0; (log = sections_log_at(i, name)) != NULL; i++) {
    if (strncmp(name, "indiIn.", 7) != 0 && strncmp(name, "indiSet.", 8) != 0) continue;
    field_t *const f = &p->field[p->n++];
    *f = (field_t){.type = log->type, .offset = (const char *)log->address - (const char *)&glue_static.in};
    TRY(find(p, name, &f->column, why));
    f->event = event_of(p, f->column);
  }
  for (int i = 0; i < MOTORS; i++) {
    snprintf(name, sizeof name, "indi.m%d", i + 1);
    TRY(find(p, name, &p->motor[i], why));
  }
  return find_stamps(p, why);
}

// --- rows -------------------------------------------------------------------------------------------------

// Reads a number. The card holds the exact bits, infinities too; a CSV must hold numbers.
static done_t number(const player_t *p, int column, double *value, why_t *why) {
  return table_number(&p->table, column, p->table.usd ? CSV_GAP_MARKED : CSV_GAP_NAN, value, why);
}

static done_t take_fields(player_t *p, int event, why_t *why) {
  for (int i = 0; i < p->n; i++) {
    double value;
    if (p->field[i].event != event) continue;
    TRY(number(p, p->field[i].column, &value, why));
    values_put_log(p->field[i].type, (char *)&p->in + p->field[i].offset, value);
  }
  return DONE;
}

static done_t take_tunes(player_t *p, replay_t *r, why_t *why) {
  double tuned;
  if (p->tunes < 0) return DONE;
  TRY(number(p, p->tunes, &tuned, why));
  if (!isnan(p->tuned) && tuned != p->tuned && r->tuned_line == 0) r->tuned_line = table_line(&p->table);
  p->tuned = tuned;
  return DONE;
}

static done_t is_whole(const player_t *p, int head, int end, bool *whole, why_t *why) {
  double a, b;
  *whole = true;
  if (end < 0) return DONE;
  TRY(number(p, head, &a, why));
  TRY(number(p, end, &b, why));
  *whole = a == b;
  return DONE;
}

// Takes a row of the estimate or of the set point, which holds for the calls after it.
static done_t take_part(player_t *p, int event, replay_t *r, why_t *why) {
  double *const has = event == STATE ? &p->has_state : &p->has_set;
  const int head = event == STATE ? p->state : p->set, end = event == STATE ? p->state_end : p->set_end;
  bool whole;
  TRY(is_whole(p, head, end, &whole, why));
  *has = (double)NAN;
  r->torn += !whole;
  if (!whole) return DONE;
  if (event == STATE) TRY(take_tunes(p, r, why));
  TRY(number(p, head, has, why));
  return take_fields(p, event, why);
}

// *complete: the call is whole, and the log has its state and set point.
static done_t is_complete(const player_t *p, replay_t *r, bool *complete, why_t *why) {
  double state, set;
  int step = 0;
  *complete = true;
  if (p->table.csv) return DONE;
  TRY(find(p, "indiIn.step", &step, why));
  TRY(is_whole(p, step, p->step_end, complete, why));
  r->torn += !*complete;
  if (!*complete) return DONE;
  TRY(number(p, p->state, &state, why));
  TRY(number(p, p->set, &set, why));
  *complete = state == p->has_state && set == p->has_set;
  r->incomplete += !*complete;
  return DONE;
}

// --- flying -----------------------------------------------------------------------------------------------

static done_t start(player_t *p, why_t *why) {
  if (flight_init(&p->flight, p->param) != ST_OK)
    return error_set(why, "--set: parameters that contradict each other");
  p->known = p->call <= 1;
  p->since = 0;
  return DONE;
}

// Skips calls that are not in the log. A few are skipped as missed ones are in flight. The flight code would
// take more for an emergency, as in flight, so it starts anew; what it learned is kept.
static done_t leap(player_t *p, replay_t *r, long lost, why_t *why) {
  const learn_t learned = p->flight.outer.learn;
  r->missing += lost;
  if (lost > LEAP_CALLS) {
    TRY(start(p, why));
    p->flight.outer.learn = learned;
  }
  p->known = false;
  p->since = 0;
  return DONE;
}

// Handles what lies between the last call and this one: a new selection, or missing calls.
static done_t follow(player_t *p, const flight_in_t *before, replay_t *r, bool first, why_t *why) {
  const uint32_t last = p->call;
  double call = 0.0;
  if (p->calls >= 0) TRY(number(p, p->calls, &call, why));
  p->call = (uint32_t)call;
  if (first) {
    r->first_call = p->call;
    return start(p, why);
  }
  if (p->calls >= 0 && p->call <= last) return start(p, why); // selected anew
  const uint32_t since = p->calls >= 0 ? p->call - last : p->in.step - before->step;
  if (since > 1 && since < 0x80000000u) return leap(p, r, (long)since - 1, why);
  return DONE;
}

static done_t compare(player_t *p, replay_t *r, why_t *why) {
  replay_part_t *const part = p->known                         ? &r->known
                              : p->since < REPLAY_SETTLE_CALLS ? &r->settling
                                                               : &r->settled;
  bool differs = false;
  for (int i = 0; i < MOTORS; i++) {
    double logged;
    TRY(table_number(&p->table, p->motor[i], CSV_GAP_REFUSED, &logged, why));
    if (!(fabs(logged) <= MOTOR_MAX_N))
      return table_refuse(&p->table, 0, p->motor[i], why, "%g N is not plausible; allowed: -%g to %g N",
                          logged, MOTOR_MAX_N, MOTOR_MAX_N);
    const float now_N = p->flight.out.motors.force_N[i], then_N = (float)logged;
    differs = differs || memcmp(&now_N, &then_N, sizeof now_N) != 0;
    part->worst_N = fmax(part->worst_N, fabs((double)now_N - (double)then_N));
  }
  p->since++;
  part->calls++;
  part->differ += differs;
  if (differs && part->first_line == 0) part->first_line = table_line(&p->table);
  return DONE;
}

static done_t take_call(player_t *p, replay_t *r, why_t *why) {
  const flight_in_t before = p->in;
  bool complete;
  TRY(is_complete(p, r, &complete, why));
  if (!complete) return DONE;
  if (p->table.csv) TRY(take_tunes(p, r, why));
  TRY(take_fields(p, CALL, why));
  TRY(follow(p, &before, r, replay_all(r).calls == 0, why));
  (void)flight_step(&p->flight, &p->in);
  return compare(p, r, why);
}

static int event_now(const player_t *p) {
  int i = 0;
  while (p->table.usd && i < EVENTS - 1 && strcmp(usd_event(p->table.usd), EVENT[i]) != 0) i++;
  return i;
}

static done_t play(player_t *p, replay_t *r, why_t *why) {
  TRY(find_all(p, why));
  TRY(start(p, why));
  for (bool more;;) {
    TRY(table_next(&p->table, &more, why));
    if (!more) break;
    const int event = event_now(p);
    TRY(event == CALL ? take_call(p, r, why) : take_part(p, event, r, why));
  }
  if (replay_all(r).calls == 0)
    return table_refuse(&p->table, 0, -1, why, "no call that is whole; allowed: one or more");
  (void)table_damage(&p->table, r->damage, sizeof r->damage);
  return DONE;
}

done_t replay_fly(const char *path, const flight_param_t *param, replay_t *result, why_t *why) {
  player_t p = {.param = param, .has_state = (double)NAN, .has_set = (double)NAN, .tuned = (double)NAN};
  *result = (replay_t){.missing = 0};
  TRY(table_open(&p.table, path, why));
  const done_t status = play(&p, result, why);
  table_close(&p.table);
  return status;
}
