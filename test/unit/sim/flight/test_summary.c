// test_summary.c - summaries of many flights: they join to the byte, and their quantiles are near.
#include "base/by_size.h"
#include "base/random.h"
#include "flight/summary.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FLIGHTS        400
#define LINE_MAX_BYTES 200000

// Of seed n: numbers of every size and either sign, some of them missing; every tenth flight touches.
static cJSON *result_of(uint64_t seed) {
  cJSON *const o = cJSON_CreateObject(), *const segments = cJSON_AddArrayToObject(o, "segments");
  random_t *const r = random_open(seed);
  for (int i = 0; i < 3; i++) {
    cJSON *const row = cJSON_CreateObject();
    const double x = random_normal(r);
    cJSON_AddStringToObject(row, "label", "hover");
    cJSON_AddNumberToObject(row, "rms_mm", exp(3.0 * x));
    cJSON_AddNumberToObject(row, "mean_error_mm", x * x * x);
    cJSON_AddNumberToObject(row, "t90_s", x > 0.0 ? x : (double)NAN);
    cJSON_AddNumberToObject(row, "overshoot_mm", seed % 50 == 0 ? 1e9 : 1e-9);
    cJSON_AddItemToArray(segments, row);
  }
  cJSON_AddNumberToObject(o, "contacts", seed % 10 == 0 ? 2.0 : 0.0);
  cJSON_AddBoolToObject(o, "finite", seed % 100 != 0);
  random_close(r);
  return o;
}

static void add_flights(summary_t *s, uint64_t from, uint64_t to) {
  why_t why;
  for (uint64_t seed = from; seed <= to; seed++) {
    cJSON *const result = result_of(seed);
    CHECK_OK(summary_add(s, seed, result, &why));
    cJSON_Delete(result);
  }
}

// Free it.
static char *line_of(const summary_t *s) {
  why_t why;
  FILE *const file = tmpfile();
  char *const text = calloc(1, LINE_MAX_BYTES);
  CHECK(file && text);
  if (file && text) {
    CHECK_OK(summary_write(s, file, &why));
    rewind(file);
    CHECK(fread(text, 1, LINE_MAX_BYTES - 1, file) < LINE_MAX_BYTES - 1);
  }
  if (file) fclose(file);
  return text;
}

static void open_summary(summary_t *s, uint64_t from, uint64_t to) {
  why_t why;
  CHECK_OK(summary_make(s, "fly hover", "fly 1", &why));
  add_flights(s, from, to);
}

TEST(summary_of_parts_is_that_of_the_whole_to_the_byte) {
  static const uint64_t cut[][4][2] = {{{1, 400}},
                                       {{1, 200}, {201, 400}},
                                       {{201, 400}, {1, 200}},
                                       {{1, 1}, {400, 400}, {200, 399}, {2, 199}},
                                       {{101, 200}, {301, 400}, {1, 100}, {201, 300}}};
  summary_t whole;
  open_summary(&whole, 1, FLIGHTS);
  char *const want = line_of(&whole);
  for (unsigned i = 0; i < sizeof cut / sizeof *cut; i++) {
    ROW("cut %u", i);
    summary_t all;
    why_t why;
    CHECK_OK(summary_make(&all, "fly hover", "fly 1", &why));
    for (int k = 0; k < 4 && cut[i][k][0] > 0; k++) {
      summary_t part, read;
      open_summary(&part, cut[i][k][0], cut[i][k][1]);
      char *const line = line_of(&part);
      CHECK_OK(summary_read(&read, line, &why));
      CHECK_OK(summary_join(&all, &read, &why));
      free(line);
      summary_free(&part);
      summary_free(&read);
    }
    char *const got = line_of(&all);
    CHECK(got && want && strcmp(got, want) == 0);
    free(got);
    summary_free(&all);
  }
  CHECK(whole.n_seeds == 1 && whole.flights == FLIGHTS && whole.touched == 40 && whole.not_finite == 4);
  free(want);
  summary_free(&whole);
}

