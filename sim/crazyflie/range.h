// range.h - stand-in: the last distances of the multiranger and the Z-ranger.
#ifndef CRAZYFLIE_RANGE_H
#define CRAZYFLIE_RANGE_H

typedef enum { rangeFront, rangeBack, rangeLeft, rangeRight, rangeUp, rangeDown } rangeDirection_t;

// Whole millimetres: 0 before the first sample, 32767 for none that is valid.
float rangeGet(rangeDirection_t direction);

#endif
