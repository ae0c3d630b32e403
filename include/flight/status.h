// status.h - what a call that can fail returns. On any status but ST_OK nothing has changed, unless the call
// says so.
#ifndef FLIGHT_STATUS_H
#define FLIGHT_STATUS_H

typedef enum {
  ST_OK = 0,
  ST_BAD_INPUT,      // an argument or a sensor value is not finite or out of its physical range
  ST_BAD_SETPOINT,   // a set point is not finite
  ST_BAD_PARAM,      // a parameter is out of its range
  ST_BAD_RANGE,      // a range sample is not a distance: not finite, zero, negative or "invalid"
  ST_JUMP,           // the height jumped by more than the velocity explains; the velocity was used
  ST_SAMPLE_REFUSED, // the curve does not learn from this sample (too far, tilted, too little thrust)
  ST_SINGULAR,       // a matrix that has to be positive definite is not
  ST_BAD_STATE,      // what was remembered is no state (a flipped bit); it started afresh
  ST_COUNT
} status_t;

// A function with a stack frame of its own: inlined, its locals would lie beside those of the deepest call.
#define APART __attribute__((noinline))

// Small and called every millisecond: a call would cost what it does.
#define ALWAYS_INLINE inline __attribute__((always_inline))

#define MUST_CHECK __attribute__((warn_unused_result))

// Hands a status that is not ST_OK to the caller.
#define TRY(call)                                                                                            \
  do {                                                                                                       \
    const __typeof__(call) try_status = (call);                                                              \
    if (try_status != 0) return try_status;                                                                  \
  } while (0)

#endif
