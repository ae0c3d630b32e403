// state.h - what flies at the desk, as the page asks for it (desk/page.h).
#ifndef SIM_DESK_STATE_H
#define SIM_DESK_STATE_H

#include "desk/datagrams.h"
#include "drone/drone.h"
#include <cjson/cJSON.h>

typedef struct {
  const char *uri;
  const datagrams_t *radio;
  double beside_m; // where its place is on the page, along y
} seen_as_t;

// A null pointer: out of memory. The caller deletes it.
cJSON *state_of(const drone_t *d, const seen_as_t *as);

#endif
