// test_turns.c - jobs that wait for each other.
#include "base/turns.h"
#include "rig/test.h"

#define JOBS 20

typedef struct {
  int waits[JOBS], done[JOBS]; // how often a job waited, and how often what it waited for was done
  int most;                    // that waited at once
} count_t;

typedef struct {
  count_t *all;
  int i;
} one_t;

static void job(void *self, int i) {
  one_t one = {self, i};
  for (int k = 0; k < i % 5; k++) {
    one.all->waits[i]++;
    turns_wait(&one);
    CHECK(one.all->done[i] == one.all->waits[i]);
  }
}

static void meet(void *self, void *const what[LANES]) {
  count_t *const c = self;
  int n = 0;
  for (int k = 0; k < LANES; k++) {
    const one_t *const one = what[k];
    if (!one) continue;
    c->done[one->i]++;
    n++;
  }
  if (n > c->most) c->most = n;
}

static void wait_for_nothing(void *self, int i) {
  int *const ran = self;
  (void)i;
  ++*ran;
}

static void job_with_jobs(void *self, int i) {
  const turns_t inner = {.job = wait_for_nothing, .context = self};
  const bool inside = turns_inside();
  turns_run(&inner, 3);
  CHECK(inside && turns_inside() && i < 4);
}

TEST(turns_within_turns_run_one_after_the_other) {
  int ran = 0;
  const turns_t turns = {.job = job_with_jobs, .meet = meet, .context = &ran};
  turns_run(&turns, 4);
  CHECK(ran == 12);
  CHECK(!turns_inside());
}

TEST(turns_let_every_job_wait_as_often_as_it_wants_and_run_to_its_end) {
  count_t c = {.most = 0};
  const turns_t turns = {.job = job, .meet = meet, .context = &c, .meet_context = &c};
  turns_run(&turns, JOBS);
  for (int i = 0; i < JOBS; i++) {
    ROW("job %d", i);
    CHECK(c.done[i] == i % 5);
  }
  CHECK(c.most == LANES);
  CHECK(!turns_inside());
}
