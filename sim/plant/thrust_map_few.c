// thrust_map_few.c - one motor's thrust.
#include "plant/thrust_map_few.h"

double thrust_map_N(const thrust_map_t *map, double command, double vbat_V) {
  return thrust_map_few_N(map, few_all(command), vbat_V)[0];
}
