// made.h - how a file was made: program, version, command line, date. It stands in every JSON, page and
// model.
#ifndef SIM_BASE_MADE_H
#define SIM_BASE_MADE_H

#include <cjson/cJSON.h>
#include <stdio.h>

typedef struct {
  char by[80];   // "fly 0.9.0 (commit 1fe0254f2d1c)"
  char date[24]; // UTC, as 2026-01-31T12:00:00Z; of SOURCE_DATE_EPOCH if that is set
  char *command; // as one would type it; null: no memory
} made_t;

// By this program, now. Take it before getopt_long, which moves words. Free it.
made_t made_by(const char *program, int argc, char *const *argv);
void made_free(made_t *m);

// One more word at the command's end, quoted where a shell needs it.
void made_word(made_t *m, const char *word);

// --name, and its value unless that is null.
void made_option(made_t *m, const char *name, const char *value);

// Words that are quoted already.
void made_words(made_t *m, const char *words);

// Adds "made": {"by", "command", "date", "seed", "rows"}. seed, rows: NaN where there is none; null then.
void made_add(cJSON *json, const made_t *m, double seed, double rows);

// `# made by fly 0.9.0 (commit 1fe0254f2d1c) at 2026-01-31T12:00:00Z` and `# command`: two lines of comment,
// in letters that any file takes.
void made_comment(const made_t *m, FILE *out);

// The command alone, on one line, in such letters.
void made_line(const made_t *m, FILE *out);

// --version.
void made_version(const char *program);

#endif
