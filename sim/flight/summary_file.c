// summary_file.c - summaries as JSON lines, and as a table for people.
#define _POSIX_C_SOURCE 200809L // getline
#include "flight/summary.h"

#include "base/stream.h"
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

#define WHOLE_MOST 9007199254740992.0 // 2^53: larger whole numbers are not exact in JSON

// --- writing ----------------------------------------------------------------------------------------------

static void add_pair(cJSON *to, double first, double second) {
  cJSON_AddItemToArray(to, cJSON_CreateDoubleArray((const double[]){first, second}, 2));
}

// Least and most are doubles, which 17 digits restore; the sum is text, as it may need more than 53 bits.
static cJSON *json_of(const measure_t *m) {
  char sum[24];
  cJSON *const o = cJSON_CreateObject();
  snprintf(sum, sizeof sum, "%lld", (long long)m->sum);
  cJSON_AddStringToObject(o, "name", m->name);
  cJSON_AddNumberToObject(o, "flights", (double)m->flights);
  cJSON_AddStringToObject(o, "sum", sum);
  if (m->flights > 0) {
    cJSON_AddNumberToObject(o, "least", m->least);
    cJSON_AddNumberToObject(o, "most", m->most);
  }
  cJSON *const bins = cJSON_AddArrayToObject(o, "bins");
  for (int k = 0; k < SUMMARY_BINS; k++)
    if (m->in[k] > 0) add_pair(bins, k - SUMMARY_SIDE, (double)m->in[k]);
  return o;
}

done_t summary_write(const summary_t *s, FILE *out, why_t *why) {
  cJSON *const o = cJSON_CreateObject();
  cJSON_AddNumberToObject(o, "fly_summary", 1);
  cJSON_AddStringToObject(o, "cell", s->cell);
  cJSON_AddStringToObject(o, "by", s->by);
  cJSON_AddNumberToObject(o, "flights", (double)s->flights);
  cJSON_AddNumberToObject(o, "touched", (double)s->touched);
  cJSON_AddNumberToObject(o, "not_finite", (double)s->not_finite);
  cJSON *const seeds = cJSON_AddArrayToObject(o, "seeds");
  for (int i = 0; i < s->n_seeds; i++) add_pair(seeds, (double)s->seeds[i].from, (double)s->seeds[i].to);
  cJSON *const measures = cJSON_AddArrayToObject(o, "measures");
  for (int i = 0; i < s->n_measure; i++) cJSON_AddItemToArray(measures, json_of(&s->measure[i]));
  char *const text = measures ? cJSON_PrintUnformatted(o) : NULL;
  if (text) fprintf(out, "%s\n", text);
  cJSON_free(text);
  cJSON_Delete(o);
  return text ? DONE : error_failed(why, "out of memory");
}

void summary_print(const summary_t *s, FILE *out) {
  fprintf(out, "%s\n  flights %lld, touched %lld, not finite %lld, seeds", s->cell, (long long)s->flights,
          (long long)s->touched, (long long)s->not_finite);
  for (int i = 0; i < s->n_seeds; i++)
    fprintf(out, "%s %llu to %llu", i ? "," : "", (unsigned long long)s->seeds[i].from,
            (unsigned long long)s->seeds[i].to);
  fprintf(out, "\n  %-24s %9s %10s %10s %10s %10s %10s %10s\n", "", "flights", "mean", "least", "5 %",
          "median", "95 %", "most");
  for (int i = 0; i < s->n_measure; i++) {
    const measure_t *const m = &s->measure[i];
    if (m->flights == 0) continue;
    fprintf(out, "  %-24s %9lld %10.4g %10.4g %10.4g %10.4g %10.4g %10.4g\n", m->name, (long long)m->flights,
            summary_mean(m), m->least, summary_quantile(m, 0.05), summary_quantile(m, 0.5),
            summary_quantile(m, 0.95), m->most);
  }
}

// --- reading ----------------------------------------------------------------------------------------------

