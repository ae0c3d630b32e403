// toml.h - TOML files behind a few C calls (parser: toml++).
//
// Every error is one line, `FILE:LINE: key: what; what is allowed`.
// A table is passed by value and is good until toml_close. A getter fails where the key is missing: ask
// toml_has first for what may be left out.
#ifndef SIM_BASE_TOML_H
#define SIM_BASE_TOML_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct toml_file toml_file_t;

typedef struct {
  const toml_file_t *file;
  const void *table;
} toml_t;

// What the file is to be, for the message where it is no TOML at all.
typedef struct {
  const char *what, *example; // "a vehicle file", "sim/vehicle/vehicles/cf21_legacy.toml"
  const char *const *keys;    // of its root; ends with a null pointer
} toml_kind_t;

// BAD_INPUT: no such file, a folder, not TOML (with line and column); *file is null then.
MUST_CHECK done_t toml_open(toml_file_t **file, const char *path, const toml_kind_t *kind, why_t *why);

// The same from a text in memory; `path` is what errors call it.
MUST_CHECK done_t toml_open_text(toml_file_t **file, const char *path, const char *text,
                                 const toml_kind_t *kind, why_t *why);

// A null pointer is allowed.
void toml_close(toml_file_t *file);

toml_t toml_root(const toml_file_t *file);

bool toml_has(toml_t t, const char *key);

// BAD_INPUT: the key is missing or of another type; for the numbers also out of min..max, and not finite.
// Nothing is written to the result then. A whole number is accepted as a double.
MUST_CHECK done_t toml_string(toml_t t, const char *key, char *text, size_t size, why_t *why);
MUST_CHECK done_t toml_double(toml_t t, const char *key, double min, double max, double *value, why_t *why);
MUST_CHECK done_t toml_bool(toml_t t, const char *key, bool *value, why_t *why);
MUST_CHECK done_t toml_doubles(toml_t t, const char *key, int n_max, double *values, int *n, why_t *why);
MUST_CHECK done_t toml_table(toml_t t, const char *key, toml_t *sub, why_t *why);

// Number i of an array of tables `[[key]]`; *more is false where there is none of that number (also without
// the key).
MUST_CHECK done_t toml_table_at(toml_t t, const char *key, int i, toml_t *sub, bool *more, why_t *why);

// The key number i of a table, in no particular order; a null pointer beyond the last.
const char *toml_key(toml_t t, int i);

// For a message about an unknown key of a table that is one of the root's, and stands behind that table's
// head: " (a key of the file itself stands before the first [table])"; else empty.
const char *toml_astray(toml_t t, const char *key);

// BAD_INPUT: the table has a key that is not in `allowed`, which ends with a null pointer.
MUST_CHECK done_t toml_only(toml_t t, const char *const *allowed, why_t *why);

// An error about a key (or, where it is missing or null, about its table). Returns BAD_INPUT.
done_t toml_refuse(toml_t t, const char *key, why_t *why, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#ifdef __cplusplus
}
#endif

#endif
