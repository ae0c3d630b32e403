// truth.h - what an exam hides: effects in forms and sizes of the exam's own, and effects that no library
// has.
#ifndef TEST_EXAM_TRUTH_H
#define TEST_EXAM_TRUTH_H

#include "vehicle/model.h"

#define TRUTH_EFFECTS 19 // of the library, with a typical size
#define TRUTH_STRANGE 6  // outside the library

// Effect number i at `times` its typical size; which: what is left to chance (a direction, a rotor).
// own_form: in a form that sim/effects has not, where there is one; else that of sim/effects.
fx_use_t truth_effect(int i, double times, double which, bool own_form);
const char *truth_name(int i);
// What the exam calls typical of an effect, over what the library does.
double truth_typical(const char *name);

// An effect that no library has, and what the right answer is: channels (bits of 1 << CH_*) and coordinate.
typedef struct {
  const char *what, *coordinate; // "": any
  unsigned channels;
} strange_t;

fx_use_t truth_strange(int i, double times, strange_t *answer);

#endif
