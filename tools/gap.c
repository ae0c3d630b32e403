// gap.c - finds where flight logs and a vehicle model disagree, names the missing effect, and shows it on
// held-out flights.
#define _POSIX_C_SOURCE 200809L
#include "base/number.h"
#include "base/option.h"
#include "base/threads.h"
#include "base/whole_file.h"
#include "gap/6_extend/extend.h"
#include "gap/8_report/report.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PATH_BYTES 4200

typedef struct {
  study_order_t study;
  const char **hold_out;
  const char *out, *json; // null: not given
  bool help, version;
  made_t made;
  char verdict[PATH_BYTES], page[PATH_BYTES], model[PATH_BYTES], curves[PATH_BYTES]; // in the folder `out`
} order_t;

static const char USAGE[] =
    "usage: gap [options] LOG...\n"
    "  --vehicle FILE   a vehicle file (sim/vehicle/vehicles/*.toml; else the Crazyflie 2.1 with legacy "
    "propellers)\n"
    "  --columns FILE   which column of the logs is what (tools/columns/*.toml; else the Crazyflie's own "
    "names)\n"
    "  --hold-out LOG   a log that nothing is fitted to (may be repeated; else the last third of three "
    "flights "
    "or more;\n"
    "                   of fewer, stretches of 2 s by turns)\n"
    "  --out DIR        writes verdict.json, report.html, curves.csv and model.toml there, in place of those "
    "of an "
    "earlier run;\n"
    "                   nothing else there is touched, and without --out or --json no file is\n"
    "  --json FILE      writes verdict.json there\n"
    "  --seed N         of the flights that show what feedback alone does (1)\n"
    "  --version        version and commit\n"
    "  --help           this\n"
    "LOG: a CSV or the .bin of a uSD deck, packed by gzip or not, or the CSV files that cfclient wrote of "
    "one\n"
    "flight: FILE+FILE+.., or their folder. Exit status: 0, whatever is found; 2 if the input is bad (then\n"
    "verdict.json says `refused` and why, and model.toml and curves.csv of an earlier run are removed); 1 if "
    "something "
    "else fails.\n";

// --- options ------------------------------------------------------------------------------------------

static done_t take_once(const char **to, const char *option, const char *text, why_t *why) {
  if (*to) return error_set(why, "--%s: given twice; allowed: once", option);
  *to = text;
  return DONE;
}

static done_t take_option(order_t *o, int option, const char *text, why_t *why) {
  double seed;
  switch (option) {
  case 'v': return take_once(&o->study.vehicle, "vehicle", text, why);
  case 'c': return take_once(&o->study.columns, "columns", text, why);
  case 'x': o->hold_out[o->study.n_hold_out++] = text; return DONE;
  case 'o': return take_once(&o->out, "out", text, why);
  case 'j': return take_once(&o->json, "json", text, why);
  case 'h': o->help = true; return DONE;
  case 'V': o->version = true; return DONE;
  case 's':
    if (!number_parse(text, &seed) || !(seed >= 0.0 && seed <= 1e9) || seed != (double)(unsigned long)seed)
      return error_set(why, "--seed %.40s: allowed is a whole number from 0 to 1000000000", text);
    o->study.seed = (unsigned long)seed;
    return DONE;
  }
  return DONE;
}

static done_t take_paths(order_t *o, why_t *why) {
  if (o->json && !o->json[0]) return error_set(why, "--json: an empty path; allowed: a file's");
  if (!o->out) return DONE;
  const int a = snprintf(o->verdict, PATH_BYTES, "%s/verdict.json", o->out);
  snprintf(o->page, PATH_BYTES, "%s/report.html", o->out);
  snprintf(o->curves, PATH_BYTES, "%s/curves.csv", o->out);
  snprintf(o->model, PATH_BYTES, "%s/model.toml", o->out);
  return a < 4000 && o->out[0] ? DONE : error_set(why, "--out %.60s: not a folder's path", o->out);
}

