// nearest.h - suggests, among the allowed names, the one nearest to what was typed.
//
// The distance counts letters left out, added, changed or swapped with the next one (the restricted
// Damerau-Levenshtein distance); upper and lower case are alike. A name is suggested if there is at most one
// such slip per three letters.
#ifndef SIM_BASE_NEAREST_H
#define SIM_BASE_NEAREST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NEAREST_LETTERS 40 // longest name; longer ones are never suggested
#define NEAREST_HINT    80

typedef struct {
  const char *typed, *name; // name: null if none is near
  int slips;
} nearest_t;

nearest_t nearest_to(const char *typed);

// Offers one allowed name, which must outlive the use of the result. Of equally near names the first wins.
void nearest_try(nearest_t *n, const char *name);

// Writes " (did you mean ceiling?)" for a message, after what was typed; empty if none is near. Returns hint.
const char *nearest_hint(const nearest_t *n, char hint[NEAREST_HINT]);

// The same for a list of names that ends with a null pointer.
const char *nearest_of(const char *typed, const char *const *names, char hint[NEAREST_HINT]);

// The number of slips between two words.
int nearest_slips(const char *a, const char *b);

#ifdef __cplusplus
}
#endif

#endif
