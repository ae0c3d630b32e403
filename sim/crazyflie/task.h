// task.h - stand-in: ticks and delays.
#ifndef CRAZYFLIE_TASK_H
#define CRAZYFLIE_TASK_H

#include "FreeRTOS.h"

void vTaskDelay(TickType_t ticks);
TickType_t xTaskGetTickCount(void);

#endif