static done_t take_order(order_t *o, int argc, char **argv, why_t *why) {
  static const struct option options[] = {
      {"vehicle", 1, 0, 'v'}, {"columns", 1, 0, 'c'}, {"hold-out", 1, 0, 'x'},
      {"out", 1, 0, 'o'},     {"json", 1, 0, 'j'},    {"seed", 1, 0, 's'},
      {"help", 0, 0, 'h'},    {"version", 0, 0, 'V'}, {0}};
  o->study.seed = 1;
  o->made = made_by("gap", argc, argv);
  o->study.made = &o->made;
  o->hold_out = calloc((size_t)argc + 1, sizeof *o->hold_out);
  if (!o->hold_out) return error_failed(why, "out of memory");
  opterr = 0;
  for (int option; (option = getopt_long(argc, argv, "", options, NULL)) != -1;) {
    if (option == '?') return option_refuse(options, argv[optind - 1], why);
    TRY(take_option(o, option, optarg, why));
  }
  o->study.hold_out = o->hold_out;
  o->study.log = (const char *const *)argv + optind;
  o->study.n_log = argc - optind;
  if (o->help || o->version) return DONE;
  if (o->study.n_log == 0) return error_set(why, "no log; allowed: gap [options] LOG...");
  return take_paths(o, why);
}

// --- output -------------------------------------------------------------------------------------------

typedef struct {
  whole_files_t files;
  FILE *verdict, *page, *model, *curves, *json;
  char *words; // for standard output, once the files are written
} output_t;

