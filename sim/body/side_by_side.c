// side_by_side.c - runs jobs that each move a body.
#include "body/side_by_side.h"

#include "base/heap.h"
#include "base/turns.h"
#include "body/abreast.h"
#ifdef _OPENMP
#include <omp.h>
#endif

// What a job waits for.
typedef struct {
  body_t *body;
  const double *command_N;
  double span_s;
} tick_t;

static void move(void *self, void *const what[LANES]) {
  abreast_t *const a = self;
  body_t *b[LANES] = {NULL};
  lanes_seen_t seen;
  double vbat_V[LANES];
  for (int k = 0; k < LANES; k++) {
    const tick_t *const tick = what[k];
    if (!tick) continue;
    b[k] = tick->body;
    if (b[k]->t_s == 0.0)
      abreast_forget_one(a, k); // just opened, not moved yet: another body may have been at this address
    body_command(b[k], tick->command_N, tick->span_s);
  }
  (void)abreast_move(a, b, &seen, vbat_V);
  abreast_settle_all(a, b);
}

int side_by_side_share(int n, int threads) {
  const int each = (n + threads - 1) / threads;
  return each < ABREAST_FEWEST ? 1 : each < LANES ? each : LANES;
}

long side_by_side(int n, void (*job)(void *context, int i), void *context) {
  abreast_t *const a = n >= ABREAST_FEWEST && !turns_inside() ? abreast_open(lane_bits()) : NULL;
  const turns_t turns = {.job = job, .meet = move, .context = context, .meet_context = a};
  if (a) heap_keep(); // a nominal flight's log is as large as a flight's record
  if (a)
    turns_run(&turns, n);
  else
    for (int i = 0; i < n; i++) job(context, i);
  const long together = a ? abreast_together(a) : 0;
  abreast_close(a);
  return together;
}

static int threads(void) {
#ifdef _OPENMP
  return omp_in_parallel() ? 1 : omp_get_max_threads();
#else
  return 1;
#endif
}

typedef struct {
  void (*job)(void *context, int i);
  void *context;
  int from;
} part_t;

static void one(void *part, int i) {
  const part_t *const p = part;
  p->job(p->context, p->from + i);
}

void side_by_side_shared(int n, void (*job)(void *context, int i), void *context) {
  const int share = side_by_side_share(n, threads());
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < n; i += share) {
    part_t part = {job, context, i};
    (void)side_by_side(i + share < n ? share : n - i, one, &part);
  }
}

void side_by_side_tick(body_t *b, const double command_N[ROTORS], double span_s) {
  tick_t tick = {b, command_N, span_s};
  if (turns_meet_at(move))
    turns_wait(&tick);
  else
    body_tick(b, command_N, span_s);
}
