// verdicts.c - reads and checks verdict.json.
#include "rig/verdicts.h"

#include "rig/scratch.h"
#include "rig/test.h"
#include <stdlib.h>
#include <string.h>

cJSON *verdict_read(const char *name) {
  char *const text = scratch_text(name);
  cJSON *const json = cJSON_Parse(text);
  free(text);
  return json;
}

const char *verdict_string(const cJSON *o, const char *key) {
  const cJSON *const s = cJSON_GetObjectItem(o, key);
  return cJSON_IsString(s) ? s->valuestring : "";
}

double verdict_number(const cJSON *o, const char *key) {
  const cJSON *const v = cJSON_GetObjectItem(o, key);
  return cJSON_IsNumber(v) ? v->valuedouble : (double)NAN;
}

static void check_effect(const cJSON *one) {
  const cJSON *const family = cJSON_GetObjectItem(one, "family"), *const rivals =
                                                                      cJSON_GetObjectItem(one, "rivals");
  CHECK(cJSON_GetArraySize(one) >= 13 && cJSON_GetArraySize(family) == 1 + cJSON_GetArraySize(rivals));
  CHECK_TEXT(cJSON_GetArrayItem(family, 0)->valuestring, verdict_string(one, "name"));
  CHECK((strcmp(verdict_string(one, "standing"), "ambiguous") == 0) || cJSON_GetArraySize(rivals) == 0);
  CHECK(verdict_string(one, "says")[0] && verdict_string(one, "law")[0]);
  const cJSON *const matters = cJSON_GetObjectItem(one, "matters");
  CHECK(cJSON_GetArraySize(matters) == 6 && verdict_string(matters, "channel")[0]);
  CHECK(verdict_number(matters, "to") > verdict_number(matters, "from"));
  CHECK(verdict_number(matters, "before") > verdict_number(matters, "after") &&
        verdict_number(matters, "after") > 0.0);
}

void verdict_check(const cJSON *v) {
  static const char *const keys[] = {
      "verdict",      "effects",    "unknown", "gap",     "resimulation", "adequacy", "already_in_model",
      "not_testable", "would_show", "to_do",   "refused", "warnings",     "made"};
  static const char *const lists[] = {"effects",    "gap",   "already_in_model", "not_testable",
                                      "would_show", "to_do", "warnings"};
  const int n_key = sizeof keys / sizeof *keys, n_list = sizeof lists / sizeof *lists;
  CHECK(cJSON_GetArraySize(v) == n_key);
  for (int i = 0; i < n_key; i++) {
    ROW("%s", keys[i]);
    CHECK(cJSON_HasObjectItem(v, keys[i]));
  }
  for (int i = 0; i < n_list; i++) CHECK(cJSON_IsArray(cJSON_GetObjectItem(v, lists[i])));
  const cJSON *one;
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "not_testable")) {
    CHECK(cJSON_GetArraySize(one) == 3 && verdict_string(one, "effect")[0] && verdict_string(one, "why")[0] &&
          verdict_string(one, "fly")[0]);
  }
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "would_show")) {
    CHECK(cJSON_GetArraySize(one) == 4 && verdict_number(one, "from") > 0.0);
  }
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "effects")) check_effect(one);
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "gap")) {
    CHECK(cJSON_GetArraySize(one) == 7 && verdict_string(one, "channel")[0] &&
          verdict_string(one, "unit")[0]);
    CHECK(verdict_number(one, "before") > 0.0 && verdict_number(one, "after") > 0.0 &&
          verdict_number(one, "floor") > 0.0);
    CHECK(cJSON_GetArraySize(cJSON_GetObjectItem(one, "held_out")) > 0);
  }
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "warnings")) CHECK(cJSON_IsString(one));
}

const cJSON *verdict_gap(const cJSON *v, const char *channel) {
  const cJSON *one;
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(v, "gap")) if (strcmp(verdict_string(one, "channel"),
                                                                    channel) == 0) return one;
  return NULL;
}
