// many.c - many flights of one scenario, one line each.
#include "flight/many.h"

#include "base/lane.h"
#include "flight/together.h"
#include <math.h>
#include <stdlib.h>
#ifdef _OPENMP
#include <omp.h>
#endif

typedef struct {
  done_t status;
  why_t why;
  char text[160];
  char *json;    // null: not asked for
  cJSON *result; // likewise
  bool finite;
} line_t;

static double of(const cJSON *o, const char *key) {
  const cJSON *item = cJSON_GetObjectItem(o, key);
  return cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
}

// Adds the extremes over the flight's segments to its JSON, and writes its line of text.
static void sum_up(cJSON *json, uint64_t seed, line_t *line) {
  double gap_mm = (double)NAN, tilt_deg = (double)NAN;
  const cJSON *s;
  cJSON_ArrayForEach(s, cJSON_GetObjectItem(json, "segments")) {
    gap_mm = fmin(gap_mm, of(s, "min_gap_mm"));
    tilt_deg = fmax(tilt_deg, of(s, "tilt_max_deg"));
  }
  cJSON_DeleteItemFromObject(json, "realtime_factor");
  cJSON_AddNumberToObject(json, "seed", (double)seed);
  cJSON_AddNumberToObject(json, "min_gap_mm", gap_mm);
  if (isfinite(tilt_deg)) cJSON_AddNumberToObject(json, "tilt_max_deg", tilt_deg);
  line->finite = cJSON_IsTrue(cJSON_GetObjectItem(json, "finite"));
  const int used = snprintf(line->text, sizeof line->text, "seed %llu contacts %.0f gap_mm %.2f",
                            (unsigned long long)seed, of(json, "contacts"), gap_mm);
  char tilt[40] = "";
  if (isfinite(tilt_deg)) snprintf(tilt, sizeof tilt, " tilt_deg %.2f", tilt_deg);
  snprintf(line->text + used, sizeof line->text - (size_t)used, "%s %s", tilt,
           line->finite ? "finite" : "not-finite");
}

// Adds the command that flies this flight alone, however the work was divided.
static void add_made(const many_t *m, const result_t *result, uint64_t seed) {
  char number[24];
  made_t made = *m->made;
  made.command = NULL;
  snprintf(number, sizeof number, "%llu", (unsigned long long)seed);
  made_words(&made, m->made->command);
  made_word(&made, "--seed");
  made_word(&made, number);
  made_add(result->json, &made, (double)seed, result->record.n);
  made_free(&made);
}

static line_t fly(const many_t *m, uint64_t seed) {
  line_t line = {.status = DONE};
  request_t request = *m->request;
  request.seed = seed;
  result_t result;
  line.status = result_init(&result, &line.why);
  if (line.status != DONE) return line;
  line.status = m->scenario->run(&request, &result, &line.why);
  if (line.status == DONE) sum_up(result.json, seed, &line);
  if (line.status == DONE && m->json) {
    add_made(m, &result, seed);
    line.json = cJSON_PrintUnformatted(result.json);
    if (!line.json) line.status = error_failed(&line.why, "out of memory");
  }
  if (m->summary) {
    line.result = result.json;
    result.json = NULL;
  }
  result_free(&result);
  return line;
}

static done_t take(const many_t *m, const line_t *line, uint64_t done, why_t *why) {
  if (m->text) fprintf(m->text, "%s\n", line->text);
  if (line->json) fprintf(m->json, "%s\n", line->json);
  *m->not_finite += !line->finite;
  if (m->progress)
    fprintf(stderr, "\r%llu of %llu flights", (unsigned long long)done,
            (unsigned long long)(m->to - m->from + 1));
  return m->summary ? summary_add(m->summary, m->from + done - 1, line->result, why) : DONE;
}

// Returns how many flights are flown side by side: few enough that every processor gets some.
static int side_by_side(long n) {
#ifdef _OPENMP
  const long each = (n + omp_get_max_threads() - 1) / omp_get_max_threads();
#else
  const long each = n;
#endif
  return each < TOGETHER_FEWEST ? 1 : each < LANES ? (int)each : LANES;
}

typedef struct {
  const many_t *m;
  uint64_t from;
  line_t line[LANES];
} group_t;

static void fly_one(void *self, int i) {
  group_t *const g = self;
  g->line[i] = fly(g->m, g->from + (uint64_t)i);
}

// Nothing is written from the first failure on, in the order of the seeds.
done_t many_fly(const many_t *m, why_t *why) {
  const long n = (long)(m->to - m->from) + 1;
  done_t status = DONE; // changed only in the ordered part, as is the count
  const int side = side_by_side(n);
  *m->not_finite = 0;
#pragma omp parallel for ordered schedule(dynamic, 1)
  for (long first = 0; first < n; first += side) {
    const int of = (int)(n - first < side ? n - first : side);
    group_t g = {.m = m, .from = m->from + (uint64_t)first};
    (void)together(of, fly_one, &g);
#pragma omp ordered
    for (int i = 0; i < of; i++) {
      line_t *const line = &g.line[i];
      if (status == DONE && line->status == DONE) {
        status = take(m, line, (uint64_t)(first + i) + 1, why);
      } else if (status == DONE) {
        status = line->status;
        *why = line->why;
      }
      free(line->json);
      cJSON_Delete(line->result);
    }
  }
  if (m->progress) fputc('\n', stderr);
  return status;
}
