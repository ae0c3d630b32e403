// thrust_map.h - motor command and battery voltage to the thrust of one motor in free air, static.
#ifndef SIM_PLANT_THRUST_MAP_H
#define SIM_PLANT_THRUST_MAP_H

typedef enum {
  THRUST_MAP_NONE,       // no map: commands are newton
  THRUST_MAP_STAND,      // polynomial of a thrust stand, in grams per motor:
                         //   c0 + c1 p + c2 u + c3 p^2 + c4 p u,  p = pwm/65536, u = vbat/4.2   (Shi et al.)
  THRUST_MAP_VOLT_CUBIC, // newton per motor: c0 + c1 v + c2 v^2 + c3 v^3, v = vbat pwm/65535    (firmware)
} thrust_map_kind_t;

typedef struct {
  thrust_map_kind_t kind;
  double c[5];
} thrust_map_t;

// Newton of one motor, >= 0. pwm: 0..65535; vbat_V: > 0. With THRUST_MAP_NONE: NaN.
double thrust_map_N(const thrust_map_t *map, double pwm, double vbat_V);

#endif
