// error.h - one line for a person: what is wrong, where, and what is allowed.
//
// Host calls that can fail return status_t and fill an why_t, the last argument. main ends with
// `return error_exit("program", status, &why)`, which prints it as `program: text`.
#ifndef SIM_BASE_ERROR_H
#define SIM_BASE_ERROR_H

#include "flight/status.h"

// What fails although the input is good: memory, disk. Flight code has neither, hence it stands beyond its
// list.
#define ST_FAILED ((status_t)ST_COUNT)

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  char text[512]; // one line without the newline: "flight.csv:812: column pwm1: not a number: `x`"
} why_t;

// Writes the line (cut to fit) and returns ST_BAD_INPUT, so that `return error_set(why, ...)` is all it
// takes.
status_t error_set(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The same for what is not the input's fault; returns ST_FAILED.
status_t error_failed(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The exit status: 0, 1 for ST_FAILED, 2 for bad input; unless 0 the line goes to standard error.
int error_exit(const char *program, status_t status, const why_t *why);

#ifdef __cplusplus
}
#endif

#endif
