// manoeuvre.h - where an effect shows, and what to fly to tell it from another one.
#ifndef SIM_GAP_4_CANDIDATES_MANOEUVRE_H
#define SIM_GAP_4_CANDIDATES_MANOEUVRE_H

#include "effects/fx.h"

#define MANOEUVRE_BYTES 240

// The coordinates (unknown.h) along which the effect changes; the second may be null. Both null, for effects
// that are not in the table: any but time, whichever tells most. The channel in which it is easiest to see;
// null: in which it shows most.
typedef struct {
  const char *coordinate[2], *channel;
} where_t;

where_t manoeuvre_where(const fx_t *fx);

// What shows the effect.
const char *manoeuvre_show(const fx_t *fx);

// What tells the two apart, in either order. Pairs without an own one: the manoeuvres that show each.
void manoeuvre_apart(const fx_t *fx, const fx_t *rival, char text[MANOEUVRE_BYTES]);

#endif
