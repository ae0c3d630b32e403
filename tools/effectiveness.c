// effectiveness.c - control effectiveness of the inner loop from a 500 Hz log, beside the firmware's numbers.
#include "logs/effectiveness.h"

#include "base/made.h"
#include "base/number.h"
#include "base/option.h"
#include "base/whole_file.h"
#include "flight/result.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
  effectiveness_job_t job;
  const char *log, *json;
  bool help, version;
  made_t made;
} order_t;

static const char USAGE[] =
    "usage: effectiveness LOG [options]\n"
    "  --lag S            first-order lag of the motors, seconds (0.0625)\n"
    "  --delay S          from a command to the lag, the gyro's filter included; whole ticks of 2 ms (0)\n"
    "  --cutoff HZ        of the low-pass that all signals pass (4)\n"
    "  --poles N          of that low-pass: 2 or 4 (4)\n"
    "  --thrust-min UNITS rows with less thrust do not count, where controller.cmd_thrust is logged (10000)\n"
    "  --motor-max N      of the app's own logs: THRUST_MAX of the firmware, of one motor (0.12; with the\n"
    "                     thrust upgrade 0.18)\n"
    "  --as-stock         as the firmware's own numbers were found: 61.7 ms, 4 Hz, 4 poles, every row "
    "counts,\n"
    "                     gaps are not seen; options after it change it\n"
    "  --json FILE        writes the fit\n"
    "  --version          version and commit\n"
    "  --help             this\n"
    "\n"
    "Columns: tick (ms, 500 Hz), controller.r_roll, r_pitch, r_yaw (rad/s), controller.cmd_roll, cmd_pitch,\n"
    "cmd_yaw (16-bit units); or the app's own, indiIn.step, p, q, r and indi.m1..m4, as the uSD deck writes "
    "them.\n"
    "Yaw is counted clockwise, as its command.\n";

static done_t take_number(const char *option, const char *text, double min, double max, double *value,
                          why_t *why) {
  double x;
  if (!number_parse(text, &x) || !(x >= min && x <= max))
    return error_set(why, "%s %s: allowed is a number from %g to %g", option, text, min, max);
  *value = x;
  return DONE;
}

static done_t take_poles(int *poles, const char *text, why_t *why) {
  double n;
  if (!number_parse(text, &n) || (n != 2.0 && n != 4.0))
    return error_set(why, "--poles %s: allowed are 2, 4", text);
  *poles = (int)n;
  return DONE;
}

static done_t take_option(order_t *o, int option, const char *text, why_t *why) {
  switch (option) {
  case 'l': return take_number("--lag", text, 0.001, 0.5, &o->job.lag_s, why);
  case 'd': return take_number("--delay", text, 0.0, EFFECTIVENESS_DELAY_S, &o->job.delay_s, why);
  case 'c': return take_number("--cutoff", text, 0.1, 100.0, &o->job.cutoff_Hz, why);
  case 'p': return take_poles(&o->job.poles, text, why);
  case 't': return take_number("--thrust-min", text, 0.0, 65535.0, &o->job.thrust_min, why);
  case 'm': return take_number("--motor-max", text, 0.01, 10.0, &o->job.motor_max_N, why);
  case 's': o->job = effectiveness_stock(); return DONE;
  case 'j': o->json = text; return DONE;
  case 'V': o->version = true; return DONE;
  default: o->help = true; return DONE;
  }
}

static done_t take_order(order_t *o, int argc, char **argv, why_t *why) {
  static const struct option options[] = {
      {"lag", 1, 0, 'l'},
      {"delay", 1, 0, 'd'},
      {"cutoff", 1, 0, 'c'},
      {"poles", 1, 0, 'p'},
      {"thrust-min", 1, 0, 't'},
      {"motor-max", 1, 0, 'm'},
      {"as-stock", 0, 0, 's'},
      {"json", 1, 0, 'j'},
      {"help", 0, 0, 'h'},
      {"version", 0, 0, 'V'},
      {0},
  };
  *o = (order_t){.job = effectiveness_default(), .made = made_by("effectiveness", argc, argv)};
  opterr = 0;
  for (int option; (option = getopt_long(argc, argv, "", options, NULL)) != -1;) {
    if (option == '?') return option_refuse(options, argv[optind - 1], why);
    TRY(take_option(o, option, optarg, why));
  }
  if (o->help || o->version) return DONE;
  if (argc - optind != 1) return error_set(why, "one log is needed; allowed: effectiveness LOG.csv");
  o->log = argv[optind];
  return DONE;
}

