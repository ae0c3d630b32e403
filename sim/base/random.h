// random.h - repeatable noise. The same seed gives the same numbers.
#ifndef SIM_BASE_RANDOM_H
#define SIM_BASE_RANDOM_H

#include "base/lane.h"
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct noise_source random_t;

// Null if there is no memory.
random_t *random_open(uint64_t seed);
// Normally distributed, mean 0, standard deviation 1.
double random_normal(random_t *r);
// The next n of them, which cost less together.
void random_normals(random_t *r, int n, double *out);
// n numbers (even) of mean 0 and standard deviation 1, each the sum of two even ones: a triangle, never
// beyond 2.45. Ten times as fast as normal ones; for noise that a filter averages afterwards, which makes it
// normal.
void random_triangles(random_t *r, int n, double *out);
// The same of eight, number i of r[k] to rows[LANES * i + k]; of a null pointer nothing is drawn. At most
// RANDOM_ROWS of each; only where lane_possible().
#define RANDOM_ROWS 16
void random_triangles_of_all(random_t *const r[LANES], int n, double *rows);
// Evenly distributed over lo..hi.
double random_uniform(random_t *r, double lo, double hi);
void random_close(random_t *r);

#ifdef __cplusplus
}
#endif

#endif
