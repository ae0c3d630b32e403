// values.h - parameters and logs as numbers, by the firmware's types.
#ifndef CRAZYFLIE_VALUES_H
#define CRAZYFLIE_VALUES_H

#include "sections.h"

void values_put(int param_type, void *at, double value);
void values_put_log(int log_type, void *at, double value);
double values_of_param(int param_type, const void *at);
double values_of_log(int log_type, const void *at);

#endif
