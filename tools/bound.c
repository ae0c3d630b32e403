// bound.c - the least height error that any controller could have below a ceiling, beside what disturbs it.
#include "base/constants.h"
#include "base/made.h"
#include "base/number.h"
#include "base/option.h"
#include "flight/bound_plant.h"
#include "flight/request_spec.h"
#include "flight/setup.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define GAPS_MAX 32
#define FAR_MM   1000.0

static const char USAGE[] =
    "usage: bound [options] [GAP ...]      gaps of the propellers to the ceiling in mm (100 40 20 10)\n"
    "  --noise LEVEL      whose sensors and gusts: quiet, real or flown, or of these some numbers changed,\n"
    "                     as fly takes them (flown)\n"
    "  --walk SIZE        of the force that walks, m/s2 per root second (0.1)\n"
    "  --vehicle FILE     a vehicle file (the thesis's Crazyflie)\n"
    "  --effect NAME[:KEY=VALUE,...]  as fly takes it (may be repeated)\n"
    "  --version, --help\n"
    "rms of the height about what is wanted, in mm, of the best linear controller that knows vehicle and "
    "ceiling\n"
    "exactly: without any force, with one that walks, and with the level's gusts (sim/flight/bound.h).\n";

typedef struct {
  request_t request;
  model_t vehicle;
  double walk_mps2, gap_mm[GAPS_MAX];
  int gaps;
  bool help, version;
} order_t;

static done_t take_number(const char *what, const char *text, double min, double max, double *value,
                          why_t *why) {
  if (number_parse(text, value) && *value >= min && *value <= max) return DONE;
  return error_set(why, "%s %s: allowed is a number from %g to %g", what, text, min, max);
}

static done_t take_option(order_t *o, int option, const char *text, why_t *why) {
  switch (option) {
  case 'n': return request_take_noise(&o->request, text, why);
  case 'e': return request_take_effect(&o->request, text, why);
  case 'w': return take_number("--walk", text, 0.0, 10.0, &o->walk_mps2, why);
  case 'v': o->request.vehicle = &o->vehicle; return model_read(text, &o->vehicle, why);
  case 'V': o->version = true; return DONE;
  default: o->help = true; return DONE;
  }
}

static done_t take_order(order_t *o, int argc, char **argv, why_t *why) {
  static const struct option options[] = {
      {"noise", 1, 0, 'n'},
      {"walk", 1, 0, 'w'},
      {"vehicle", 1, 0, 'v'},
      {"effect", 1, 0, 'e'},
      {"help", 0, 0, 'h'},
      {"version", 0, 0, 'V'},
      {0},
  };
  static const double usual_mm[] = {100.0, 40.0, 20.0, 10.0};
  o->walk_mps2 = 0.1;
  o->request.noise = noise_find("flown");
  opterr = 0;
  for (int option; (option = getopt_long(argc, argv, "", options, NULL)) != -1;) {
    if (option == '?') return option_refuse(options, argv[optind - 1], why);
    TRY(take_option(o, option, optarg, why));
  }
  if (argc - optind > GAPS_MAX) return error_set(why, "at most %d gaps", GAPS_MAX);
  for (; optind < argc; optind++)
    TRY(take_number("a gap,", argv[optind], 1.0, FAR_MM, &o->gap_mm[o->gaps++], why));
  if (o->gaps > 0) return DONE;
  for (; o->gaps < 4; o->gaps++) o->gap_mm[o->gaps] = usual_mm[o->gaps];
  return DONE;
}

static done_t check_flies(const model_t *m, why_t *why) {
  if (m->thrust_max_N > m->mass_kg * G_MPS2) return DONE;
  return error_set(why, "vehicle %s: thrust_max_N %g does not carry mass_kg %g; such a vehicle cannot hover",
                   m->name, m->thrust_max_N, m->mass_kg);
}

static void tell(const setup_t *s, double walk_mps2, double gap_mm) {
  const double gap_m = 1e-3 * gap_mm;
  const bound_plant_t none = bound_plant(&s->model, &s->plan.noise, gap_m, (bound_force_t){0});
  const bound_plant_t walk =
      bound_plant(&s->model, &s->plan.noise, gap_m, (bound_force_t){.walk_mps2 = walk_mps2});
  printf("%7.4g  %9.3g  %9.2f  %9.2f", gap_mm, none.stiffness_per_s2, 1e3 * bound_of(&none).rms_m,
         1e3 * bound_of(&walk).rms_m);
  if (s->plan.noise.vary.gust_max_mps2 > 0.0)
    printf("  %9.2f", 1e3 * bound_of_gusts(&s->model, &s->plan.noise, gap_m).rms_m);
  putchar('\n');
}

static done_t run(order_t *o, int argc, char **argv, why_t *why) {
  TRY(take_order(o, argc, argv, why));
  if (o->help) fputs(USAGE, stdout);
  if (o->version) made_version("bound");
  if (o->help || o->version) return DONE;
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI, why));
  TRY(setup_apply(&setup, &o->request, why));
  TRY(check_flies(&setup.model, why));
  printf("%7s  %9s  %9s  %9s%s\n", "gap_mm", "k_per_s2", "still_mm", "walk_mm",
         setup.plan.noise.vary.gust_max_mps2 > 0.0 ? "   gusts_mm" : "");
  for (int i = 0; i < o->gaps; i++) tell(&setup, o->walk_mps2, o->gap_mm[i]);
  return DONE;
}

int main(int argc, char **argv) {
  static order_t order;
  why_t why;
  return error_exit("bound", run(&order, argc, argv, &why), &why);
}
