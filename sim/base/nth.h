// nth.h - order statistics without a complete sort (std::nth_element behind a C header).
#ifndef SIM_BASE_NTH_H
#define SIM_BASE_NTH_H

#ifdef __cplusplus
extern "C" {
#endif

// The number that would stand at v[k], 0 <= k < n, if v were sorted in ascending order. Reorders v so that it
// stands there, with no larger number before it and no smaller one after it. v must not contain NaN.
double nth_smallest(double *v, int n, int k);

// Median of the absolute value of a normal number of sd 1.
#define NTH_NORMAL_MEDIAN 0.6745

#ifdef __cplusplus
}
#endif

#endif
