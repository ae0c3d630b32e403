// alike.h - who may be moved together: the inside of body/abreast.h.
#ifndef SIM_BODY_ALIKE_H
#define SIM_BODY_ALIKE_H

#include "body/body.h"
#include "body/lanes.h"

// Whose numbers a lane has, and until what change of them.
typedef struct {
  const body_t *body;
  unsigned changed;
  const body_t *asked; // whose effects were looked up last
  bool knows;          // them all
  const body_t *like;  // whom it was like when it was compared last,
  unsigned like_changed;
  bool is_like;
} has_t;

// Whether it may be moved with others at all.
bool alike_fits(has_t *has, const body_t *b);
// Whether b, whose lane that is, may be moved with a.
bool alike(has_t *has, const body_t *a, const body_t *b);

#endif
