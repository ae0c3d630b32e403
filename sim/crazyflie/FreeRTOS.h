// FreeRTOS.h - stand-in: ticks are milliseconds.
#ifndef CRAZYFLIE_FREERTOS_H
#define CRAZYFLIE_FREERTOS_H

#include <stdint.h>

typedef uint32_t TickType_t;
#define M2T(ms) ((TickType_t)(ms))

#endif
