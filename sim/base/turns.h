// turns.h - jobs that take turns in one thread and wait for each other at points that they choose, where work
// is done for all of them at once. A job is any C function; the functions between it and turns_wait need not
// know of this.
#ifndef SIM_BASE_TURNS_H
#define SIM_BASE_TURNS_H

#include "base/lane.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  void (*job)(void *context, int i);
  // Called when all jobs that still run are waiting. what[k]: the argument that the job in place k gave to
  // turns_wait(); null for an empty place. A job keeps its place.
  void (*meet)(void *meet_context, void *const what[LANES]);
  void *context, *meet_context;
} turns_t;

// Runs jobs 0 to n-1, LANES of them at a time, until all have returned. If there is no memory for their
// stacks, or within a job, they run one after the other, and turns_inside() keeps its value.
void turns_run(const turns_t *turns, int n);

// True if the caller is part of such a job and may wait; false in another thread that a job starts.
bool turns_inside(void);
// True if the caller is part of a job with this `meet`.
bool turns_meet_at(void (*meet)(void *meet_context, void *const what[LANES]));
void turns_wait(void *what);

#ifdef __cplusplus
}
#endif

#endif
