// nth.cpp - order statistics.
#include "base/nth.h"

#include <algorithm>

double nth_smallest(double *v, int n, int k) {
  std::nth_element(v, v + k, v + n);
  return v[k];
}
