// units.h - the units that logs come in, by kind of quantity.
#ifndef SIM_LOGS_UNITS_H
#define SIM_LOGS_UNITS_H

#include <stddef.h>

typedef enum {
  KIND_TIME,
  KIND_LENGTH,
  KIND_SPEED,
  KIND_ACCELERATION,
  KIND_NUMBER,
  KIND_ANGLE,
  KIND_RATE,
  KIND_MOTOR, // command of 0..65535
  KIND_SPIN,  // of a rotor
  KIND_FORCE,
  KIND_TORQUE,
  KIND_VOLTAGE,
  KIND_COUNT
} kind_t;

typedef struct {
  const char *name;
  double si; // ours per one of it
} unit_t;

// Unit number i of a kind, the first is ours; a null pointer beyond the last.
const unit_t *unit_at(kind_t kind, int i);

// The unit of that name; a null pointer if the kind has none.
const unit_t *unit_find(kind_t kind, const char *name);

// Adds the names of a kind's units to a list, with commas.
void unit_list(kind_t kind, char *list, size_t size);

#endif
