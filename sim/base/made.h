// made.h - how a file was made: program, version, command line, date. Every JSON, page and model says it.
#ifndef SIM_BASE_MADE_H
#define SIM_BASE_MADE_H

#include <cjson/cJSON.h>
#include <stdio.h>

typedef struct {
  char by[80];   // "fly 0.9.0 (commit 1fe0254f2d1c)"
  char date[24]; // UTC, as 2026-01-31T12:00:00Z; from SOURCE_DATE_EPOCH if that is set
  char *command; // as one would type it; null if there was no memory
} made_t;

// Made by this program, now. Call it before getopt_long, which reorders argv. Free the result.
made_t made_by(const char *program, int argc, char *const *argv);
void made_free(made_t *m);

// Appends one word to the command, quoted where a shell needs it.
void made_word(made_t *m, const char *word);

// Appends --name, and its value unless that is null.
void made_option(made_t *m, const char *name, const char *value);

// Appends words that are already quoted.
void made_words(made_t *m, const char *words);

// Adds "made": {"by", "command", "date", "seed", "rows"}. seed, rows: NaN if there is none, written as null.
void made_add(cJSON *json, const made_t *m, double seed, double rows);

// Writes two comment lines in printable ASCII: `# command` after
// `# made by fly 0.9.0 (commit 1fe0254f2d1c) at 2026-01-31T12:00:00Z`.
void made_comment(const made_t *m, FILE *out);

// Writes the command alone, on one line, in printable ASCII.
void made_line(const made_t *m, FILE *out);

// Prints program and version, for --version.
void made_version(const char *program);

#endif
