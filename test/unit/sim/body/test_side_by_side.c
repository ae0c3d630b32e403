// test_side_by_side.c - jobs that move a body each: every one gets the bits that it gets alone.
#include "base/lane.h"
#include "body/side_by_side.h"
#include "rig/vehicle6.h"
#include <string.h>

#define JOBS  11  // more than are moved at once
#define TICKS 300 // of the first; each has 7 fewer than the one before

typedef struct {
  model_t model;
  double y[JOBS][RIGID_N], charge[JOBS];
} jobs_t;

static bool begin(const jobs_t *j, int i, int part, body_t *b) {
  const body_start_t start = {.pos_w_m = {0.1 * i, 0.0, 0.3 + 0.01 * i + 0.1 * part},
                              .vel_w_mps = {0.4 - 0.1 * i, 0.0, 0.0},
                              .rate_b_radps = {0.1 * i, -0.2, 0.0},
                              .thrust_N = {0.08, 0.08, 0.08, 0.08},
                              .seed = 7 + (uint64_t)i};
  return CHECK_OK(body_open(b, &j->model, INTEGRATE_RK4, TICK_S, &start));
}

// Twice at the same address, with commands that follow what is seen of the body.
static void fly(void *self, int i) {
  jobs_t *const j = self;
  body_t b;
  for (int part = 0; part < 2; part++) {
    if (!begin(j, i, part, &b)) return;
    b.y[RIGID_VEL_MPS + 1] = 0.01 * part; // before the first tick anything may be changed
    for (int k = 0; k < TICKS - 7 * i; k++) {
      const double one = WEIGHT_N / ROTORS - 0.02 * b.y[RIGID_VEL_MPS + 2];
      const double command_N[ROTORS] = {one, one + 1e-4 * i, one, one - 1e-4};
      b.vbat_V = 3.5 + 1e-3 * k;
      side_by_side_tick(&b, command_N, TICK_S);
    }
    memcpy(j->y[i], b.y, sizeof b.y);
    j->charge[i] = b.charge;
    body_close(&b);
  }
}

TEST(side_by_side_each_has_the_bits_that_it_has_alone) {
  static const char *const effect[] = {"ceiling", "wind", "battery_sag"};
  for (unsigned e = 0; e < sizeof effect / sizeof *effect; e++) {
    ROW("%s", effect[e]);
    static jobs_t alone, beside, shared;
    alone.model = vehicle6(0.6);
    (void)vehicle6_add(&alone.model, effect[e]);
    beside.model = shared.model = alone.model;
    for (int i = 0; i < JOBS; i++) fly(&alone, i);
    const long together = side_by_side(JOBS, fly, &beside);
    CHECK(memcmp(alone.y, beside.y, sizeof alone.y) == 0);
    CHECK(memcmp(alone.charge, beside.charge, sizeof alone.charge) == 0);
    side_by_side_shared(JOBS, fly, &shared);
    CHECK(memcmp(alone.y, shared.y, sizeof alone.y) == 0);
    CHECK(memcmp(alone.charge, shared.charge, sizeof alone.charge) == 0);
    if (lane_possible()) CHECK(together > JOBS * TICKS);
  }
}

// The first parts from the others in every tick, at a branch on a number of its own, and ends before them;
// nothing of its body is left.
static void leave_or_stay(void *self, int i) {
  static body_t own[4];
  jobs_t *const j = self;
  body_t *const b = &own[i];
  if (!begin(j + (i == 0), i, 0, b)) return;
  for (int k = 0; k < (i == 0 ? 5 : 10); k++) {
    const double command_N[ROTORS] = {0.1, 0.1, 0.1, 0.1};
    side_by_side_tick(b, command_N, TICK_S);
  }
  memcpy(j->y[i], b->y, sizeof b->y);
  body_close(b);
  memset(b, 0xff, sizeof *b);
}

TEST(side_by_side_nobody_asks_one_who_has_left) {
  static jobs_t alone[2], beside[2]; // the second: its model is that of the first job
  fx_use_t use = fx_use(fx_find("ceiling"));
  why_t why;
  for (int i = 0; i < 2; i++) {
    alone[i].model = vehicle6(0.6);
    use.p[fx_use_kind(&use)] = i == 0 ? 1.0 : 0.0; // where the ceiling's distance is taken
    CHECK_OK(model_add_fx(&alone[i].model, &use, &why));
    beside[i].model = alone[i].model;
  }
  for (int i = 0; i < 4; i++) leave_or_stay(alone, i);
  const long together = side_by_side(4, leave_or_stay, beside);
  CHECK(memcmp(alone[0].y, beside[0].y, sizeof alone[0].y) == 0);
  if (lane_possible()) CHECK(together == 3 * 10); // as the one who has left would have it they could not
}

TEST(side_by_side_a_call_does_no_more_than_leave_every_thread_some) {
  static const struct {
    int n, threads, share;
  } rows[] = {{10, 1, 8}, {10, 2, 5}, {10, 3, 4}, {10, 4, 1}, {3, 1, 1}, {1, 8, 1}, {40, 2, 8}};
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    ROW("%d jobs, %d threads", rows[i].n, rows[i].threads);
    CHECK(side_by_side_share(rows[i].n, rows[i].threads) == rows[i].share);
  }
}
