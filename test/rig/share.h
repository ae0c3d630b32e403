// share.h - checks that at least the promised share of randomly drawn cases keeps what is asked for.
//
// If the promise holds, fewer than share_fewest(n, promise) of n cases keep it in only one of 1/SHARE_WRONG
// runs (binomial), whatever the seeds: a failure means a broken promise, not an unlucky draw. Few cases
// detect only what is badly broken; TEST_LONG flies more.
#ifndef TEST_RIG_SHARE_H
#define TEST_RIG_SHARE_H

#include "rig/test.h"
#include <stdint.h>

#define SHARE_WRONG 1e-3

#ifdef __cplusplus
extern "C" {
#endif

// promise: 0..1; 1: all n.
int share_fewest(int n, double promise);

#ifdef __cplusplus
}
#endif

// Returns a test's first seed: `usual`, the same in every run, or, with SEED=N (1 to 999999) in the
// environment, one of a range of its own for each N. Cases count up from it by less than 10,000.
uint64_t share_seed(uint64_t usual);

// Checks that enough of n cases kept a promise made for the share `promise`; says how many were wanted. Fails
// if n is so small that no result could refute the promise.
#define CHECK_SHARE(kept, n, promise) share_check(__FILE__, __LINE__, #kept, (kept), (n), (promise))
bool share_check(const char *file, int line, const char *what, int kept, int n, double promise);

#endif
