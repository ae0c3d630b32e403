// fly.c - flies a scenario with a controller, prints a summary, and writes the flight as log and JSON.
#include "base/made.h"
#include "base/number.h"
#include "base/option.h"
#include "base/stream.h"
#include "base/threads.h"
#include "base/whole_file.h"
#include "crazyflie/usd_deck.h"
#include "drone/drone.h"
#include "flight/catalogue.h"
#include "flight/many.h"
#include "flight/replay_report.h"
#include "flight/request_spec.h"
#include "flight/scenario.h"
#include "fly_usage.h"
#include "pilots/controller_file.h"
#include "vehicle/model_file.h"

#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#define SEEDS_MAX 10000

typedef struct {
  const scenario_t *scenario;
  request_t request;
  fly_kind_t kind;
  model_t vehicle;
  int seeds; // 0: not said
  bool seed_said;
  double from, to; // NaN: not said
  const char *log, *json, *vehicle_path, *replay, *params_to, *usd, *usd_config;
  const char *commands, *scene, *storage, *summary;
  bool merge; // the words name summaries to merge, not a scenario
  char **file;
  int files;
  uLong crc; // checksum of the files that say what is flown; 0: none
  bool list, effects, logs, params, markdown, help, version, only_says, rate_said;
  made_t made, each; // each: of each of many flights, without its seed
  int not_finite;    // flights
  double rows;       // recorded
} order_t;

// --- options ------------------------------------------------------------------------------------------

static done_t take_count(const char *option, const char *text, double min, double max, double *value,
                         why_t *why) {
  if (number_parse(text, value) && *value >= min && *value <= max && *value == (double)(long)*value)
    return DONE;
  return error_set(why, "%s %s: allowed is a whole number from %.0f to %.0f", option, text, min, max);
}

static done_t take_params(order_t *o, const char *form, why_t *why) {
  o->params = true;
  o->markdown = form != NULL;
  if (!form || strcmp(form, "markdown") == 0) return DONE;
  return error_set(why, "--params=%s: allowed is --params, or --params=markdown", form);
}

// Adds a file's contents to the checksum: they say what is flown, too, not the file's name alone.
static done_t sign(order_t *o, const char *path, why_t *why) {
  FILE *file;
  unsigned char text[4096];
  TRY(stream_open(&file, path, why));
  for (size_t n; (n = fread(text, 1, sizeof text, file)) > 0;) o->crc = crc32(o->crc, text, (uInt)n);
  fclose(file);
  return DONE;
}

static done_t take_vehicle(order_t *o, const char *path, why_t *why) {
  flown_by_t flown_by; // not used here; a wrong one is reported
  o->vehicle_path = path;
  o->request.vehicle = &o->vehicle;
  TRY(model_read(path, &o->vehicle, why));
  TRY(sign(o, path, why));
  return controller_read(path, NULL, &o->vehicle, &flown_by, why);
}

// Returns where the option's file name goes; null: the option names no file.
static const char **path_of(order_t *o, int option) {
  switch (option) {
  case 'R': return &o->replay;
  case 'C': return &o->commands;
  case 'x': return &o->scene;
  case 'X': return &o->storage;
  case 'T': return &o->params_to;
  case 'u': return &o->usd;
  case 'U': return &o->usd_config;
  case 'l': return &o->log;
  case 'j': return &o->json;
  case 'M': return &o->summary;
  default: return NULL;
  }
}

static done_t take_option(order_t *o, int option, const char *text, why_t *why) {
  double count;
  const char **const path = path_of(o, option);
  if (path) {
    *path = text;
    return DONE;
  }
  switch (option) {
  case 'c': return request_take_controller(&o->request, &o->kind, text, why);
  case 'w': o->request.thesis_law = true; return DONE;
  case 's': return request_take_set(&o->request, text, why);
  case 'S': TRY(request_take_sets(&o->request, text, why)); return sign(o, text, why);
  case 'e': return request_take_effect(&o->request, text, why);
  case 'n': return request_take_noise(&o->request, text, why);
  case 'i': return request_take_integrator(&o->request, text, why);
  case 'v': return take_vehicle(o, text, why);
  case 'd':
    o->seed_said = true;
    TRY(take_count("--seed", text, 0.0, 1e9, &count, why));
    o->request.seed = (uint64_t)count;
    return DONE;
  case 'f': return take_count("--from", text, 0.0, 1e9, &o->from, why);
  case 't': return take_count("--to", text, 0.0, 1e9, &o->to, why);
  case 'm':
    TRY(take_count("--seeds", text, 1.0, SEEDS_MAX, &count, why));
    o->seeds = (int)count;
    return DONE;
  case 'r': o->rate_said = true; return request_take_log_rate(&o->request, text, why);
  case 'g': o->merge = true; return DONE;
  case 'L': o->list = true; return DONE;
  case 'E': o->effects = true; return DONE;
  case 'G': o->logs = true; return DONE;
  case 'P': return take_params(o, text, why);
  case 'V': o->version = true; return DONE;
  case 'h': o->help = true; return DONE;
  }
  return error_set(why, "an option that is not known, or without its value; fly --help lists them");
}

