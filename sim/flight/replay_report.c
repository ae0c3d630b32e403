// replay_report.c - the result of a replay, in words.
#include "flight/replay_report.h"

#include "logs/replay.h"
#include <math.h>
#include <stdio.h>

// Prints what the log does not hold, and how far off that leaves the rest.
static void tell_lost(const replay_t *r) {
  const long unknown = r->settling.calls + r->settled.calls;
  if (r->first_call > 1)
    printf("the log begins %u calls after the selection of the controller\n", r->first_call - 1);
  if (r->torn > 0) printf("%ld rows torn, not used\n", r->torn);
  if (r->incomplete > 0)
    printf("%ld calls without the estimate or the set point that they flew, not used\n", r->incomplete);
  if (unknown > 0)
    printf("with all that went before: %ld calls, %ld differ\n"
           "without it, within 1 s of the loss: %ld calls, %ld differ, by %g N at most\n"
           "without it, later: %ld calls, %ld differ, by %g N at most\n",
           r->known.calls, r->known.differ, r->settling.calls, r->settling.differ, r->settling.worst_N,
           r->settled.calls, r->settled.differ, r->settled.worst_N);
  if (r->tuned_line > 0) printf("from line %ld on other parameters may have flown\n", r->tuned_line);
  if (r->damage[0]) printf("%s\n", r->damage);
}

static void tell(const replay_t *r) {
  const replay_part_t all = replay_all(r);
  printf("%ld calls replayed, %ld between them left out, %ld differ in a motor's command, by %g N at most",
         all.calls, r->missing, all.differ, all.worst_N);
  if (all.differ > 0) printf("; the first in line %ld", all.first_line);
  putchar('\n');
  tell_lost(r);
}

done_t replay_report(const char *path, const request_t *request, why_t *why) {
  flight_param_t param;
  replay_t r;
  params_default(&param);
  for (int i = 0; i < request->n_set; i++)
    if (request->set[i].row && params_set(&param, request->set[i].row, request->set[i].value) != ST_OK)
      return BAD_INPUT;
  TRY(param_check_all(&param, why));
  TRY(replay_fly(path, &param, &r, why));
  tell(&r);
  return DONE;
}
