// learn.c - runs the flight code's own learner over recorded flights; prints the weights and what they
// explain.
#define _POSIX_C_SOURCE 200809L // stat
#include "base/made.h"
#include "base/option.h"
#include "base/whole_file.h"
#include "flight/result.h"
#include "logs/learn_log.h"
#include "pilots/controller_file.h"
#include "pilots/param_spec.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define FILES_MAX 64

typedef struct {
  const char *log[FILES_MAX], *held_out[FILES_MAX], *set[FILES_MAX];
  int n_log, n_held_out, n_set;
  const char *columns, *vehicle, *json, *points;
  int surface;
  bool help, version;
  made_t made;
} order_t;

// The files that are written.
typedef struct {
  whole_files_t files;
  FILE *points, *json;
} output_t;

typedef struct {
  learn_job_t job;
  learn_mass_t mass;
  const char *mass_from;
  learn_t learn;
  learn_score_t score[FILES_MAX];
  learn_bad_t bad[2 * FILES_MAX]; // of the logs, then of the held-out ones
} lesson_t;

static const char USAGE[] =
    "usage: learn LOG.csv... [options]\n"
    "  --columns FILE.toml      how these logs name things (tools/columns/*.toml); else as the Crazyflie\n"
    "  --vehicle FILE.toml      motor lag, thrust map, mass (sim/vehicle/vehicles/*.toml); without: "
    "cf21_legacy\n"
    "  --surface NAME           ceiling or ground (ceiling)\n"
    "  --hold-out LOG.csv       not learned from; says what the curve explains (may be repeated)\n"
    "  --set group.name=VALUE   a parameter of the flight code; fly --params lists them (may be repeated).\n"
    "                           Other than there: rls.q is 0, and near the ground ceil.w1..w7, from which it "
    "learns, are 1, 0, ...\n"
    "  --points FILE.csv        writes every sample that taught: distance and measured thrust ratio\n"
    "  --json FILE              writes weights and residuals\n"
    "  --version                version and commit\n"
    "  --help                   this\n";

// --- options ------------------------------------------------------------------------------------------

static done_t append(const char *list[FILES_MAX], int *n, const char *item, why_t *why) {
  if (*n == FILES_MAX) return error_set(why, "%s: too many of these; allowed: %d", item, FILES_MAX);
  list[(*n)++] = item;
  return DONE;
}

static done_t take_surface(order_t *o, const char *name, why_t *why) {
  if (strcmp(name, "ceiling") != 0 && strcmp(name, "ground") != 0)
    return error_set(why, "--surface %s: allowed are ceiling, ground", name);
  o->surface = name[0] == 'c' ? SURFACE_CEILING : SURFACE_GROUND;
  return DONE;
}

static done_t take_option(order_t *o, int option, const char *text, why_t *why) {
  switch (option) {
  case 'c': o->columns = text; return DONE;
  case 'v': o->vehicle = text; return DONE;
  case 's': return take_surface(o, text, why);
  case 'o': return append(o->held_out, &o->n_held_out, text, why);
  case 'p': return append(o->set, &o->n_set, text, why);
  case 'x': o->points = text; return DONE;
  case 'j': o->json = text; return DONE;
  case 'V': o->version = true; return DONE;
  default: o->help = true; return DONE;
  }
}

static done_t take_order(order_t *o, int argc, char **argv, why_t *why) {
  static const struct option options[] = {
      {"columns", 1, 0, 'c'}, {"vehicle", 1, 0, 'v'},
      {"surface", 1, 0, 's'}, {"hold-out", 1, 0, 'o'},
      {"set", 1, 0, 'p'},     {"json", 1, 0, 'j'},
      {"points", 1, 0, 'x'},  {"help", 0, 0, 'h'},
      {"version", 0, 0, 'V'}, {0},
  };
  *o = (order_t){.surface = SURFACE_CEILING, .made = made_by("learn", argc, argv)};
  opterr = 0;
  for (int option; (option = getopt_long(argc, argv, "", options, NULL)) != -1;) {
    if (option == '?') return option_refuse(options, argv[optind - 1], why);
    TRY(take_option(o, option, optarg, why));
  }
  for (int i = optind; i < argc; i++) TRY(append(o->log, &o->n_log, argv[i], why));
  if (o->n_log == 0 && !o->help && !o->version)
    return error_set(why, "no flight to learn from; allowed: learn LOG.csv...");
  return DONE;
}

