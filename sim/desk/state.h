// state.h - what flies at the desk, as the page asks for it (desk/page.h).
#ifndef SIM_DESK_STATE_H
#define SIM_DESK_STATE_H

#include "desk/datagrams.h"
#include "drone/drone.h"
#include <cjson/cJSON.h>

typedef struct {
  const char *uri;
  const datagrams_t *radio;
  double beside_m; // added to y: its place on the page
} seen_as_t;

// Returns the vehicle's part of /state, for the caller to delete. Null: out of memory.
cJSON *state_of(const drone_t *d, const seen_as_t *as);

#endif
