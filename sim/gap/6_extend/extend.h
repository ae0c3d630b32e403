// extend.h - the vehicle file with what was named: DIR/model.toml, which `fly --vehicle` accepts.
//
// The vehicle file's own text is kept, with its comments, and gets one [[effect]] for each name, in place of
// one that it has of that name; each number with its standard error and where it comes from. What is in the
// model without a name (a lag or delay too short for it, see select.h) belongs to the log and stays out.
#ifndef SIM_GAP_6_EXTEND_EXTEND_H
#define SIM_GAP_6_EXTEND_EXTEND_H

#include "base/made.h"
#include "gap/5_infer/found.h"
#include <stdio.h>

typedef struct {
  const char *path, *text; // of the vehicle file
  const model_t *model;    // what it says
  const found_t *found;
  const char *logs;   // what it was found in, in words
  const made_t *made; // how; null: not said
} extend_job_t;

// BAD_INPUT: with the named effects the text is no vehicle file any more (an effect list that cannot be
// added to); says so. FAILED: no memory. If the file took it, the stream knows.
MUST_CHECK done_t extend_write(const extend_job_t *job, FILE *out, why_t *why);

#endif
