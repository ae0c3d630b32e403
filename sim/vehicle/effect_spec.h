// effect_spec.h - sets effects and their numbers by name, for command lines and vehicle files alike.
//
//   name[:key=value,...]    ceiling:form=exponential,Ca=0.6,Cb=2.2    ceiling:form=table,file=curve.csv
//
// Errors list what is allowed: all effects, the effect's forms, the form's parameters with unit and range.
#ifndef SIM_VEHICLE_EFFECT_SPEC_H
#define SIM_VEHICLE_EFFECT_SPEC_H

#include "base/error.h"
#include "effects/fx.h"

// Parses a complete effect of a command line. On an error *use is unchanged.
MUST_CHECK done_t effect_parse(const char *spec, fx_use_t *use, why_t *why);

// The steps by which an effect is made: the name, then the form, then parameters and points. Errors do not
// name the file.
MUST_CHECK done_t effect_start(fx_use_t *use, const char *name, why_t *why);
MUST_CHECK done_t effect_set_form(fx_use_t *use, const char *form, why_t *why);
MUST_CHECK done_t effect_set(fx_use_t *use, const char *key, double value, why_t *why);
MUST_CHECK done_t effect_set_points(fx_use_t *use, const curve_points_t *points, why_t *why);

// Reads the points from a CSV file with the columns distance_over_radius and ratio.
MUST_CHECK done_t effect_read_points(curve_points_t *points, const char *path, why_t *why);

#endif
