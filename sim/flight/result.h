// result.h - what a scenario found: segments, totals, and tables of its own; as JSON and as text.
#ifndef SIM_FLIGHT_RESULT_H
#define SIM_FLIGHT_RESULT_H

#include "flight/setup.h"
#include <cjson/cJSON.h>
#include <stdio.h>

typedef struct {
  // "segments": [...], "contacts", "finite", "realtime_factor", and what a scenario adds; "set": {...}, the
  // parameters that the flight code flew with and that differ from what ships, as --set takes them; "drawn":
  // {...}, this flight's random deviations (flight/drawn.h), if there are any
  cJSON *json;
  record_t record; // of the flight that --log writes
} result_t;

// Makes an empty result. FAILED: no memory.
MUST_CHECK done_t result_init(result_t *r, why_t *why);
void result_free(result_t *r);

// Adds the flight's segments, contacts and finiteness; in six degrees of freedom each segment also has
// "tilt_max_deg". Keeps the record of the last flight added (the flown's record is taken over).
void result_add_flight(result_t *r, flown_t *flown);

// Adds a table "learned" with the weights, as parameters to type in, and the array "weights".
void result_add_weights(result_t *r, const rbf_weights_t *weights);

// Adds one segment alone with its contacts, and the flight's other totals: for scenarios of many flights with
// one interesting segment each.
void result_add_segment(result_t *r, flown_t *flown, int segment, const char *label);

// Adds a row to a table, which is created when new, and returns it. Fill it with cJSON_AddNumberToObject.
cJSON *result_add_row(result_t *r, const char *table);

// Prints "set", every table as aligned text, and the totals if anything was flown.
void result_print(const cJSON *json, FILE *out);

// Writes the JSON. FAILED: no memory for the text. A failure of the file shows in the stream (ferror).
MUST_CHECK done_t result_write(const cJSON *json, FILE *file, why_t *why);

// Joins the results of one scenario with n seeds. "segments" becomes the mean over the flights (null where
// one is null; contacts are the sum, the smallest gap the smallest, the largest tilt the largest), "contacts"
// the sum, "finite" false where one is not, "realtime_factor" the mean. "flights" holds each flight's own
// result with its seed. What a scenario adds is only there, because it is not known here which numbers of a
// table may be averaged. A null pointer: no memory.
cJSON *result_over_seeds(cJSON *const *json, int n, uint64_t first_seed);

#endif
