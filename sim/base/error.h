// error.h - one line for a person: what is wrong, where, and what is allowed.
//
// Host calls that can fail return done_t and fill a why_t, the last argument. main ends with
// `return error_exit("program", done, &why)`, which prints it as `program: text`. The flight code has a list
// of its own (flight/status.h): nature and the flight code share no header.
#ifndef SIM_BASE_ERROR_H
#define SIM_BASE_ERROR_H

typedef enum {
  DONE = 0,
  BAD_INPUT, // what was given cannot be used
  FAILED,    // the input is good: memory, disk
} done_t;

// The two macros stand word for word in flight/status.h as well, so that a file may hear of both.
#define MUST_CHECK __attribute__((warn_unused_result))

// Hands what is not done, or not ok, to the caller.
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

// Writes the line (cut to fit) and returns BAD_INPUT, so that `return error_set(why, ...)` is all it
// takes.
done_t error_set(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The same for what is not the input's fault; returns FAILED.
done_t error_failed(why_t *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The exit status: 0, 1 for FAILED, 2 for bad input; unless 0 the line goes to standard error.
int error_exit(const char *program, done_t status, const why_t *why);

#ifdef __cplusplus
}
#endif

#endif