// True if the item is a whole number from least to most; sets *value.
static bool whole(const cJSON *item, double least, double most, int64_t *value) {
  if (!cJSON_IsNumber(item)) return false;
  const double x = item->valuedouble;
  if (!(x >= least && x <= most && x == floor(x))) return false;
  *value = (int64_t)x;
  return true;
}

static bool count(const cJSON *o, const char *key, int64_t *value) {
  return whole(cJSON_GetObjectItemCaseSensitive(o, key), 0.0, WHOLE_MOST, value);
}

static bool two(const cJSON *pair, double least, double most, int64_t value[2]) {
  return cJSON_GetArraySize(pair) == 2 && whole(cJSON_GetArrayItem(pair, 0), least, most, &value[0]) &&
         whole(cJSON_GetArrayItem(pair, 1), 0.0, WHOLE_MOST, &value[1]);
}

static bool take_sum(const cJSON *item, int64_t *sum) {
  if (!cJSON_IsString(item)) return false;
  char *end;
  errno = 0;
  *sum = strtoll(item->valuestring, &end, 10);
  return end != item->valuestring && *end == '\0' && errno == 0 &&
         !isspace((unsigned char)item->valuestring[0]);
}

// The sum must lie between `flights` times the least and the most, each number rounded to a step.
static bool adds_up(const measure_t *m) {
  const double of = (double)m->flights, room = 0.5 * of + 1.0;
  return m->least <= m->most && fabs(m->least) <= SUMMARY_LIMIT && fabs(m->most) <= SUMMARY_LIMIT &&
         (double)m->sum >= of * m->least / SUMMARY_STEP - room &&
         (double)m->sum <= of * m->most / SUMMARY_STEP + room;
}

static bool take_measure(const cJSON *o, int64_t flights, measure_t *m) {
  const cJSON *const name = cJSON_GetObjectItemCaseSensitive(o, "name"), *pair;
  *m = (measure_t){.least = HUGE_VAL, .most = -HUGE_VAL};
  if (!cJSON_IsString(name) || strlen(name->valuestring) >= sizeof m->name) return false;
  strcpy(m->name, name->valuestring);
  if (!count(o, "flights", &m->flights) || m->flights > flights) return false;
  if (!take_sum(cJSON_GetObjectItemCaseSensitive(o, "sum"), &m->sum)) return false;
  int64_t binned = 0, before = -SUMMARY_SIDE - 1, at[2];
  cJSON_ArrayForEach(pair, cJSON_GetObjectItemCaseSensitive(o, "bins")) {
    if (!two(pair, -SUMMARY_SIDE, SUMMARY_SIDE, at) || at[0] <= before || at[1] < 1 || at[1] > flights)
      return false;
    m->in[SUMMARY_SIDE + at[0]] = at[1];
    binned += at[1];
    before = at[0];
  }
  if (binned != m->flights || m->flights == 0) return binned == m->flights;
  const cJSON *const least = cJSON_GetObjectItemCaseSensitive(o, "least"),
                     *const most = cJSON_GetObjectItemCaseSensitive(o, "most");
  if (!cJSON_IsNumber(least) || !cJSON_IsNumber(most)) return false;
  m->least = least->valuedouble;
  m->most = most->valuedouble;
  return adds_up(m);
}

static bool take_measures(const cJSON *o, summary_t *s) {
  const cJSON *const all = cJSON_GetObjectItemCaseSensitive(o, "measures"), *row;
  s->measure = calloc((size_t)cJSON_GetArraySize(all) + 1, sizeof *s->measure);
  if (!cJSON_IsArray(all) || !s->measure) return false;
  cJSON_ArrayForEach(row, all) {
    measure_t *const m = &s->measure[s->n_measure];
    if (!take_measure(row, s->flights, m)) return false;
    if (s->n_measure > 0 && strcmp(m[-1].name, m->name) >= 0) return false;
    s->n_measure++;
  }
  return true;
}

