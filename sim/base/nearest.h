// nearest.h - did you mean: of the names that are allowed, the one that is nearest to what was typed.
//
// Near is the fewest letters left out, added, changed or exchanged with the next one (the restricted
// Damerau-Levenshtein distance); small and large letters are alike. One such slip in three letters may be
// meant; with more, it is another word.
#ifndef SIM_BASE_NEAREST_H
#define SIM_BASE_NEAREST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NEAREST_LETTERS 40 // of a name; longer ones are never near
#define NEAREST_HINT    80

typedef struct {
  const char *typed, *name; // null: none is near
  int slips;
} nearest_t;

nearest_t nearest_to(const char *typed);

// One name that is allowed; it must live as long as the answer is used. The first of several as near wins.
void nearest_try(nearest_t *n, const char *name);

// For a message, behind what was typed: " (did you mean ceiling?)"; empty: none is near. Returns hint.
const char *nearest_hint(const nearest_t *n, char hint[NEAREST_HINT]);

// The same of a list that ends with a null pointer.
const char *nearest_of(const char *typed, const char *const *names, char hint[NEAREST_HINT]);

// Slips between two words.
int nearest_slips(const char *a, const char *b);

#ifdef __cplusplus
}
#endif

#endif
