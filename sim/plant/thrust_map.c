// thrust_map.c - the inputs of a thrust map; the map itself is in thrust_map_few.h.
#include "plant/thrust_map.h"

bool thrust_map_takes_speed(const thrust_map_t *map) {
  return map->kind == THRUST_MAP_SPEED;
}

bool thrust_map_needs_voltage(const thrust_map_t *map) {
  return map->kind == THRUST_MAP_STAND || map->kind == THRUST_MAP_VOLT_CUBIC;
}
