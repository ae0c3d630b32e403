// users.c - sets of files as users have them, and what the workflow says of them.
#define _POSIX_C_SOURCE 200809L // mkdtemp
#include "exam/users.h"

#include "gap/8_report/report.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FLIGHTS 4 // at most
#define FELT_S                                                                                               \
  1.0 // seconds for which the fitted flights (all but the last of several) must at least meet what acts at
      // places only: half a block of the Wald F
#define DRAWS 20
#define PATH  80

typedef struct {
  char folder[PATH], log[FLIGHTS][PATH], vehicle[PATH], columns[PATH];
} paper_t;

// --- what is hidden ----------------------------------------------------------------------------------------

// True if a flight straight up and down shows the effect.
static bool in_ladder(int i) {
  static const char *const shown[] = {"mass",         "thrust_scale", "motor_damage", "cg_offset",
                                      "climb_inflow", "battery_sag",  "ceiling",      "ground",
                                      "accel_bias",   "tof_bias"};
  for (unsigned k = 0; k < sizeof shown / sizeof *shown; k++)
    if (strcmp(shown[k], hide_name(i)) == 0) return true;
  return false;
}

// True if this log can show the effect beside what is hidden already. A lag or delay must be a row and a half
// or more.
static bool can_hide(const users_set_t *set, const other_job_t *job, int i, double times) {
  const double late_s = i == hide_number("delay")       ? HIDE_DELAY_S * times
                        : i == hide_number("motor_lag") ? HIDE_LAG_S * times
                                                        : 1.0;
  const bool by_acc = i == hide_number("accel_bias") || i == hide_number("imu_misalignment");
  if (set->n > 0 && strcmp(set->hidden[0], hide_name(i)) == 0) return false;
  if ((by_acc && (job->habits.lacks & LACKS_ACC)) ||
      (i == hide_number("battery_sag") && (job->habits.lacks & LACKS_VOLT)))
    return false;
  return late_s >= 1.5 * PILOT_S * job->habits.every && (!job->ladder || in_ladder(i));
}