static bool many(const order_t *o) {
  return !isnan(o->from) || !isnan(o->to);
}

static done_t check_many(const order_t *o, why_t *why) {
  if (!many(o) && o->summary) return error_set(why, "--summary: allowed with --from and --to, or --merge");
  if (!many(o)) return DONE;
  if (!(o->from <= o->to)) return error_set(why, "--from, --to: both are needed, and --from <= --to");
  if (o->seeds > 0) return error_set(why, "--seeds: allowed is either that or --from and --to");
  if (o->seed_said) return error_set(why, "--seed: allowed is either that or --from and --to");
  if (o->log) return error_set(why, "--log: one flight can be written; leave out --from and --to");
  if (o->usd) return error_set(why, "--usd: one flight can be written; leave out --from and --to");
  return DONE;
}

// With --merge nothing is flown, and the words are files.
static done_t take_merge(order_t *o, const char *given, int argc, char **argv, why_t *why) {
  if (strspn(given, "gM") != strlen(given)) return error_set(why, "--merge: allowed with it is --summary");
  if (optind == argc) return error_set(why, "--merge: files are needed, as fly --summary writes them");
  o->file = argv + optind;
  o->files = argc - optind;
  return DONE;
}

// What clients sent is flown with the options of the desk alone.
static done_t check_commands(const order_t *o, const char *given, const char *scenario, why_t *why) {
  if (!o->commands) {
    if (!o->scene && !o->storage) return DONE;
    return error_set(why, "--scene, --storage: allowed with --commands FILE");
  }
  if (scenario) return error_set(why, "--commands: no scenario is flown; leave out %s", scenario);
  if (strspn(given, "CxXvendl") == strlen(given)) return DONE;
  return error_set(why,
                   "--commands: allowed with it are --scene, --storage, --vehicle, --effect, --noise, --seed "
                   "and --log");
}

static done_t take_order(order_t *o, int argc, char **argv, why_t *why) {
  *o = (order_t){.from = (double)NAN, .to = (double)NAN, .request = {.seed = 1}};
  o->made = made_by("fly", argc, argv);
  o->each = made_by("fly", 0, NULL);
  opterr = 0;
  char given[64] = "";
  for (int option, at; (option = getopt_long(argc, argv, "", OPTIONS, &at)) != -1;) {
    if (option == '?') return option_refuse(OPTIONS, argv[optind - 1], why);
    TRY(take_option(o, option, optarg, why));
    if (!strchr(given, option)) strcat(given, (char[]){(char)option, '\0'}); // one letter per option
    if (!strchr("ftjlTM", option)) made_option(&o->each, OPTIONS[at].name, optarg);
  }
  o->only_says = o->list || o->effects || o->logs || o->params || o->help || o->version;
  if (o->only_says) return DONE;
  if (o->merge) return take_merge(o, given, argc, argv, why);
  TRY(check_commands(o, given, argv[optind], why));
  if (o->replay && o->summary) return error_set(why, "--summary: nothing is flown by --replay; leave it out");
  if (o->commands || (o->replay && optind == argc)) return DONE;
  if (o->replay) return error_set(why, "--replay: no scenario is flown; leave out %s", argv[optind]);
  if (optind + 1 != argc) return error_set(why, "one scenario is needed; fly --list shows them");
  TRY(scenario_take(argv[optind], &o->scenario, why));
  made_word(&o->each, o->scenario->name);
  o->request.log = o->log != NULL;
  if (o->log && o->seeds > 1) return error_set(why, "--log: one flight can be written; leave out --seeds");
  if (!o->usd != !o->usd_config)
    return error_set(why, "--usd, --usd-config: both are needed; the config is tools/usd/config.txt");
  if (o->usd && o->seeds > 1) return error_set(why, "--usd: one flight can be written; leave out --seeds");
  if (o->rate_said && !o->log) return error_set(why, "--log-rate: allowed with --log FILE.csv");
  return check_many(o, why);
}

