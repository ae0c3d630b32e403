// catalogue.c - prints what there is to fly, for people.
#include "flight/catalogue.h"

#include "crazyflie/sections.h"
#include "flight/params.h"
#include "flight/scenario.h"
#include "pilots/param_spec.h"
#include "sense/noise.h"
#include "sense/vertical.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The shortest text that reads back as this float.
static const char *shortest(float value, char text[32]) {
  for (int digits = 1; digits <= 9; digits++) {
    snprintf(text, 32, "%.*g", digits, (double)value);
    const bool plain = !strchr(text, 'e') || fabsf(value) < 1e-4f || fabsf(value) >= 1e6f;
    if (plain && strtof(text, NULL) == value) break;
  }
  return text;
}

void catalogue_params(bool markdown) {
  const char *const head =
      markdown ? "| parameter | unit | default | range | what it does |\n|---|---|---|---|---|\n"
               : "parameter        unit       default  range                what it does\n";
  fputs(head, stdout);
  for (int i = 0; i < params_count; i++) {
    const param_row_t *r = &params_table[i];
    char initial[32], min[32], max[32], range[80];
    snprintf(range, sizeof range, "%s to %s", shortest(r->min, min), shortest(r->max, max));
    printf(markdown ? "| `%s` | %s | %s | %s | %s |\n" : "%-16s %-5s %12s  %-20s %s\n", r->name, r->unit,
           shortest(r->initial, initial), range, r->help);
  }
  for (int i = 0; i < param_app_count; i++) {
    const param_app_t *a = &param_app_table[i];
    char initial[32], range[32];
    snprintf(range, sizeof range, "0 to %g", (double)a->max);
    printf(markdown ? "| `%s` | %s | %s | %s | %s |\n" : "%-16s %-5s %12s  %-20s %s\n", a->name, "",
           shortest(a->initial, initial), range, a->help);
  }
}

void catalogue_logs(void) {
  const section_log_group_t *const *group;
  const int n = sections_log_groups(&group);
  fputs("| group | logs |\n|---|---|\n", stdout);
  for (int i = 0; i < n; i++) {
    printf("| `%s` |", group[i]->name);
    for (const section_log_t *log = group[i]->log; log->name; log++) printf(" `%s`", log->name);
    fputs(" |\n", stdout);
  }
}

static void list_values(const fx_param_t *param, int n) {
  for (int i = 0; i < n; i++)
    printf("      %-8s %-4s %g (%g to %g)\n", param[i].name, param[i].unit[0] ? param[i].unit : "-",
           param[i].nominal, param[i].min, param[i].max);
}

static void list_effect(const fx_t *fx) {
  printf("  %-16s %s\n    law: %s\n", fx->name, fx->brief, fx->law);
  list_values(fx->param, fx->n_param);
  for (int i = 0; i < curve_count; i++) {
    const curve_t *curve = curve_table[i];
    if (!(curve->surfaces & fx->surface)) continue;
    printf("    form=%s: %s (%s)\n", curve->name, curve->brief, curve->source);
    list_values(curve->param, curve->n_param);
  }
}

static void tell_numbers(const fx_param_t *param, int n) {
  for (int i = 0; i < n; i++)
    printf("%s`%s` %g (%g to %g)%s%s", i ? "<br>" : "", param[i].name, param[i].nominal, param[i].min,
           param[i].max, param[i].unit[0] && !fx_is_number(&param[i]) ? " " : "",
           fx_is_number(&param[i]) ? "" : param[i].unit);
}

// Escapes bars, which would end the cell.
static void tell_law(const char *law) {
  for (; *law; law++) printf(*law == '|' ? "\\%c" : "%c", *law);
}

static void tell_effect(const fx_t *fx) {
  printf("| `%s` | %s | ", fx->name, fx->brief);
  tell_law(fx->law);
  fputs(" | ", stdout);
  tell_numbers(fx->param, fx->n_param);
  fputs(" |\n", stdout);
  for (int i = 0; i < curve_count; i++) {
    const curve_t *const curve = curve_table[i];
    if (!(curve->surfaces & fx->surface)) continue;
    printf("| | form `%s` (%s) | %s | ", curve->name, curve->source, curve->brief);
    tell_numbers(curve->param, curve->n_param);
    fputs(" |\n", stdout);
  }
}

void catalogue_effects(void) {
  printf("%s.\n\n| effect | what it is | what it does | typical (range) |\n|---|---|---|---|\n",
         fx_law_symbols);
  for (int i = 0; i < fx_count; i++) tell_effect(fx_table[i]);
}

static void list_noise(void) {
  printf("    %-14s %-6s", "", "");
  for (int k = 0; k < noise_count; k++) printf(" %8s", noise_levels[k].name);
  printf("  allowed\n");
  for (int i = 0; i < noise_field_count; i++) {
    const noise_field_t *f = &noise_fields[i];
    printf("    %-14s %-6s", f->name, f->unit[0] ? f->unit : "-");
    for (int k = 0; k < noise_count; k++) printf(" %8.3g", noise_get(&noise_levels[k], f));
    char span[32];
    snprintf(span, sizeof span, "%g to %g", f->min, f->max);
    printf("  %-11s  %s (%s)\n", span, f->brief, f->source);
  }
}

void catalogue_all(void) {
  printf("scenarios\n");
  for (int i = 0; i < scenario_count; i++)
    printf("  %-16s %s\n", scenario_table[i]->name, scenario_table[i]->brief);
  printf("controllers\n ");
  for (int i = 0; i < FLY_COUNT; i++)
    if (fly_name[i]) printf(" %s", fly_name[i]);
  printf("\neffects\n");
  for (int i = 0; i < fx_count; i++) list_effect(fx_table[i]);
  printf("noise\n ");
  for (int i = 0; i < vertical_noise_count; i++) printf(" %s", vertical_noise_levels[i].name);
  printf("\n  in six degrees of freedom:");
  for (int i = 0; i < noise_count; i++) printf(" %s", noise_levels[i].name);
  printf("; and of these, as real:acc.z=0.1,up=0.005\n");
  list_noise();
}
