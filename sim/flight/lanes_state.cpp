// lanes_state.cpp - milliseconds of eight flights.
#include "flight/lanes_state.h"

#include "flight/lanes_ms.h"
#ifdef __AVX2__
#include <new>

#include "base/lane_c.hpp"

#include "flight/lanes_eight.hpp"

#undef float
#undef double
#undef int
#undef unsigned
#undef bool

// Copying all state takes as long as flying a millisecond. So it is done once in so many milliseconds, and a
// flight that parts repeats them from the copy.
#define SINCE 32

// One more than are repeated: that of now.
#define SLOTS (SINCE + 1)

struct lanes_state {
  lanes::state_of_eight now, before;
  lanes::glue_t looked;
  // Rings of each millisecond's inputs: of sensors and estimator, and of the Crazyflie. `now` points there.
  lanes::senses_drawn_t drawn[SLOTS];
  lanes::truth_t truth[SLOTS]; // of each tick
  lanes::pilot_in_t in[SLOTS], unedited;
  int slot;                    // of `in`
  unsigned set, set_of[SLOTS]; // number of set points so far, and which one each of `in` has; 0: none
  int senses, vehicle;         // milliseconds since the copy
  const void *drawn_at[SINCE], *truth_at[SINCE], *told_at[SINCE]; // inputs in each
  const lanes_ms_t *ms;
};

using lanes::state_of_eight;

lanes_state_t *lanes_state_open(void) {
  lanes_state *const s = new (std::nothrow) lanes_state;
  if (!s) return nullptr;
  memset(static_cast<void *>(s), 0, sizeof *s);
  s->now.vehicle.around.app = &s->now.vehicle.app;
  s->now.drawn = s->drawn;
  s->now.truth = s->truth;
  s->now.in = s->in;
  s->ms = lane_bits() == 512 ? &lanes_ms_512 : &lanes_ms_256;
  return s;
}
void lanes_state_close(lanes_state_t *s) {
  delete s;
}

#define BLOCK(name, type, where)                                                                             \
  case lanes::LANES_##name: return &of->where;
static void *block(state_of_eight *of, int i) {
  switch (i) {
    LANES_BLOCKS(BLOCK)
  default: return nullptr;
  }
}
void *lanes_block(lanes_state_t *s, int i) {
  return block(&s->now, i);
}
const void *lanes_block_before(const lanes_state_t *s, int i) {
  return block(const_cast<state_of_eight *>(&s->before), i);
}

void *lanes_looked(lanes_state_t *s) {
  return &s->looked;
}

// Parameters change only between milliseconds (pilot_t.vehicle), and what was printed is in no lane.
static void keep_app(const lanes::glue_t *from, lanes::glue_t *to) {
  memcpy((void *)to, from, offsetof(lanes::glue_t, tuned));
}
static void keep_around(const lanes::stand_in_t *from, lanes::stand_in_t *to) {
  memcpy((void *)to, from, offsetof(lanes::stand_in_t, console));
}

#define KEEP(name, type, where) memcpy((void *)&s->before.where, &s->now.where, sizeof s->now.where);

// Copies all but past distances: repeating a millisecond writes the same places again.
static void keep_range(const lanes::range_t *from, lanes::range_t *to) {
  to->tick = from->tick;
  memcpy((void *)&to->up_mm, &from->up_mm, sizeof *to - offsetof(lanes::range_t, up_mm));
}

template <typename T> static T *next_of(T (&slots)[SLOTS], const T *at) {
  return at == &slots[SLOTS - 1] ? slots : slots + (at - slots) + 1;
}

void lanes_draw(lanes_state_t *s) {
  s->now.drawn = next_of(s->drawn, s->now.drawn);
}

unsigned lanes_senses_ms(lanes_state_t *s, unsigned in) {
  state_of_eight *const now = &s->now;
  if (s->senses == SINCE) {
    LANES_BLOCKS_OF_SENSES(KEEP)
    keep_range(&now->senses.range, &s->before.senses.range);
    s->senses = 0;
  }
  s->drawn_at[s->senses] = now->drawn;
  s->truth_at[s->senses++] = now->truth;
  return s->ms->senses(in, now);
}

void lanes_set_new(lanes_state_t *s) {
  s->set_of[s->slot] = ++s->set;
}

