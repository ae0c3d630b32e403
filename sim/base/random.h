// random.h - repeatable noise. The same seed gives the same numbers.
#ifndef SIM_BASE_RANDOM_H
#define SIM_BASE_RANDOM_H

#include "base/lane.h"
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct noise_source random_t;

// Returns null if there is no memory.
random_t *random_open(uint64_t seed);
// A normally distributed number of mean 0 and standard deviation 1.
double random_normal(random_t *r);
// The next n such numbers; faster than one by one.
void random_normals(random_t *r, int n, double *out);
// n numbers (n even) of mean 0 and standard deviation 1, each the sum of two uniform ones: triangular, never
// beyond 2.45. Ten times as fast as normal numbers; for noise that a filter then averages, which makes it
// nearly normal.
void random_triangles(random_t *r, int n, double *out);
// The same for eight generators: number i of r[k] goes to rows[LANES * i + k]; nothing is drawn for a null
// pointer. n is at most RANDOM_ROWS. Only where lane_possible().
#define RANDOM_ROWS 16
void random_triangles_of_all(random_t *const r[LANES], int n, double *rows);
// Uniformly distributed over lo..hi.
double random_uniform(random_t *r, double lo, double hi);
void random_close(random_t *r);

#ifdef __cplusplus
}
#endif

#endif