// Hides nothing in a fifth of the sets, two effects in a sixth, else one; each one to four times its typical
// size.
static void hide(users_set_t *set, other_job_t *job, dice_t *d) {
  const double chance = dice_share(d);
  int effect[USERS_HIDDEN];
  set->n = 0;
  for (int wanted = chance < 0.2 ? 0 : chance > 0.84 ? 2 : 1; set->n < wanted;) {
    const int i = (int)dice_between(d, 0.0, HIDE_EFFECTS - 0.001);
    const double times = pow(2.0, dice_between(d, 0.0, 2.0));
    if (!can_hide(set, job, i, times)) continue;
    effect[set->n] = i;
    set->times[set->n] = times;
    set->hidden[set->n++] = hide_name(i);
    hide_prepare(i, d, &job->known);
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

static void hide_in_ladder(users_set_t *set, other_job_t *job, dice_t *d) {
  job->ladder = true;
  hide(set, job, d);
}

static void hide_alone(users_set_t *set, other_job_t *job, dice_t *d) {
  static const unsigned lacks[] = {
      LACKS_WISH, LACKS_WISH | LACKS_VOLT, LACKS_WISH | LACKS_ACC, LACKS_SPEED, LACKS_VOLT, 0u};
  job->habits.every = dice_share(d) < 0.5 ? 5 : 10;
  job->habits.lacks = lacks[(int)dice_between(d, 0.0, 5.999)];
  hide(set, job, d);
}

// The file's drag is half or twice the true one, or its ceiling effect is wrong by a factor of 0.7, or it
// lacks the ceiling.
static void hide_from_file(users_set_t *set, other_job_t *job, dice_t *d) {
  const double chance = dice_share(d);
  const bool ceiling = chance > 0.4;
  const int i = hide_number(ceiling ? "ceiling" : "rotor_drag");
  hide_prepare(i, d, &job->known);
  job->truth = job->known;
  set->times[0] = dice_between(d, 1.5, 3.0);
  hide_effect(i, set->times[0], dice_share(d), &job->truth, &job->senses.wrong);
  const double ceiling_m = job->known.ceiling_m;
  job->known = job->truth;
  if (chance > 0.7) {
    set->strange = (hide_strange_t){"a ceiling that the file lacks", "height", 4u};
    job->known.ceiling_m = HUGE_VAL;
    job->known.ceiling_share = 0.0;
    return;
  }
  set->n = 1;
  set->hidden[0] = hide_name(i);
  if (ceiling)
    job->known.ceiling_m = ceiling_m, job->known.ceiling_share *= dice_share(d) < 0.5 ? 0.7 : 1.0 / 0.7;
  else
    job->known.hub_kg *= dice_share(d) < 0.5 ? 0.5 : 2.0;
}

// Hides only effects that differ from what is fitted anew.
static void hide_beside(users_set_t *set, other_job_t *job, dice_t *d) {
  static const char *const like[] = {"cg_offset",    "accel_bias",       "mass", "thrust_scale",
                                     "motor_damage", "imu_misalignment", "wind", "battery_sag"};
  set->differ = true;
  for (bool again = true; again;) {
    other_job_t fresh = *job;
    hide(set, &fresh, d);
    again = false;
    for (int k = 0; k < set->n; k++)
      for (unsigned i = 0; i < sizeof like / sizeof *like; i++)
        again = again || strcmp(set->hidden[k], like[i]) == 0;
    if (!again) *job = fresh;
  }
}

// What is fitted anew before each flight: the battery's place and weight, and the accelerometer's bias.
// Normal, with mean 0 over the fitted flights, for their mean would be one more hidden effect.
enum { ANEW_X, ANEW_Y, ANEW_ACC_X, ANEW_ACC_Y, ANEW_MASS, ANEW };

static void draw_anew(double anew[FLIGHTS][ANEW], int fitted, dice_t *d) {
  for (int k = 0; k < ANEW; k++) {
    double mean = 0.0;
    for (int i = 0; i < FLIGHTS; i++) anew[i][k] = dice_normal(d);
    for (int i = 0; i < fitted; i++) mean += anew[i][k] / fitted;
    for (int i = 0; i < fitted; i++) anew[i][k] -= mean;
  }
}

static void fit_anew(other_job_t *job, const char *what, double times, double x, double y) {
  const double turns = atan2(y, x) / (2.0 * OTHER_PI);
  hide_effect(hide_number(what), times * hypot(x, y), turns < 0.0 ? turns + 1.0 : turns, &job->truth,
              &job->senses.wrong);
}

static void fit_all_anew(other_job_t *job, const double anew[ANEW]) {
  fit_anew(job, "cg_offset", 1.0, anew[ANEW_X], anew[ANEW_Y]);
  fit_anew(job, "accel_bias", 1.0, anew[ANEW_ACC_X], anew[ANEW_ACC_Y]);
  fit_anew(job, "mass", 0.5, 0.0, anew[ANEW_MASS]); // y > 0: more mass
}

static void hide_torque(users_set_t *set, other_job_t *job, dice_t *d) {
  job->habits.every = 5;
  job->truth = job->known;
  set->n = 1;
  set->hidden[0] = "torque_ratio";
  set->times[0] = dice_share(d) < 0.5 ? 1.5 : 1.0 / 1.5;
  job->truth.torque_m *= set->times[0];
}

static void soil(users_set_t *set, other_job_t *job, dice_t *d) {
  static const char *const cause[DIRTS] = {
      [DIRT_EXCHANGED] = "cmd", [DIRT_HALF] = "cmd2",     [DIRT_GYRO] = "column q",      [DIRT_VOLT] = "volt",
      [DIRT_HOLES] = "az",      [DIRT_UNIT] = "column a", [DIRT_BACKWARDS] = "column t",
  };
  job->truth = job->known;
  job->habits.dirt = (dirt_t)dice_between(d, DIRT_EXCHANGED, DIRTS - 0.001);
  set->cause = cause[job->habits.dirt];
}

// --- files -------------------------------------------------------------------------------------------------

static done_t open_paper(paper_t *p, why_t *why) {
  char folder[] = "/tmp/exam-XXXXXX";
  if (!mkdtemp(folder)) return error_failed(why, "no folder for an exam's files");
  snprintf(p->folder, sizeof p->folder, "%s", folder);
  for (int i = 0; i < FLIGHTS; i++) snprintf(p->log[i], PATH, "%s/flight%d.csv", folder, i + 1);
  snprintf(p->vehicle, PATH, "%s/vehicle.toml", folder);
  snprintf(p->columns, PATH, "%s/columns.toml", folder);
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

typedef enum { FLEW, LOST, UNMET } flown_t; // UNMET: nobody flew where it acts, so nobody can find it

// True if the flights met what is hidden for long enough.
static bool is_met(const other_job_t *job, const felt_t *felt) {
  const nature_t *const is = &job->truth, *const known = &job->known;
  const bool ground = is->ground_share != known->ground_share;
  const bool ceiling = is->ceiling_share != known->ceiling_share || is->ceiling_m0 != known->ceiling_m0;
  return (is->strange == STRANGE_NONE || felt->strange_s >= FELT_S) &&
         (!ground || felt->ground_s >= FELT_S) && (!ceiling || felt->ceiling_s >= FELT_S);
}

// Users of one kind keep each flight to one sort of manoeuvre; only the last flight, held out, has all.
static int sort_of(users_kind_t kind, int flight) {
  static const int sort[FLIGHTS] = {SORT_UPRIGHT, SORT_SIDEWAYS, SORT_ALL, SORT_ALL};
  return kind == USERS_SORTS ? sort[flight] : SORT_ALL;
}

static done_t fly(const paper_t *p, users_kind_t kind, int flights, other_job_t *job, dice_t *d,
                  flown_t *flown, why_t *why) {
  TRY(write_file(p->vehicle, job, other_write_vehicle, why));
  TRY(write_file(p->columns, job, other_write_columns, why));
  felt_t felt = {0.0, 0.0, 0.0}, of_held = felt;
  const other_job_t all = *job;
  double anew[FLIGHTS][ANEW] = {{0.0}};
  if (kind == USERS_REFIT) draw_anew(anew, flights - 1, d);
  *flown = FLEW;
  for (int i = 0; i < flights && *flown == FLEW; i++) {
    FILE *const out = fopen(p->log[i], "w");
    if (!out) return error_failed(why, "%s: cannot be written", p->log[i]);
    job->span_s = job->ladder ? dice_between(d, 24.0, 30.0) : dice_between(d, 15.0, 19.0);
    job->sort = sort_of(kind, i);
    job->truth = all.truth, job->senses.wrong = all.senses.wrong;
    if (kind == USERS_REFIT) fit_all_anew(job, anew[i]);
    job->seed = (uint64_t)(1e15 * dice_share(d));
    if (!other_fly(job, out, i < flights - 1 || flights == 1 ? &felt : &of_held)) *flown = LOST;
    if (fclose(out) != 0) return error_failed(why, "%s: cannot be written", p->log[i]);
  }
  if (*flown == FLEW && !is_met(job, &felt)) *flown = UNMET;
  return DONE;
}

// --- a set -------------------------------------------------------------------------------------------------

// Answers as the program does.
static done_t answer(const paper_t *p, int flights, unsigned long seed, users_set_t *set, why_t *why) {
  const char *const logs[FLIGHTS] = {p->log[0], p->log[1], p->log[2], p->log[3]};
  const study_order_t order = {
      .vehicle = p->vehicle, .columns = p->columns, .log = logs, .n_log = flights, .seed = seed};
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

static void (*const how[USERS_ALL])(users_set_t *, other_job_t *, dice_t *) = {
    [USERS_HABITS] = hide,         [USERS_LADDER] = hide_in_ladder, [USERS_ALONE] = hide_alone,
    [USERS_FILE] = hide_from_file, [USERS_OUTSIDE] = hide_outside,  [USERS_DIRTY] = soil,
    [USERS_SORTS] = hide,          [USERS_REFIT] = hide_beside,     [USERS_TORQUE] = hide_torque,
};

done_t users_one(users_kind_t kind, unsigned long seed, users_set_t *set, why_t *why) {
  dice_t d = {(uint64_t)seed * 7919u + (uint64_t)kind};
  paper_t paper;
  const int flights = kind == USERS_ALONE ? 1 : kind == USERS_REFIT ? 4 : 3;
  flown_t flown = LOST;
  int lost = 0, unmet = 0;
  TRY(open_paper(&paper, why));
  done_t status = DONE;
  while (status == DONE && lost + unmet < DRAWS) {
    *set = (users_set_t){.kind = kind, .lost = lost, .unmet = unmet};
    other_job_t job = other_job(&d);
    how[kind](set, &job, &d);
    status = fly(&paper, kind, flights, &job, &d, &flown, why);
    if (flown == FLEW) break;
    ++*(flown == LOST ? &lost : &unmet);
  }
  if (status == DONE && flown != FLEW)
    status = error_failed(why, "of %d vehicles none flies and meets what is hidden", DRAWS);
  if (status == DONE) status = answer(&paper, flights, seed, set, why);
  close_paper(&paper);
  return status;
}