// An edit does not last: what the next millisecond begins with is kept aside.
void *lanes_told(lanes_state_t *s, bool edited) {
  state_of_eight *const now = &s->now;
  if (s->vehicle == SINCE) {
    keep_app(&now->vehicle.app, &s->before.vehicle.app);
    keep_around(&now->vehicle.around, &s->before.vehicle.around);
    LANES_BLOCKS_OF_VEHICLE(KEEP)
    s->vehicle = 0;
  }
  lanes::pilot_in_t *const told = now->in;
  s->told_at[s->vehicle] = told;
  if (!edited) return told;
  memcpy((void *)&s->unedited, told, sizeof *told);
  now->in = &s->unedited;
  s->set_of[s->slot] = 0;
  return told;
}

unsigned lanes_vehicle_ms(lanes_state_t *s, unsigned in) {
  return s->ms->vehicle(in, &s->now, s->told_at[s->vehicle++]);
}

// Set points last for seconds, and are copied when they change. Measurements and estimate are new each time.
void lanes_step(lanes_state_t *s) {
  const lanes::pilot_in_t *const from = s->now.in;
  s->slot = (s->slot + 1) % SLOTS;
  lanes::pilot_in_t *const to = s->now.in = &s->in[s->slot];
  constexpr size_t moved = offsetof(lanes::pilot_in_t, applied_N),
                   sensed = offsetof(lanes::pilot_in_t, range_new);
  memcpy((void *)to->applied_N, from->applied_N, sensed - moved);
  to->step = from->step + 1u;
  if (s->set_of[s->slot] == s->set) return;
  memcpy((void *)&to->set, &from->set, sizeof to->set);
  s->set_of[s->slot] = s->set;
}

lanes_since_t lanes_senses_since(const lanes_state_t *s) {
  return {s->senses, s->drawn_at, s->truth_at};
}
lanes_since_t lanes_vehicle_since(const lanes_state_t *s) {
  return {s->vehicle, s->told_at, nullptr};
}
void lanes_begin_anew(lanes_state_t *s) {
  memset((void *)s->drawn, 0, sizeof s->drawn); // by_mocap false; where true, `drawn` is written every ms
  memcpy((void *)&s->looked, &s->now.vehicle.app, sizeof s->looked);
  s->senses = s->vehicle = SINCE;
  memset(s->set_of, 0, sizeof s->set_of);
  s->set_of[s->slot] = s->set = 1;
}
bool lanes_senses_due(lanes_state_t *s, bool none) {
  if (none) s->senses = SINCE;
  return s->senses == SINCE;
}
bool lanes_vehicle_due(lanes_state_t *s, bool none) {
  if (none) s->vehicle = SINCE;
  return s->vehicle == SINCE;
}

double *lanes_truth(lanes_state_t *s) {
  s->now.truth = next_of(s->truth, s->now.truth);
  return (double *)(void *)s->now.truth;
}
void lanes_take_motors(lanes_state_t *s, unsigned motors) {
  for (int k = 0; k < LANES; k++) s->now.truth->motors.v[k] = -(int)(motors >> k & 1);
}

unsigned lanes_range_new(const lanes_state_t *s) {
  return s->now.in->range_new.bits();
}

#else // never called: lane_possible() is false

lanes_state_t *lanes_state_open(void) {
  return nullptr;
}
void lanes_state_close(lanes_state_t *) {}
void lanes_draw(lanes_state_t *) {}
unsigned lanes_senses_ms(lanes_state_t *, unsigned) {
  return 0;
}
void *lanes_told(lanes_state_t *, bool) {
  return nullptr;
}
void lanes_set_new(lanes_state_t *) {}
unsigned lanes_vehicle_ms(lanes_state_t *, unsigned) {
  return 0;
}
double *lanes_truth(lanes_state_t *) {
  return nullptr;
}
void lanes_take_motors(lanes_state_t *, unsigned) {}
unsigned lanes_range_new(const lanes_state_t *) {
  return 0;
}
void lanes_step(lanes_state_t *) {}
void *lanes_block(lanes_state_t *, int) {
  return nullptr;
}
const void *lanes_block_before(const lanes_state_t *, int) {
  return nullptr;
}
void *lanes_looked(lanes_state_t *) {
  return nullptr;
}
lanes_since_t lanes_senses_since(const lanes_state_t *) {
  return {};
}
lanes_since_t lanes_vehicle_since(const lanes_state_t *) {
  return {};
}
void lanes_begin_anew(lanes_state_t *) {}
bool lanes_senses_due(lanes_state_t *, bool) {
  return false;
}
bool lanes_vehicle_due(lanes_state_t *, bool) {
  return false;
}

#endif
