// units.c - the units that logs come in.
#include "logs/units.h"

#include "base/constants.h"
#include "base/text.h"
#include <string.h>

#define UNITS_MAX 6

// The first unit of a kind is ours.
static const unit_t UNITS[KIND_COUNT][UNITS_MAX] = {
    [KIND_TIME] = {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}},
    [KIND_LENGTH] = {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}},
    [KIND_SPEED] = {{"m/s", 1.0}, {"cm/s", 1e-2}, {"mm/s", 1e-3}},
    [KIND_ACCELERATION] = {{"m/s2", 1.0}, {"g", G_MPS2}, {"mg", 9.81e-3}},
    [KIND_NUMBER] = {{"1", 1.0}},
    [KIND_ANGLE] = {{"rad", 1.0}, {"deg", PI / 180.0}},
    [KIND_RATE] = {{"rad/s", 1.0}, {"deg/s", PI / 180.0}},
    [KIND_MOTOR] = {{"pwm", 1.0}, {"percent", 655.35}, {"share", 65535.0}},
    [KIND_SPIN] = {{"rad/s", 1.0}, {"rpm", PI / 30.0}},
    [KIND_FORCE] = {{"N", 1.0}, {"mN", 1e-3}, {"gram", 9.81e-3}},
    [KIND_TORQUE] = {{"Nm", 1.0}, {"mNm", 1e-3}, {"uNm", 1e-6}},
    [KIND_VOLTAGE] = {{"V", 1.0}, {"mV", 1e-3}},
};

const unit_t *unit_at(kind_t kind, int i) {
  return i < UNITS_MAX && UNITS[kind][i].name ? &UNITS[kind][i] : NULL;
}

const unit_t *unit_find(kind_t kind, const char *name) {
  const unit_t *unit;
  for (int i = 0; (unit = unit_at(kind, i)) != NULL; i++)
    if (strcmp(unit->name, name) == 0) return unit;
  return NULL;
}

void unit_list(kind_t kind, char *list, size_t size) {
  const unit_t *unit;
  for (int i = 0; (unit = unit_at(kind, i)) != NULL; i++)
    text_add(list, size, "%s%s", list[0] ? ", " : "", unit->name);
}
