// by_size.h - for qsort: doubles in ascending order.
#ifndef SIM_BASE_BY_SIZE_H
#define SIM_BASE_BY_SIZE_H

static inline int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

#endif
