// extend.h - the vehicle file with what was named: DIR/model.toml, which `fly --vehicle` accepts.
//
// The vehicle file's own text is kept, with its comments. It gets one [[effect]] for each name, in place of
// the one of that name that it may have, with each number's standard error and source. A lag or delay too
// short for a name (select.h) is in the model without one; it belongs to the log and stays out.
#ifndef SIM_GAP_6_EXTEND_EXTEND_H
#define SIM_GAP_6_EXTEND_EXTEND_H

#include "base/made.h"
#include "gap/5_infer/found.h"
#include <stdio.h>

typedef struct {
  const char *path, *text; // of the vehicle file
  const model_t *model;    // what the file says
  const found_t *found;
  const char *logs;   // the logs in which it was found, in words
  const made_t *made; // how it was made; null: not said
} extend_job_t;

// Writes the file to a stream, which knows whether that went well. BAD_INPUT: with the named effects the text
// is no vehicle file any more (an effect list that cannot be added to); says so. FAILED: no memory.
MUST_CHECK done_t extend_write(const extend_job_t *job, FILE *out, why_t *why);

#endif
