// beside.h - what the sideways range sensors see: the scene's wall, and a hand that somebody holds there.
//
// The sensors are at the vehicle's centre and look along x and y of the body. A beam that meets nothing
// within BESIDE_FAR_M reads BESIDE_NONE_MM, as in the firmware's multiranger.c (2a18fc29). No noise, no cone.
#ifndef SIM_DRONE_BESIDE_H
#define SIM_DRONE_BESIDE_H

#include "base/d3.h"
#include <stdint.h>

#define BESIDE_FAR_M   4.0 // VL53L1X data sheet: in the dark, to a white target
#define BESIDE_HAND_M  0.1
#define BESIDE_NONE_MM 32767

enum { BESIDE_FRONT, BESIDE_BACK, BESIDE_LEFT, BESIDE_RIGHT, BESIDE_N };

// Fills mm. wall_y_m: a wall in the plane of this y; infinite: none. hand: 1 + the side where it is; 0: none.
void beside_look(d3_t pos_w_m, dq_t q_wb, double wall_y_m, int hand, uint16_t mm[BESIDE_N]);

#endif
