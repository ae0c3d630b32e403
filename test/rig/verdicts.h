// verdicts.h - reads and checks verdict.json in tests.
#ifndef TEST_RIG_VERDICTS_H
#define TEST_RIG_VERDICTS_H

#include <cjson/cJSON.h>

// From the scratch folder; null: not JSON. cJSON_Delete it.
cJSON *verdict_read(const char *name);

// "" or NaN if the key is missing or of another type.
const char *verdict_string(const cJSON *object, const char *key);
double verdict_number(const cJSON *object, const char *key);

// The channel's entry in the list `gap`; null: none.
const cJSON *verdict_gap(const cJSON *verdict, const char *channel);

// Checks that every key of the specification is there, of its type, and no other.
void verdict_check(const cJSON *verdict);

#endif