TEST(summary_tells_quantiles_to_a_bins_half_and_the_mean_as_it_is) {
  static const char *const key[] = {"rms_mm", "mean_error_mm", "t90_s"};
  summary_t s;
  open_summary(&s, 1, FLIGHTS);
  for (unsigned k = 0; k < sizeof key / sizeof *key; k++) {
    double x[FLIGHTS], sum = 0.0;
    char name[48];
    int n = 0, at = 0;
    for (uint64_t seed = 1; seed <= FLIGHTS; seed++) {
      cJSON *const result = result_of(seed);
      const cJSON *const row = cJSON_GetArrayItem(cJSON_GetObjectItem(result, "segments"), 1);
      const double value = cJSON_GetObjectItem(row, key[k])->valuedouble;
      if (!isnan(value)) sum += x[n++] = value;
      cJSON_Delete(result);
    }
    qsort(x, (size_t)n, sizeof *x, by_size);
    snprintf(name, sizeof name, "02.%s", key[k]);
    while (at < s.n_measure && strcmp(s.measure[at].name, name) != 0) at++;
    if (!CHECK(at < s.n_measure)) break;
    const measure_t *const m = &s.measure[at];
    CHECK(m->flights == n);
    CHECK_NEAR(summary_mean(m), sum / n, 1e-6);
    for (int percent = 0; percent <= 100; percent += 5) {
      const double share = percent / 100.0;
      const double exact = x[share > 0.0 ? (int)ceil(share * n) - 1 : 0];
      ROW("%s, %.2f", name, share);
      CHECK_NEAR(summary_quantile(m, share), exact, fabs(exact) / 63.0 + 0x1p-10);
    }
  }
  summary_free(&s);
}

TEST(summary_counts_no_flight_twice_and_joins_no_other_version) {
  static const struct {
    uint64_t from, to;
    const char *by, *says;
  } row[] = {{3, 4, "fly 1", "some are there twice"},
             {1, 1, "fly 1", "some are there twice"},
             {20, 30, "fly 1", "some are there twice"},
             {5, 7, "fly 2", "flown by fly 2, and by fly 1 elsewhere"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%u", i);
    summary_t s, more;
    why_t why = {""};
    open_summary(&s, 1, 4);
    add_flights(&s, 25, 25);
    char *const before = line_of(&s);
    CHECK_OK(summary_make(&more, "fly hover", row[i].by, &why));
    add_flights(&more, 8, 9);
    add_flights(&more, row[i].from, row[i].to);
    CHECK_STATUS(BAD_INPUT, summary_join(&s, &more, &why));
    CHECK(strstr(why.text, row[i].says) != NULL);
    char *const after = line_of(&s);
    CHECK(before && after && strcmp(before, after) == 0);
    free(before);
    free(after);
    summary_free(&s);
    summary_free(&more);
  }
}

// A line with one piece put in another's place. Free it.
static char *changed(const char *line, const char *from, const char *to) {
  const char *const found = strstr(line, from);
  const size_t room = strlen(line) + strlen(to) + 1;
  char *const new = malloc(room);
  CHECK(found && new);
  if (found && new) snprintf(new, room, "%.*s%s%s", (int)(found - line), line, to, found + strlen(from));
  return new;
}

TEST(summary_refuses_a_line_that_does_not_add_up) {
  static const struct {
    const char *from, *to, *says;
  } row[] = {
      {"\"fly_summary\":1", "\"fly_summary\":2", "no summary"},
      {"{\"fly", "[\"fly", "no summary"},
      {"\"cell\"", "\"hell\"", "no summary"},
      {"\"flights\":5", "\"flights\":6", "does not add up"},
      {"\"flights\":5", "\"flights\":-5", "does not add up"},
      {"\"touched\":0", "\"touched\":7", "does not add up"},
      {"\"seeds\":[[1,5]]", "\"seeds\":[[1,2],[3,5]]", "does not add up"},
      {"\"seeds\":[[1,5]]", "\"seeds\":[[5,1]]", "does not add up"},
      {"\"seeds\":[[1,5]]", "\"seeds\":[[1,4],[6,6.5]]", "does not add up"},
      {"\"name\":\"01.mean", "\"name\":\"09.mean", "does not add up"}, // not in their order
      {"\"sum\":\"", "\"sum\":\"x", "does not add up"},
      {"\"bins\":[[", "\"bins\":[[-99999,1],[", "does not add up"},
      {"\"least\":", "\"leest\":", "does not add up"},
      {"\"sum\":\"0\"", "\"sum\":\"99999999999999999999\"", "does not add up"},
      {"\"sum\":\"0\"", "\"sum\":\"5000\"", "does not add up"},
      {"\"least\":", "\"least\":-1e300,\"l\":", "does not add up"},
      {"\"most\":", "\"most\":1e999,\"m\":", "does not add up"},
      {"]}\n", "]}{\"fly_summary\":1}\n", "no summary"},
  };
  summary_t s;
  why_t why;
  open_summary(&s, 1, 5);
  char *const line = line_of(&s);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].to);
    summary_t read;
    char *const bad = changed(line, row[i].from, row[i].to);
    CHECK_STATUS(BAD_INPUT, summary_read(&read, bad, &why));
    CHECK(strstr(why.text, row[i].says) != NULL);
    summary_free(&read);
    free(bad);
  }
  free(line);
  summary_free(&s);
}