// --- flying -------------------------------------------------------------------------------------------

typedef struct { // the files that are written
  whole_files_t files;
  FILE *log, *json, *params, *usd, *summary;
} output_t;

static done_t open_output(const order_t *o, output_t *out, why_t *why) {
  TRY(whole_files_open(&out->files, o->log, &out->log, why));
  TRY(whole_files_open(&out->files, o->json, &out->json, why));
  TRY(whole_files_open(&out->files, o->params_to, &out->params, why));
  TRY(whole_files_open(&out->files, o->usd, &out->usd, why));
  TRY(whole_files_open(&out->files, o->summary, &out->summary, why));
  const char *const read[] = {o->usd_config, o->commands, o->scene, o->storage, o->vehicle_path};
  for (size_t i = 0; i < sizeof read / sizeof *read; i++) TRY(whole_files_spare(&out->files, read[i], why));
  for (int i = 0; i < o->files; i++) TRY(whole_files_spare(&out->files, o->file[i], why));
  return DONE;
}

static done_t tell(const order_t *o, cJSON *json, const record_t *record, output_t *out, why_t *why) {
  if (!json) return error_failed(why, "out of memory");
  made_add(json, &o->made, (double)o->request.seed, o->rows);
  if (out->log) record_write(record, out->log);
  if (out->params) made_comment(&o->made, out->params);
  for (int i = 0; out->params && record->param && i < params_count; i++)
    fprintf(out->params, "%s=%.9g\n", params_table[i].name, (double)record->param[i]);
  if (out->json) TRY(result_write(json, out->json, why));
  result_print(json, stdout);
  return DONE;
}

static done_t fly_once(const order_t *o, int i, result_t *result, why_t *why) {
  request_t request = o->request;
  request.seed += (uint64_t)i;
  TRY(result_init(result, why));
  return o->scenario->run(&request, result, why);
}

static done_t fly(order_t *o, output_t *out, why_t *why) {
  cJSON **json = calloc((size_t)o->seeds, sizeof(cJSON *));
  record_t record = {0};
  done_t status = json ? DONE : error_failed(why, "out of memory");
  for (int i = 0; i < o->seeds && status == DONE; i++) {
    result_t result;
    status = fly_once(o, i, &result, why);
    json[i] = result.json;
    o->not_finite += cJSON_IsFalse(cJSON_GetObjectItem(result.json, "finite"));
    record_free(&record);
    record = result.record;
    o->rows += record.n;
    if (o->seeds > 1 && isatty(STDERR_FILENO)) fprintf(stderr, "\r%d of %d flights", i + 1, o->seeds);
  }
  if (o->seeds > 1 && isatty(STDERR_FILENO)) fputc('\n', stderr);
  if (status == DONE) {
    cJSON *all =
        o->seeds > 1 ? result_over_seeds(json, o->seeds, o->request.seed) : cJSON_Duplicate(json[0], true);
    status = tell(o, all, &record, out, why);
    cJSON_Delete(all);
  }
  for (int i = 0; json && i < o->seeds; i++) cJSON_Delete(json[i]);
  free(json);
  record_free(&record);
  return status;
}

static done_t fly_with_deck(order_t *o, output_t *out, why_t *why) {
  static usd_deck_t deck;
  TRY(usd_deck_init(&deck, o->usd_config, out->usd, why));
  o->request.usd = &deck;
  TRY(fly(o, out, why));
  if (deck.flights != 1)
    return error_set(why, "--usd: %d flights of the app in 6-DoF; allowed is one", deck.flights);
  usd_deck_stop(&deck);
  return DONE;
}

static done_t tell_summary(const summary_t *s, const output_t *out, why_t *why) {
  summary_print(s, stdout);
  return out->summary ? summary_write(s, out->summary, why) : DONE;
}