static done_t set_param(flight_param_t *p, const char *text, why_t *why) {
  param_set_t set;
  TRY(param_parse(text, &set, why));
  if (!set.row) return error_set(why, "--set %s: a parameter of the app, which does not fly here", text);
  return params_set(p, set.row, set.value) == ST_OK ? DONE : BAD_INPUT;
}

// --- learning -----------------------------------------------------------------------------------------

static done_t prepare(const order_t *o, learn_job_t *job, why_t *why) {
  model_t vehicle;
  flown_by_t flown_by;
  TRY(o->vehicle ? model_read(o->vehicle, &vehicle, why) : model_builtin("cf21_legacy", &vehicle, why));
  if (o->vehicle) TRY(controller_read(o->vehicle, NULL, &vehicle, &flown_by, why)); // reports a wrong one
  learn_job_init(job, &vehicle, o->surface);
  if (o->columns) TRY(columns_read(o->columns, &job->columns, why));
  for (int i = 0; i < o->n_set; i++) TRY(set_param(&job->param, o->set[i], why));
  TRY(param_check_all(&job->param, why));
  job->rest_height_m = job->columns.rest_height_m;
  if (o->surface == SURFACE_GROUND && isnan(job->rest_height_m))
    return error_set(
        why, "--surface ground: the height at rest is not known; rest_height_m in a --columns file says it");
  return DONE;
}

// The first of two passes: weighs the vehicle, and finds every error before anything is learned.
static done_t weigh(const order_t *o, lesson_t *r, why_t *why) {
  for (int i = 0; i < o->n_log; i++) {
    struct stat s;
    if (stat(o->log[i], &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode))
      return error_set(why, "%s: not a file; allowed: a file, because it is read twice", o->log[i]);
    TRY(learn_log_mass(&r->job, o->log[i], &r->mass, &r->bad[i], why));
  }
  return DONE;
}

// A mass that was set by hand takes precedence over the measured one, and that over the vehicle file's.
static void choose_mass(const order_t *o, lesson_t *r) {
  const double measured_kg = learn_mass_kg(&r->mass);
  bool by_hand = false;
  for (int i = 0; i < o->n_set; i++) by_hand = by_hand || strncmp(o->set[i], "indiPos.mass=", 13) == 0;
  r->mass_from = by_hand ? "--set" : "vehicle file";
  if (!isfinite(measured_kg)) return;
  r->job.stands_mass_kg = (float)measured_kg;
  if (by_hand) return;
  r->job.param.pos.mass_kg = (float)measured_kg;
  r->mass_from = "thrust over specific force above 0.2 m";
}

static done_t learn(const order_t *o, lesson_t *r, FILE *points, why_t *why) {
  TRY(prepare(o, &r->job, why));
  TRY(weigh(o, r, why));
  choose_mass(o, r);
  flight_param_t *const p = &r->job.param;
  if (learn_init(&r->learn, &p->learn, &p->curve.fixed) != ST_OK)
    return error_set(why, "the learner refuses its parameters");
  r->job.points = points;
  if (points) fputs("distance_m,ratio\n", points);
  for (int i = 0; i < o->n_log; i++) TRY(learn_log_teach(&r->job, o->log[i], &r->learn, why));
  if (r->learn.rls.count == 0)
    return error_set(why,
                     "%s: no sample may teach; allowed: %g to %g m from a known surface (rls.zMin, rls.zMax)",
                     o->log[o->n_log - 1], (double)p->learn.near_m, (double)p->learn.far_m);
  for (int i = 0; i < o->n_held_out; i++)
    TRY(learn_log_score(&r->job, o->held_out[i], &r->learn.rls.theta, &r->score[i], &r->bad[o->n_log + i],
                        why));
  return DONE;
}

// --- result -------------------------------------------------------------------------------------------

