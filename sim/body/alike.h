// alike.h - which bodies may be moved together: internal to body/abreast.h.
#ifndef SIM_BODY_ALIKE_H
#define SIM_BODY_ALIKE_H

#include "body/body.h"
#include "body/lanes.h"

// Which body's numbers a lane holds, as of which change of it.
typedef struct {
  const body_t *body;
  unsigned changed;
  const body_t *asked; // the body whose effects were looked up last
  bool knows;          // lanes know all of them
  const body_t *like;  // the body with which it was compared last
  unsigned like_changed;
  bool is_like;
} has_t;

// True if b may be moved with others at all.
bool alike_fits(has_t *has, const body_t *b);
// True if b, which is in that lane, may be moved with a.
bool alike(has_t *has, const body_t *a, const body_t *b);

#endif
