// error.h - one line for a person: what is wrong, where, and what is allowed.
//
// Host calls that can fail on what a person wrote return status_t and fill an why_t, the last argument.
// main prints it as `program: text` and exits with 2.
#ifndef SIM_ERROR_H
#define SIM_ERROR_H

#include "flight/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  char text[512]; // one line without the newline: "flight.csv:812: column pwm1: not a number: `x`"
} why_t;

// Writes the line (cut to fit) and returns ST_BAD_INPUT, so that `return error_set(why, ...)` is all it
// takes.
status_t error_set(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

#ifdef __cplusplus
}
#endif

#endif