static cJSON *json_of(const order_t *o, const lesson_t *r) {
  cJSON *const json = cJSON_CreateObject();
  cJSON_AddItemToObject(json, "weights", cJSON_CreateFloatArray(r->learn.rls.theta.w, RBF_N));
  cJSON_AddNumberToObject(json, "mass_kg", (double)r->job.param.pos.mass_kg);
  cJSON_AddNumberToObject(json, "taught", r->learn.rls.count);
  cJSON *const list = cJSON_AddArrayToObject(json, "held_out");
  for (int i = 0; i < o->n_held_out; i++) {
    const learn_score_t *s = &r->score[i];
    cJSON *const item = cJSON_CreateObject();
    cJSON_AddStringToObject(item, "file", o->held_out[i]);
    cJSON_AddNumberToObject(item, "all_mN_before", 1e3 * s->all_before_N);
    cJSON_AddNumberToObject(item, "all_mN_after", 1e3 * s->all_after_N);
    // NaN is written as null.
    cJSON_AddNumberToObject(item, "below_7cm_mN_before", 1e3 * s->near_before_N);
    cJSON_AddNumberToObject(item, "below_7cm_mN_after", 1e3 * s->near_after_N);
    cJSON_AddNumberToObject(item, "bias_mN", 1e3 * s->bias_N);
    cJSON_AddItemToArray(list, item);
  }
  made_add(json, &o->made, (double)NAN, (double)r->learn.rls.count + (double)r->learn.refused);
  return json;
}

static done_t write_json(const order_t *o, const lesson_t *r, FILE *file, why_t *why) {
  cJSON *const json = json_of(o, r);
  const done_t status = result_write(json, file, why);
  cJSON_Delete(json);
  return status;
}

static void print_mN(double before_N, double after_N) {
  if (isnan(before_N))
    printf("  %8s -> %-6s", "-", "-");
  else
    printf("  %8.1f -> %-6.1f", 1e3 * before_N, 1e3 * after_N);
}

static void print(const order_t *o, const lesson_t *r) {
  const char *const group = o->surface == SURFACE_GROUND ? "ground" : "ceil";
  printf("# %u samples taught, %u were not allowed to; mass %.1f g (%s)\n", r->learn.rls.count,
         r->learn.refused, 1e3 * (double)r->job.param.pos.mass_kg, r->mass_from);
  for (int i = 0; i < o->n_log + o->n_held_out; i++)
    if (r->bad[i].n) printf("# %s\n", r->bad[i].first.text);
  for (int i = 0; i < RBF_N; i++) printf("%s.w%d = %.7g\n", group, i + 1, (double)r->learn.rls.theta.w[i]);
  if (o->n_held_out == 0) return;
  printf("\nvertical force residual without -> with the curve, mN\n%20s  %18s  %8s  %s\n", "all, sd",
         "below 7 cm, rms", "bias", "held-out flight");
  for (int i = 0; i < o->n_held_out; i++) {
    const learn_score_t *s = &r->score[i];
    print_mN(s->all_before_N, s->all_after_N);
    print_mN(s->near_before_N, s->near_after_N);
    printf("  %8.1f  %s\n", 1e3 * s->bias_N, o->held_out[i]);
  }
}

static done_t open_output(const order_t *o, output_t *out, why_t *why) {
  TRY(whole_files_open(&out->files, o->points, &out->points, why));
  TRY(whole_files_open(&out->files, o->json, &out->json, why));
  for (int i = 0; i < o->n_log; i++) TRY(whole_files_spare(&out->files, o->log[i], why));
  for (int i = 0; i < o->n_held_out; i++) TRY(whole_files_spare(&out->files, o->held_out[i], why));
  TRY(whole_files_spare(&out->files, o->columns, why));
  return whole_files_spare(&out->files, o->vehicle, why);
}

static done_t run(order_t *order, output_t *out, int argc, char **argv, why_t *why) {
  static lesson_t lesson;
  TRY(take_order(order, argc, argv, why));
  if (order->help) {
    fputs(USAGE, stdout);
    return DONE;
  }
  if (order->version) {
    made_version("learn");
    return DONE;
  }
  TRY(open_output(order, out, why));
  TRY(learn(order, &lesson, out->points, why));
  if (out->json) TRY(write_json(order, &lesson, out->json, why));
  print(order, &lesson);
  return DONE;
}

int main(int argc, char **argv) {
  static order_t order;
  static output_t out;
  why_t why;
  signal(SIGPIPE, SIG_IGN); // a closed pipe is an error like any other: no file is left behind
  const done_t status = run(&order, &out, argc, argv, &why);
  made_free(&order.made);
  return whole_files_exit(&out.files, "learn", status, &why);
}
