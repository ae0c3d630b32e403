// nth.h - order statistics without sorting all (std::nth_element behind a C header).
#ifndef SIM_BASE_NTH_H
#define SIM_BASE_NTH_H

#ifdef __cplusplus
extern "C" {
#endif

// The number that would stand at v[k], 0 <= k < n, if v were sorted, the smallest first. It does stand there
// afterwards, with none that is larger before it and none that is smaller behind. No NaN among them.
double nth_smallest(double *v, int n, int k);

#ifdef __cplusplus
}
#endif

#endif
