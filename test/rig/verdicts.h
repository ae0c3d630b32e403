// verdicts.h - verdict.json as tests read it.
#ifndef TEST_RIG_VERDICTS_H
#define TEST_RIG_VERDICTS_H

#include <cjson/cJSON.h>

// Of the scratch folder; null: it is no JSON. cJSON_Delete it.
cJSON *verdict_read(const char *name);

// "" and NaN where it is not there, or of another type.
const char *verdict_string(const cJSON *object, const char *key);
double verdict_number(const cJSON *object, const char *key);

// Of the list `gap`; null: not there.
const cJSON *verdict_gap(const cJSON *verdict, const char *channel);

// Every key of the specification, of its type, and no other.
void verdict_check(const cJSON *verdict);

#endif
