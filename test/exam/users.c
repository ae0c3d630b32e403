// users.c - sets of files as users have them, and what the workflow says of them.
#define _POSIX_C_SOURCE 200809L // mkdtemp
#include "exam/users.h"

#include "gap/8_report/report.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FLIGHTS 3
#define DRAWS   20
#define PATH    80

typedef struct {
  char folder[PATH], log[FLIGHTS][PATH], vehicle[PATH], columns[PATH];
} paper_t;

// --- what is hidden ----------------------------------------------------------------------------------------

static bool excludes(const users_set_t *set, const char *name) {
  return set->n > 0 && strcmp(set->hidden[0], name) == 0;
}

// A fifth hide nothing, a sixth two effects, the others one; each once to four times its typical size.
static void hide(users_set_t *set, other_job_t *job, dice_t *d) {
  const double chance = dice_share(d);
  int effect[USERS_HIDDEN];
  set->n = 0;
  for (int wanted = chance < 0.2 ? 0 : chance > 0.84 ? 2 : 1; set->n < wanted; set->n++) {
    do effect[set->n] = (int)dice_between(d, 0.0, HIDE_EFFECTS - 0.001);
    while (excludes(set, hide_name(effect[set->n])));
    set->hidden[set->n] = hide_name(effect[set->n]);
    set->times[set->n] = pow(2.0, dice_between(d, 0.0, 2.0));
    hide_prepare(effect[set->n], d, &job->known);
  }
  job->truth = job->known;
  for (int k = 0; k < set->n; k++)
    hide_effect(effect[k], set->times[k], dice_share(d), &job->truth, &job->senses.wrong);
}

static void hide_outside(users_set_t *set, other_job_t *job, dice_t *d) {
  job->truth = job->known;
  const int i = (int)dice_between(d, 0.0, HIDE_STRANGE - 0.001);
  set->strange = hide_strange(i, dice_between(d, 1.0, 3.0), d, hide_stretch(&job->known), &job->truth);
}

// --- files -------------------------------------------------------------------------------------------------

static done_t open_paper(paper_t *p, why_t *why) {
  snprintf(p->folder, sizeof p->folder, "/tmp/exam-XXXXXX");
  if (!mkdtemp(p->folder)) return error_failed(why, "no folder for an exam's files");
  for (int i = 0; i < FLIGHTS; i++) snprintf(p->log[i], PATH, "%.40s/flight%d.csv", p->folder, i + 1);
  snprintf(p->vehicle, PATH, "%.40s/vehicle.toml", p->folder);
  snprintf(p->columns, PATH, "%.40s/columns.toml", p->folder);
  return DONE;
}

static void close_paper(const paper_t *p) {
  for (int i = 0; i < FLIGHTS; i++) (void)!remove(p->log[i]);
  (void)!remove(p->vehicle);
  (void)!remove(p->columns);
  (void)!rmdir(p->folder);
}

static done_t write_file(const char *path, const other_job_t *job, void (*write)(const other_job_t *, FILE *),
                         why_t *why) {
  FILE *const out = fopen(path, "w");
  if (!out) return error_failed(why, "%s: cannot be written", path);
  write(job, out);
  return fclose(out) == 0 ? DONE : error_failed(why, "%s: cannot be written", path);
}

static done_t fly(const paper_t *p, other_job_t *job, dice_t *d, bool *flew, why_t *why) {
  TRY(write_file(p->vehicle, job, other_write_vehicle, why));
  TRY(write_file(p->columns, job, other_write_columns, why));
  *flew = true;
  for (int i = 0; i < FLIGHTS && *flew; i++) {
    FILE *const out = fopen(p->log[i], "w");
    if (!out) return error_failed(why, "%s: cannot be written", p->log[i]);
    job->span_s = dice_between(d, 15.0, 19.0);
    job->seed = (uint64_t)(1e15 * dice_share(d));
    *flew = other_fly(job, out);
    if (fclose(out) != 0) return error_failed(why, "%s: cannot be written", p->log[i]);
  }
  return DONE;
}

// --- a set -------------------------------------------------------------------------------------------------

// As the program answers.
static done_t answer(const paper_t *p, unsigned long seed, users_set_t *set, why_t *why) {
  const char *const logs[FLIGHTS] = {p->log[0], p->log[1], p->log[2]};
  const study_order_t order = {
      .vehicle = p->vehicle, .columns = p->columns, .log = logs, .n_log = FLIGHTS, .seed = seed};
  study_t *const study = calloc(1, sizeof *study);
  report_t *const report = calloc(1, sizeof *report);
  cJSON *verdict = NULL;
  done_t status = study && report ? DONE : error_failed(why, "out of memory");
  if (status == DONE) status = study_make(study, &order, why);
  if (status == DONE) status = report_make(report, study, why);
  if (status == DONE) verdict = report_verdict(report);
  if (status == BAD_INPUT) {
    verdict = report_refused(why->text, &order);
    status = DONE;
  }
  if (verdict) users_mark(set, verdict);
  cJSON_Delete(verdict);
  if (report) report_free(report);
  if (study) study_free(study);
  free(report);
  free(study);
  return status;
}

done_t users_one(users_kind_t kind, unsigned long seed, users_set_t *set, why_t *why) {
  dice_t d = {(uint64_t)seed * 7919u + (uint64_t)kind};
  paper_t paper;
  bool flew = false;
  TRY(open_paper(&paper, why));
  done_t status = DONE;
  for (int draw = 0; draw < DRAWS && status == DONE && !flew; draw++) {
    *set = (users_set_t){.kind = kind, .drawn_again = draw};
    other_job_t job = other_job(&d);
    (kind == USERS_OUTSIDE ? hide_outside : hide)(set, &job, &d);
    status = fly(&paper, &job, &d, &flew, why);
  }
  if (status == DONE && !flew) status = error_failed(why, "no vehicle of %d flies", DRAWS);
  if (status == DONE) status = answer(&paper, seed, set, why);
  close_paper(&paper);
  return status;
}
