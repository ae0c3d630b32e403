// constants.h - gravity and pi, once.
#ifndef SIM_BASE_CONSTANTS_H
#define SIM_BASE_CONSTANTS_H

#include <math.h> // its M_PI is not in C11

#define G_MPS2      9.81
#define PI          3.14159265358979323846
#define RAD_PER_DEG (PI / 180.0)
#define DEG_PER_RAD (180.0 / PI)

#endif
