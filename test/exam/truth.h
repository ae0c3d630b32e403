// truth.h - what an exam hides: effects in forms and sizes of the exam's own, and effects outside the
// library.
#ifndef TEST_EXAM_TRUTH_H
#define TEST_EXAM_TRUTH_H

#include "vehicle/model.h"

#define TRUTH_EFFECTS 19 // of the library, with a typical size
#define TRUTH_STRANGE 6  // outside the library

// Returns effect number i at `times` its typical size. which (0..1) chooses a direction, rotor or sign.
// own_form: in a form that sim/effects does not have, if there is one; else in that of sim/effects.
fx_use_t truth_effect(int i, double times, double which, bool own_form);
const char *truth_name(int i);
// Returns the exam's typical size of an effect over the library's.
double truth_typical(const char *name);

// An effect outside the library. The right answer: channels (bits of 1 << CH_*) and coordinate.
typedef struct {
  const char *what, *coordinate; // "": any
  unsigned channels;
} strange_t;

fx_use_t truth_strange(int i, double times, strange_t *answer);

#endif
