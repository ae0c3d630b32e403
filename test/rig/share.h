// share.h - promises about shares: of many cases drawn anew, so many keep what is asked for.
//
// If a share is promised and true, fewer than share_fewest(n, promise) of n cases keep it once in
// SHARE_WRONG^-1 runs (binomial), whatever the seeds are: a failure is a broken promise, not an unlucky draw.
// Few cases see only what is badly broken; TEST_LONG flies more.
#ifndef TEST_RIG_SHARE_H
#define TEST_RIG_SHARE_H

#include "rig/test.h"
#include <stdint.h>

#define SHARE_WRONG 1e-3

#ifdef __cplusplus
extern "C" {
#endif

// promise: 0..1. 1: all of them.
int share_fewest(int n, double promise);

#ifdef __cplusplus
}
#endif

// The first of a test's seeds: `usual`, the same in every run, or, with SEED=N in the environment, of a range
// of its own for each N (1 to 999999). Cases count up from it by less than 10,000.
uint64_t share_seed(uint64_t usual);

// `kept` of n, where `promise` of all are promised; says how many were wanted. Of so
// few that none would do it fails.
#define CHECK_SHARE(kept, n, promise) share_check(__FILE__, __LINE__, #kept, (kept), (n), (promise))
bool share_check(const char *file, int line, const char *what, int kept, int n, double promise);

#endif
