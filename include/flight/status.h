// status.h - what a call that can fail returns. On any status but ST_OK nothing has changed, unless the call
// says so.
#ifndef FLIGHT_STATUS_H
#define FLIGHT_STATUS_H

typedef enum {
  ST_OK = 0,
  ST_BAD_INPUT,      // an argument or a sensor value is not finite or out of its physical range
  ST_BAD_SETPOINT,   // a set point is not finite or out of its bounds
  ST_BAD_PARAM,      // a parameter is out of its range
  ST_BAD_RANGE,      // a range sample is not a distance: not finite, zero, negative or "invalid"
  ST_JUMP,           // the height jumped by more than the velocity explains; the velocity was used
  ST_SAMPLE_REFUSED, // the curve does not learn from this sample (too far, tilted, too little thrust)
  ST_SINGULAR,       // a matrix that has to be positive definite is not
  ST_BAD_STATE,      // a flipped bit had spoilt what was remembered; it has restarted
  ST_COUNT
} status_t;

// Gives a function its own stack frame: inlined, its locals would add to the stack of the deepest call.
#define APART __attribute__((noinline))

// For small functions that run every millisecond: a call would cost as much as the function.
#define ALWAYS_INLINE inline __attribute__((always_inline))

#define MUST_CHECK __attribute__((warn_unused_result))

// Hands a status that is not ST_OK to the caller.
#define TRY(call)                                                                                            \
  do {                                                                                                       \
    const __typeof__(call) try_status = (call);                                                              \
    if (try_status != 0) return try_status;                                                                  \
  } while (0)

#endif