static done_t write_json(const order_t *o, const effectiveness_t *r, FILE *file, why_t *why) {
  const double stock[3] = EFFECTIVENESS_STOCK_G1;
  cJSON *const json = cJSON_CreateObject();
  cJSON_AddStringToObject(json, "file", o->log);
  cJSON_AddItemToObject(json, "g1", cJSON_CreateDoubleArray(r->g1, 3));
  cJSON_AddNumberToObject(json, "g2", r->g2);
  cJSON_AddItemToObject(json, "explained", cJSON_CreateDoubleArray(r->explained, 3));
  cJSON_AddItemToObject(json, "stock_g1", cJSON_CreateDoubleArray(stock, 3));
  cJSON_AddNumberToObject(json, "stock_g2_per_tick", EFFECTIVENESS_STOCK_G2);
  cJSON_AddNumberToObject(json, "lag_s", o->job.lag_s);
  cJSON_AddNumberToObject(json, "delay_s", o->job.delay_s);
  cJSON_AddNumberToObject(json, "cutoff_Hz", o->job.cutoff_Hz);
  cJSON_AddNumberToObject(json, "rows", (double)r->rows);
  cJSON_AddNumberToObject(json, "bridged", (double)r->bridged);
  cJSON_AddNumberToObject(json, "starts", (double)r->starts);
  cJSON_AddNumberToObject(json, "used", (double)r->used);
  made_add(json, &o->made, (double)NAN, (double)r->rows);
  const done_t status = result_write(json, file, why);
  cJSON_Delete(json);
  return status;
}

static void print(const order_t *o, const effectiveness_t *r) {
  static const char *const axis[3] = {"roll", "pitch", "yaw"};
  const double stock[3] = EFFECTIVENESS_STOCK_G1;
  printf(
      "# %ld rows, %ld ticks bridged, %ld used; lag %g ms, delay %g ms, %d poles at %g Hz; yaw clockwise\n",
      r->rows, r->bridged, r->used, 1e3 * o->job.lag_s, 1e3 * o->job.delay_s, o->job.poles, o->job.cutoff_Hz);
  printf("%-10s %11s %11s %7s %10s\n", "", "fitted", "stock", "ratio", "explained");
  for (int i = 0; i < 3; i++)
    printf("G1 %-7s %11.5g %11.5g %7.3f %8.0f %%\n", axis[i], r->g1[i], stock[i], r->g1[i] / stock[i],
           100.0 * r->explained[i]);
  printf("G2 yaw     %11.5g %11.5g\n", r->g2 / EFFECTIVENESS_PERIOD_S, EFFECTIVENESS_STOCK_G2);
  printf("# G1: rad/s2 per unit. G2: rad/s2 per unit and tick of 2 ms; fitted, per unit/s, it is %.5g\n",
         r->g2);
  if (r->g2 < 0.0)
    puts(o->job.as_stock
             ? "# G2 < 0 is no rotor's inertia, found in this way; the firmware has it with the other sign, "
               "and "
               "per tick\n# what is per unit/s here"
             : "# G2 < 0 is no rotor's inertia: --lag or --delay is not that of the motors, or yaw moved too "
               "little");
}

static done_t run(order_t *o, whole_files_t *files, int argc, char **argv, why_t *why) {
  effectiveness_t result = {.rows = 0};
  FILE *json;
  TRY(take_order(o, argc, argv, why));
  if (o->help) fputs(USAGE, stdout);
  if (o->version) made_version("effectiveness");
  if (!o->log) return DONE;
  TRY(whole_files_open(files, o->json, &json, why));
  TRY(whole_files_spare(files, o->log, why));
  TRY(effectiveness_fit(o->log, &o->job, &result, why));
  if (json) TRY(write_json(o, &result, json, why));
  print(o, &result);
  return DONE;
}

int main(int argc, char **argv) {
  static order_t order;
  static whole_files_t files;
  why_t why;
  signal(SIGPIPE, SIG_IGN); // a closed pipe is an error like any other: no file is left behind
  const done_t status = run(&order, &files, argc, argv, &why);
  made_free(&order.made);
  return whole_files_exit(&files, "effectiveness", status, &why);
}