static bool take_seeds(const cJSON *o, summary_t *s) {
  const cJSON *const all = cJSON_GetObjectItemCaseSensitive(o, "seeds"), *row;
  int64_t flights = 0, at[2];
  s->seeds = calloc((size_t)cJSON_GetArraySize(all) + 1, sizeof *s->seeds);
  if (!cJSON_IsArray(all) || !s->seeds) return false;
  cJSON_ArrayForEach(row, all) {
    if (!two(row, 0.0, WHOLE_MOST, at) || at[0] > at[1]) return false;
    const seeds_t seeds = {(uint64_t)at[0], (uint64_t)at[1]};
    if (s->n_seeds > 0 && s->seeds[s->n_seeds - 1].to + 1 >= seeds.from) return false;
    s->seeds[s->n_seeds++] = seeds;
    flights += at[1] - at[0] + 1;
  }
  return flights == s->flights;
}

static bool take_all(const cJSON *o, summary_t *s) {
  return count(o, "flights", &s->flights) && count(o, "touched", &s->touched) &&
         count(o, "not_finite", &s->not_finite) && s->touched <= s->flights && s->not_finite <= s->flights &&
         take_seeds(o, s) && take_measures(o, s);
}

done_t summary_read(summary_t *s, const char *line, why_t *why) {
  cJSON *const o = cJSON_ParseWithOpts(line, NULL, true); // nothing may follow
  const cJSON *const cell = cJSON_GetObjectItemCaseSensitive(o, "cell"), *const by =
                                                                             cJSON_GetObjectItemCaseSensitive(
                                                                                 o, "by");
  int64_t form;
  done_t status = DONE;
  *s = (summary_t){0};
  if (!count(o, "fly_summary", &form) || form != 1 || !cJSON_IsString(cell) || !cJSON_IsString(by))
    status = error_set(why, "no summary; allowed is what fly --summary wrote");
  if (status == DONE) status = summary_make(s, cell->valuestring, by->valuestring, why);
  if (status == DONE && !take_all(o, s))
    status = error_set(why, "a summary that does not add up; allowed is what fly --summary wrote");
  cJSON_Delete(o);
  return status;
}

// --- files ------------------------------------------------------------------------------------------------

static done_t gather_one(summary_t *all, int *n, const char *line, why_t *why) {
  summary_t one;
  done_t status = summary_read(&one, line, why);
  int at = 0;
  while (status == DONE && at < *n && strcmp(all[at].cell, one.cell) != 0) at++;
  if (status == DONE && at < *n) {
    status = summary_join(&all[at], &one, why);
  } else if (status == DONE && *n < SUMMARY_CELLS_MAX) {
    all[(*n)++] = one;
    return DONE;
  } else if (status == DONE) {
    status = error_set(why, "more than %d cells", SUMMARY_CELLS_MAX);
  }
  summary_free(&one);
  return status;
}

static int by_cell(const void *a, const void *b) {
  return strcmp(((const summary_t *)a)->cell, ((const summary_t *)b)->cell);
}

done_t summary_gather(summary_t *all, int *n, const char *path, why_t *why) {
  FILE *file;
  char *line = NULL;
  size_t room = 0;
  TRY(stream_open(&file, path, why));
  done_t status = DONE;
  int number = 0;
  for (ssize_t length; status == DONE && (length = getline(&line, &room, file)) >= 0;) {
    why_t own;
    number++;
    status = strlen(line) == (size_t)length ? gather_one(all, n, line, &own)
                                            : error_set(&own, "no text; allowed is what fly --summary wrote");
    if (status == BAD_INPUT) error_set(why, "%s:%d: %.400s", path, number, own.text);
    if (status == FAILED) *why = own;
  }
  if (status == DONE && number == 0)
    status = error_set(why, "%s: empty; allowed is what fly --summary wrote", path);
  qsort(all, (size_t)*n, sizeof *all, by_cell);
  free(line);
  fclose(file);
  return status;
}
