// noise.c - levels of noise.
#include "sense/noise.h"

#include "base/constants.h"
#include <stddef.h>
#include <string.h>

#define QUIET(key, unit, min, max, member, quiet, real, flown, brief, source) .member = (quiet),
#define REAL(key, unit, min, max, member, quiet, real, flown, brief, source)  .member = (real),
#define FLOWN(key, unit, min, max, member, quiet, real, flown, brief, source) .member = (flown),
#define FIELD(key, unit, min, max, member, quiet, real, flown, brief, source)                                \
  {key, unit, min, max, offsetof(noise_t, member), brief, source},

const noise_t noise_levels[] = {
    {.name = "quiet", NOISE_ROWS(QUIET)},
    {.name = "real", NOISE_ROWS(REAL)},
    {.name = "flown", NOISE_ROWS(FLOWN)},
};
const int noise_count = (int)(sizeof noise_levels / sizeof *noise_levels);

const noise_field_t noise_fields[] = {NOISE_ROWS(FIELD)};
const int noise_field_count = (int)(sizeof noise_fields / sizeof *noise_fields);

const noise_t *noise_find(const char *name) {
  for (int i = 0; i < noise_count; i++)
    if (strcmp(noise_levels[i].name, name) == 0) return &noise_levels[i];
  return NULL;
}

double noise_get(const noise_t *noise, const noise_field_t *field) {
  double value;
  memcpy(&value, (const char *)noise + field->offset, sizeof value);
  return value;
}

bool noise_set(noise_t *noise, const char *field, double value) {
  for (int i = 0; i < noise_field_count; i++) {
    const noise_field_t *f = &noise_fields[i];
    if (strcmp(f->name, field) != 0) continue;
    if (!(value >= f->min && value <= f->max)) return false;
    memcpy((char *)noise + f->offset, &value, sizeof value);
    return true;
  }
  return false;
}
