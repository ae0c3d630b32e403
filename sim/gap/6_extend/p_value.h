// p_value.h - a p value as all outputs give it: none is told below 1e-16.
#ifndef SIM_GAP_6_EXTEND_P_VALUE_H
#define SIM_GAP_6_EXTEND_P_VALUE_H

#include <math.h>
#include <stdio.h>

#define P_LEAST 1e-16
#define P_TEXT  24

static inline double p_value(double p) {
  return fmax(p, P_LEAST);
}

// Returns "p 0.003", or "p < 1e-16" for what is smaller, in text.
static inline const char *p_words(double p, char text[P_TEXT]) {
  if (p < P_LEAST)
    snprintf(text, P_TEXT, "p < %.0e", P_LEAST);
  else
    snprintf(text, P_TEXT, "p %.1g", p);
  return text;
}

#endif
