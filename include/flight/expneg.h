// expneg.h - exp(-x) for x >= 0, from additions and products alone.
//
// The same bits on the Crazyflie and on the host, which two libraries' expf do not give.
// exp(-x) = 2^-n exp(r), r = n ln 2 - x, |r| <= ln 2 / 2, with the Taylor polynomial of degree 7 for exp(r).
#ifndef FLIGHT_EXPNEG_H
#define FLIGHT_EXPNEG_H

// x: 0..inf. Result: 1..0, at most 1.03 ulp from exp(-x) up to x = 87 (1.0246 over all floats, near 81.4); 0
// beyond (exp(-87) is the smallest normal float). Negative x and NaN give 1.
float expneg(float x);

#endif
