// turns.h - jobs that run by turns in one thread, and wait for each other where they say so: what they wait
// for is done for all of them at once. A job is any C function; its calls in between know nothing of it.
#ifndef SIM_BASE_TURNS_H
#define SIM_BASE_TURNS_H

#include "base/lane.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  void (*job)(void *context, int i);
  // All that still run wait. what: of each the argument of turns_wait(), or a null pointer. A job keeps its
  // place among them.
  void (*meet)(void *meet_context, void *const what[LANES]);
  void *context, *meet_context;
} turns_t;

// Runs job 0 to n-1, LANES of them at a time, until all have returned. Without memory for their stacks, and
// within a job, they run one after the other, and turns_inside() is what it was.
void turns_run(const turns_t *turns, int n);

// Whether the caller is part of such a job, and may wait. Another thread that a job starts is not.
bool turns_inside(void);
// Whether it is part of one that meets there.
bool turns_meet_at(void (*meet)(void *meet_context, void *const what[LANES]));
void turns_wait(void *what);

#ifdef __cplusplus
}
#endif

#endif
