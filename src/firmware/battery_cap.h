// battery_cap.h - a low battery caps the thrust: what the motors got of it.
//
// A battery below some 3.0 V under load cannot give full thrust; the firmware's power distribution then
// lowers the duty of all motors alike, until the highest is full.
#ifndef BATTERY_CAP_H
#define BATTERY_CAP_H

#include "flight/mixer.h"

// Lowers force_N, which power distribution asked of each motor, to what it got in the last millisecond.
void battery_cap(float force_N[MOTORS]);

#endif
