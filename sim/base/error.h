// error.h - error messages of one line: what is wrong, where, and what is allowed.
//
// Host functions that can fail return done_t and fill a why_t, their last argument. main ends with
// `return error_exit("program", done, &why)`, which prints it as `program: text`. The flight code has its own
// status list (flight/status.h): the simulated nature and the flight code share no header.
#ifndef SIM_BASE_ERROR_H
#define SIM_BASE_ERROR_H

typedef enum {
  DONE = 0,
  BAD_INPUT, // the input cannot be used
  FAILED,    // the input is good, but memory or disk failed
} done_t;

// MUST_CHECK and TRY stand word for word in flight/status.h as well, so that a file may include both.
#define MUST_CHECK __attribute__((warn_unused_result))

// Returns from the calling function, with the status, unless the call returned 0 (done, or ok).
#define TRY(call)                                                                                            \
  do {                                                                                                       \
    const __typeof__(call) try_status = (call);                                                              \
    if (try_status != 0) return try_status;                                                                  \
  } while (0)

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  char text[512]; // one line without the newline: "flight.csv:812: column pwm1: not a number: `x`"
} why_t;

// Writes the line (truncated to fit) and returns BAD_INPUT, so that `return error_set(why, ...)` reports an
// error.
done_t error_set(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The same for errors that are not the input's fault; returns FAILED.
done_t error_failed(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The exit status: 0 for DONE, 1 for FAILED, 2 for bad input. Prints the line on standard error unless 0.
int error_exit(const char *program, done_t status, const why_t *why);

#ifdef __cplusplus
}
#endif

#endif