TEST(summary_file_keeps_cells_apart) {
  summary_t s[2], all[3] = {{0}};
  why_t why;
  int n = 0;
  open_summary(&s[0], 1, 5);
  CHECK_OK(summary_make(&s[1], "fly higher", "fly 2", &why));
  add_flights(&s[1], 1, 5);
  char *const first = line_of(&s[0]), *const second = line_of(&s[1]);
  char *const both = malloc(strlen(first) + strlen(second) + 1);
  sprintf(both, "%s%s", first, second);
  CHECK_OK(summary_gather(all, &n, scratch_file("cells", both, -1), &why));
  CHECK(n == 2 && all[0].flights == 5 && all[1].flights == 5);
  CHECK_STATUS(BAD_INPUT, summary_gather(all, &n, scratch_file("again", second, -1), &why));
  CHECK_TEXT(scratch_short(why.text),
             "again:1: fly higher: of the seeds 1 to 5 some are there twice; allowed: "
             "each flight once");
  CHECK_STATUS(BAD_INPUT, summary_gather(all, &n, scratch_file("none", "", -1), &why));
  CHECK_TEXT(scratch_short(why.text), "none: empty; allowed is what fly --summary wrote");
  for (int i = 0; i < 2; i++) summary_free(&s[i]), summary_free(&all[i]);
  free(both);
  free(first);
  free(second);
}

TEST(summary_takes_no_number_whose_name_it_cannot_hold) {
  summary_t s;
  why_t why;
  open_summary(&s, 1, 2);
  cJSON *const result = result_of(3);
  cJSON_AddNumberToObject(cJSON_GetArrayItem(cJSON_GetObjectItem(result, "segments"), 0),
                          "a_name_of_forty_five_letters_and_three_before", 1.0);
  CHECK_STATUS(FAILED, summary_add(&s, 3, result, &why));
  CHECK_TEXT(why.text, "a number's name is too long for a summary");
  cJSON_Delete(result);
  summary_free(&s);
}

TEST(summary_file_of_a_thousand_cells_is_the_largest) {
  static const char form[] = "{\"fly_summary\":1,\"cell\":\"fly %d\",\"by\":\"fly 1\",\"flights\":0,"
                             "\"touched\":0,\"not_finite\":0,\"seeds\":[],\"measures\":[]}\n";
  enum { LINE = 160, MOST = SUMMARY_CELLS_MAX };
  summary_t *const all = calloc(MOST, sizeof *all);
  char *const text = malloc((MOST + 1) * LINE);
  CHECK(all && text);
  if (!all || !text) return;
  why_t why;
  int n = 0, length = 0;
  for (int i = 0; i < MOST; i++) length += snprintf(text + length, LINE, form, i);
  CHECK_OK(summary_gather(all, &n, scratch_file("most", text, -1), &why));
  CHECK(n == MOST);
  snprintf(text + length, LINE, form, MOST);
  CHECK_STATUS(BAD_INPUT, summary_gather(all, &n, scratch_file("beyond", text, -1), &why));
  CHECK_TEXT(scratch_short(why.text), "beyond:1001: more than 1000 cells");
  for (int i = 0; i < n; i++) summary_free(&all[i]);
  free(all);
  free(text);
}
