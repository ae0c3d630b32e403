// debug.h - stand-in: the console.
#ifndef CRAZYFLIE_DEBUG_H
#define CRAZYFLIE_DEBUG_H

#include "stand_in.h"

#define DEBUG_PRINT(...) stand_in_print(DEBUG_MODULE ": " __VA_ARGS__)

#endif
