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

// To copy all takes as long as to fly it: it is done once in so many milliseconds, and who parts does them
// again from there.
#define SINCE 32

struct lanes_state {
  lanes::state_of_eight now, before;
  // What came in in each: to sensors and estimator, and to the Crazyflie.
  lanes::senses_drawn_t drawn[SINCE];
  lanes::truth_t truth[SINCE]; // of ticks
  int truth_of[SINCE], truths;
  lanes::pilot_in_t in[SINCE];
  unsigned set, set_of[SINCE]; // how many set points there were, and which of them each has; 0: none
  int senses, vehicle;         // milliseconds since
  const lanes_ms_t *ms;
};

using lanes::state_of_eight;

lanes_state_t *lanes_state_open(void) {
  lanes_state *const s = new (std::nothrow) lanes_state;
  if (!s) return nullptr;
  memset(static_cast<void *>(s), 0, sizeof *s);
  s->now.vehicle.around.app = &s->now.vehicle.app;
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

// Parameters change between milliseconds alone (pilot_t.vehicle), and what was printed is nobody's number.
static void keep_app(const lanes::glue_t *from, lanes::glue_t *to) {
  memcpy((void *)to, from, offsetof(lanes::glue_t, tuned));
}
static void keep_around(const lanes::stand_in_t *from, lanes::stand_in_t *to) {
  memcpy((void *)to, from, offsetof(lanes::stand_in_t, console));
}

#define KEEP(name, type, where) memcpy((void *)&s->before.where, &s->now.where, sizeof s->now.where);

// But for what it remembers: who does it again writes the same place anew.
static void keep_range(const lanes::range_t *from, lanes::range_t *to) {
  to->tick = from->tick;
  memcpy((void *)&to->up_mm, &from->up_mm, sizeof *to - offsetof(lanes::range_t, up_mm));
}

// Of what is the same as in the millisecond before a copy is there; but of range's noise, nobody asks for it.
static void keep_told(lanes_state_t *s, unsigned what) {
  const state_of_eight *const now = &s->now;
  const int ms = s->senses++;
  memcpy((void *)&s->drawn[ms], &now->drawn,
         what & LANES_DRAWN_MORE ? sizeof now->drawn : offsetof(lanes::senses_drawn_t, range));
  if (ms == 0) s->truths = 0;
  if (ms == 0 || what & LANES_TRUTH_NEW)
    memcpy((void *)&s->truth[s->truths++], &now->truth, sizeof now->truth);
  s->truth_of[ms] = s->truths - 1;
}

unsigned lanes_senses_ms(lanes_state_t *s, unsigned in, unsigned what) {
  state_of_eight *const now = &s->now;
  if (s->senses == SINCE) {
    LANES_BLOCKS_OF_SENSES(KEEP)
    keep_range(&now->senses.range, &s->before.senses.range);
    s->senses = 0;
  }
  keep_told(s, what);
  return s->ms->senses(in, now);
}

void lanes_set_new(lanes_state_t *s) {
  s->set++;
}

void *lanes_told(lanes_state_t *s, bool edited) {
  const state_of_eight *const now = &s->now;
  if (s->vehicle == SINCE) {
    keep_app(&now->vehicle.app, &s->before.vehicle.app);
    keep_around(&now->vehicle.around, &s->before.vehicle.around);
    LANES_BLOCKS_OF_VEHICLE(KEEP)
    s->vehicle = 0;
  }
  unsigned *const set = &s->set_of[s->vehicle]; // set points stand for seconds
  lanes::pilot_in_t *const told = &s->in[s->vehicle];
  memcpy((void *)told, &now->in, *set == s->set ? offsetof(lanes::pilot_in_t, set) : sizeof now->in);
  *set = edited ? 0 : s->set;
  return told;
}

unsigned lanes_vehicle_ms(lanes_state_t *s, unsigned in) {
  return s->ms->vehicle(in, &s->now, &s->in[s->vehicle++]);
}

lanes_since_t lanes_senses_since(const lanes_state_t *s) {
  return {s->senses, sizeof s->drawn[0], s->drawn, sizeof s->truth[0], s->truth, s->truth_of};
}
lanes_since_t lanes_vehicle_since(const lanes_state_t *s) {
  return {s->vehicle, sizeof s->in[0], s->in, 0, nullptr, nullptr};
}
void lanes_begin_anew(lanes_state_t *s) {
  memset((void *)s->drawn, 0, sizeof s->drawn); // nobody's by motion capture, for whom each is a copy
  s->senses = s->vehicle = SINCE;
  s->set = 1;
  memset(s->set_of, 0, sizeof s->set_of);
}
bool lanes_senses_due(lanes_state_t *s, bool none) {
  if (none) s->senses = SINCE;
  return s->senses == SINCE;
}
bool lanes_vehicle_due(lanes_state_t *s, bool none) {
  if (none) s->vehicle = SINCE;
  return s->vehicle == SINCE;
}

void lanes_take_truth(lanes_state_t *s, const double *numbers, unsigned motors) {
  lanes::truth_t *const truth = &s->now.truth;
  memcpy((void *)truth, numbers, offsetof(lanes::truth_t, motors));
  for (int k = 0; k < LANES; k++) truth->motors.v[k] = -(int)(motors >> k & 1);
}

unsigned lanes_range_new(const lanes_state_t *s) {
  return s->now.in.range_new.bits();
}
void lanes_step(lanes_state_t *s) {
  s->now.in.step++;
}

#else // nobody asks for more (lane_possible)

lanes_state_t *lanes_state_open(void) {
  return nullptr;
}
void lanes_state_close(lanes_state_t *) {}
unsigned lanes_senses_ms(lanes_state_t *, unsigned, unsigned) {
  return 0;
}
void *lanes_told(lanes_state_t *, bool) {
  return nullptr;
}
void lanes_set_new(lanes_state_t *) {}
unsigned lanes_vehicle_ms(lanes_state_t *, unsigned) {
  return 0;
}
void lanes_take_truth(lanes_state_t *, const double *, unsigned) {}
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
