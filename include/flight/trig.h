// trig.h - sine, cosine and their inverse from additions and products alone: the same bits on the Crazyflie
// and on the host.
#ifndef FLIGHT_TRIG_H
#define FLIGHT_TRIG_H

typedef struct {
  float sin, cos;
} sincos_t;

// Returns sine and cosine of x_rad, within +-1000; beyond, or NaN: as for 0. Error at most 1e-6 within +-10.
sincos_t trig_sincos(float x_rad);

// Returns the angle, -pi to pi, of a vector (cos, sin) of any length; 0 if it has no direction, or is not
// finite. Error at most 1e-5.
float trig_angle(float sin, float cos);

#endif