static bool is_folder(const char *path) {
  struct stat s;
  return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

// Makes a folder and its parents. BAD_INPUT: cannot be made, or not a folder.
static done_t make_folder(const char *path, why_t *why) {
  char part[PATH_BYTES] = "";
  for (size_t n = 1; path && n <= strlen(path); n++) {
    if (path[n] != '/' && path[n] != '\0') continue;
    snprintf(part, sizeof part, "%.*s", (int)n, path);
    if (mkdir(part, 0777) == 0) continue;
    const int cause = errno;
    if (is_folder(part)) continue;
    return error_set(why, "--out %.300s: %s", part,
                     cause == EEXIST || cause == ENOTDIR ? "not a folder" : strerror(cause));
  }
  return DONE;
}

// Opens all outputs before the work begins, so that one that cannot be written is refused at once.
static done_t open_output(const order_t *o, bool refused, output_t *w, why_t *why) {
  TRY(make_folder(o->out, why));
  TRY(whole_files_open(&w->files, o->out ? o->verdict : NULL, &w->verdict, why));
  TRY(whole_files_open(&w->files, o->out ? o->page : NULL, &w->page, why));
  if (!refused) TRY(whole_files_open(&w->files, o->out ? o->model : NULL, &w->model, why));
  if (!refused) TRY(whole_files_open(&w->files, o->out ? o->curves : NULL, &w->curves, why));
  TRY(whole_files_open(&w->files, o->json, &w->json, why));
  TRY(whole_files_spare(&w->files, o->study.vehicle, why));
  TRY(whole_files_spare(&w->files, o->study.columns, why));
  for (int i = 0; i < o->study.n_log; i++) TRY(whole_files_spare(&w->files, o->study.log[i], why));
  for (int i = 0; i < o->study.n_hold_out; i++) TRY(whole_files_spare(&w->files, o->study.hold_out[i], why));
  return DONE;
}

static done_t write_json(cJSON *json, const output_t *w, why_t *why) {
  done_t status = json ? DONE : error_failed(why, "out of memory");
  if (status == DONE && w->verdict) status = report_write_json(json, w->verdict, why);
  if (status == DONE && w->json) status = report_write_json(json, w->json, why);
  cJSON_Delete(json);
  return status;
}

static done_t write_words(const report_t *r, output_t *w, why_t *why) {
  size_t size;
  FILE *const out = open_memstream(&w->words, &size);
  if (!out) return error_failed(why, "out of memory");
  report_words(r, out);
  return fclose(out) == 0 ? DONE : error_failed(why, "out of memory");
}

static done_t write_all(const report_t *r, output_t *w, why_t *why) {
  const study_t *const s = r->study;
  char logs[120];
  long rows = 0;
  for (int i = 0; i < s->fit.n; i++) rows += s->flight[i].rows;
  snprintf(logs, sizeof logs, "%d flight%s, %ld rows, seed %lu", s->fit.n, s->fit.n > 1 ? "s" : "", rows,
           s->order.seed);
  const extend_job_t job = {study_vehicle(s), s->vehicle_text, &s->vehicle, &s->diagnosis.found, logs,
                            s->order.made};
  TRY(write_json(report_verdict(r), w, why));
  if (w->page) report_page(r, w->page);
  if (w->curves) report_curves(r, w->curves);
  if (w->model) TRY(extend_write(&job, w->model, why));
  return write_words(r, w, why);
}

static bool begins(const char *path, const char *text) {
  char first[40] = "";
  FILE *const file = fopen(path, "r");
  const bool ours = file && fgets(first, sizeof first, file) && strncmp(first, text, strlen(text)) == 0;
  if (file) fclose(file);
  return ours;
}

// Removes what an earlier run found, which must not lie beside a refusal. Files of other programs stay.
static void remove_found(const order_t *o) {
  if (!o->out) return;
  if (begins(o->model, "# Written by gap: ")) (void)!remove(o->model);
  if (begins(o->curves, "effect,channel,channel_unit,")) (void)!remove(o->curves);
}

// Writes the refusal. Its own errors are ignored: either they were reported before, or the refusal matters
// more.
static void refuse(const order_t *o, const why_t *line) {
  output_t w = {.verdict = NULL};
  why_t why;
  done_t status = open_output(o, true, &w, &why);
  if (status == DONE) status = write_json(report_refused(line->text, &o->study), &w, &why);
  if (status == DONE && w.page) report_page_refused(line->text, &o->study, w.page);
  if (status == DONE && whole_files_commit(&w.files, &why) == DONE) remove_found(o);
  whole_files_drop(&w.files);
}

// --- the program --------------------------------------------------------------------------------------

static void progress(const char *what) {
  fprintf(stderr, "\r\033[K%s", what);
}

static done_t work(const order_t *o, output_t *w, bool *begun, why_t *why) {
  study_t *const study = calloc(1, sizeof *study);
  report_t *const report = calloc(1, sizeof *report);
  done_t status = study && report ? open_output(o, false, w, why) : error_failed(why, "out of memory");
  *begun = status == DONE;
  if (status == DONE) status = study_make(study, &o->study, why);
  if (status == DONE) status = report_make(report, study, why);
  if (o->study.progress) fputs("\r\033[K", stderr);
  if (status == DONE) status = write_all(report, w, why);
  if (report) report_free(report);
  if (study) study_free(study);
  free(report);
  free(study);
  return status;
}

int main(int argc, char **argv) {
  static order_t order;
  static output_t out;
  why_t why = {""};
  bool begun = false;
  threads_sleep(argv);
  signal(SIGPIPE, SIG_IGN); // a closed pipe is then an error like any other: no partial file stays
  done_t status = take_order(&order, argc, argv, &why);
  if (isatty(STDERR_FILENO)) order.study.progress = progress;
  if (status == DONE && order.help) fputs(USAGE, stdout);
  if (status == DONE && order.version) made_version("gap");
  if (status == DONE && !order.help && !order.version) status = work(&order, &out, &begun, &why);
  const int ended = whole_files_exit(&out.files, "gap", status, &why);
  if (ended == 0 && out.words) fputs(out.words, stdout);
  if (ended == 0 && out.words && order.out) printf("  read: %s\n", order.page);
  if (begun && ended == 2) refuse(&order, &why);
  free(out.words);
  free(order.hold_out);
  made_free(&order.made);
  return ended;
}
