// range.h - stand-in: the last distances of the multiranger and the Z-ranger.
#ifndef CRAZYFLIE_RANGE_H
#define CRAZYFLIE_RANGE_H

typedef enum { rangeFront, rangeBack, rangeLeft, rangeRight, rangeUp, rangeDown } rangeDirection_t;

// Distance in whole millimetres: 0 before the first sample, 32767 if the last one is not valid.
float rangeGet(rangeDirection_t direction);

#endif
