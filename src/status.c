// status.c - the statuses in words.
#include "flight/status.h"

const char *status_name(status_t status) {
  static const char *const name[ST_COUNT] = {
      [ST_OK] = "ok",
      [ST_BAD_INPUT] = "bad input",
      [ST_BAD_SETPOINT] = "bad set point",
      [ST_BAD_PARAM] = "bad parameter",
      [ST_BAD_RANGE] = "bad range sample",
      [ST_JUMP] = "height jump",
      [ST_NOT_TAUGHT] = "sample not taught",
      [ST_SINGULAR] = "singular",
      [ST_BAD_STATE] = "bad state",
  };
  const unsigned i = (unsigned)status;
  return i < ST_COUNT ? name[i] : "unknown status";
}
