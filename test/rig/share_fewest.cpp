// share_fewest.cpp - the binomial bound (Boost.Math behind a C header).
#include "rig/share.h"

#include <boost/math/distributions/binomial.hpp>

int share_fewest(int n, double promise) {
  const boost::math::binomial kept(n, promise);
  int fewest = n;
  // P(fewer than `fewest` keep it) <= SHARE_WRONG
  while (fewest > 0 && boost::math::cdf(kept, fewest - 1) > SHARE_WRONG) fewest--;
  return fewest;
}