// A cell's name is the command alone, with a checksum of the files that it names.
static done_t open_summary(const order_t *o, summary_t *s, why_t *why) {
  char files[40] = "";
  if (o->crc) snprintf(files, sizeof files, " # files %08lx", o->crc);
  const size_t room = strlen(o->each.command) + sizeof files;
  char *const cell = malloc(room);
  if (!cell) return error_failed(why, "out of memory");
  snprintf(cell, room, "%s%s", o->each.command, files);
  const done_t status = summary_make(s, cell, o->each.by, why);
  free(cell);
  return status;
}

static done_t fly_many(order_t *o, output_t *out, why_t *why) {
  summary_t summary = {0};
  if (o->summary) TRY(open_summary(o, &summary, why));
  const many_t m = {
      .scenario = o->scenario,
      .request = &o->request,
      .from = (uint64_t)o->from,
      .to = (uint64_t)o->to,
      .text = o->summary ? NULL : stdout,
      .json = out->json,
      .summary = o->summary ? &summary : NULL,
      .progress = isatty(STDERR_FILENO) && (o->summary || !isatty(STDOUT_FILENO)),
      .not_finite = &o->not_finite,
      .made = &o->each,
  };
  done_t status = many_fly(&m, why);
  if (status == DONE && o->summary) status = tell_summary(&summary, out, why);
  summary_free(&summary);
  return status;
}

static done_t merge(order_t *o, const output_t *out, why_t *why) {
  summary_t *const all = calloc(SUMMARY_CELLS_MAX, sizeof *all);
  int n = 0;
  done_t status = all ? DONE : error_failed(why, "out of memory");
  for (int i = 0; i < o->files && status == DONE; i++) status = summary_gather(all, &n, o->file[i], why);
  for (int i = 0; i < n && status == DONE; i++) {
    o->not_finite = (int)smaller(INT_MAX, o->not_finite + (double)all[i].not_finite);
    status = tell_summary(&all[i], out, why);
  }
  for (int i = 0; i < n; i++) summary_free(&all[i]);
  free(all);
  return status;
}

#define AFTER_S 1.0 // flight time after the last packet

static done_t fly_commands(order_t *o, output_t *out, why_t *why) {
  static drone_t drone;
  scene_t scene;
  TRY(scene_take(&scene, o->scene, &o->request, o->seed_said, why));
  FILE *commands;
  TRY(stream_open(&commands, o->commands, why));
  done_t status = drone_open(&drone, &scene, o->storage, out->log, NULL, why);
  if (status == DONE) {
    status = drone_replay(&drone, commands, o->commands, AFTER_S, why);
    if (status == DONE)
      printf("%.1f s of what clients sent; %d contacts, at the end %.2f m high and %s\n",
             1e-3 * drone_now_ms(&drone), (int)drone.logs.contacts, (double)drone.logs.z,
             supervised_words(drone.firmware.vehicle.supervised.state));
    why_t lost;
    if (drone_close(&drone, &lost) != DONE && status == DONE) status = error_failed(why, "%s", lost.text);
  }
  fclose(commands);
  return status;
}

static done_t run(order_t *order, output_t *out, int argc, char **argv, why_t *why) {
  TRY(take_order(order, argc, argv, why));
  if (order->help) fputs(USAGE, stdout);
  if (order->version) made_version("fly");
  if (order->list) catalogue_all();
  if (order->effects) catalogue_effects();
  if (order->logs) catalogue_logs();
  if (order->params) catalogue_params(order->markdown);
  if (order->only_says) return DONE;
  if (order->replay) return replay_report(order->replay, &order->request, why);
  if (!order->scenario && !order->commands && !order->merge) return DONE;
  if (order->seeds == 0) order->seeds = 1;
  if (many(order)) threads_sleep(argv); // a single flight would start for a tenth of its time
  TRY(open_output(order, out, why));
  if (order->merge) return merge(order, out, why);
  if (order->commands) return fly_commands(order, out, why);
  if (out->usd) return fly_with_deck(order, out, why);
  return many(order) ? fly_many(order, out, why) : fly(order, out, why);
}

int main(int argc, char **argv) {
  static order_t order;
  static output_t out;
  why_t why;
  signal(SIGPIPE, SIG_IGN); // a closed pipe is an error like any other: no file is left behind
  const done_t status = run(&order, &out, argc, argv, &why);
  const int ended = whole_files_exit(&out.files, "fly", status, &why);
  made_free(&order.made);
  made_free(&order.each);
  if (ended != 0 || order.not_finite == 0) return ended;
  return error_exit("fly", error_failed(&why, "not finite: %d of the flights", order.not_finite), &why);
}
