// toml.h - TOML files behind a few C calls (parser: toml++).
//
// Every error is one line, `FILE:LINE: key: what is wrong; what is allowed`. A table is passed by value and
// stays valid until toml_close. Getters fail if the key is missing: call toml_has first for optional keys.
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

// What kind of file is expected, for the message if it is not TOML at all.
typedef struct {
  const char *what, *example; // "a vehicle file", "sim/vehicle/vehicles/cf21_legacy.toml"
  const char *const *keys;    // allowed at its root; ends with a null pointer
} toml_kind_t;

// BAD_INPUT: there is no such file, it is a folder or not TOML (with line and column); *file is null then.
MUST_CHECK done_t toml_open(toml_file_t **file, const char *path, const toml_kind_t *kind, why_t *why);

// The same from text in memory; errors call it `path`.
MUST_CHECK done_t toml_open_text(toml_file_t **file, const char *path, const char *text,
                                 const toml_kind_t *kind, why_t *why);

// A null pointer is allowed.
void toml_close(toml_file_t *file);

toml_t toml_root(const toml_file_t *file);

bool toml_has(toml_t t, const char *key);

// BAD_INPUT: the key is missing or has another type, a text is too long, or a number is out of min..max or
// not finite. The result is then unchanged. A whole number is accepted as a double.
MUST_CHECK done_t toml_string(toml_t t, const char *key, char *text, size_t size, why_t *why);
MUST_CHECK done_t toml_double(toml_t t, const char *key, double min, double max, double *value, why_t *why);
MUST_CHECK done_t toml_bool(toml_t t, const char *key, bool *value, why_t *why);
MUST_CHECK done_t toml_doubles(toml_t t, const char *key, int n_max, double *values, int *n, why_t *why);
MUST_CHECK done_t toml_table(toml_t t, const char *key, toml_t *sub, why_t *why);

// Table number i of an array of tables `[[key]]`; *more is false beyond the last, or without the key.
MUST_CHECK done_t toml_table_at(toml_t t, const char *key, int i, toml_t *sub, bool *more, why_t *why);

// Key number i of a table, in no particular order; a null pointer beyond the last.
const char *toml_key(toml_t t, int i);

// Text for a message about an unknown key of a table, if it is a key of the root that was written after that
// table's head: " (a key of the file itself stands before the first [table])"; else empty.
const char *toml_astray(toml_t t, const char *key);

// BAD_INPUT: the table has a key that is not in `allowed`, which ends with a null pointer.
MUST_CHECK done_t toml_only(toml_t t, const char *const *allowed, why_t *why);

// Reports an error about a key (or, if it is missing or null, about its table). Returns BAD_INPUT.
done_t toml_refuse(toml_t t, const char *key, why_t *why, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#ifdef __cplusplus
}
#endif

#endif
