// usddeck.h - stand-in: whether the uSD deck writes a log now.
#ifndef CRAZYFLIE_USDDECK_H
#define CRAZYFLIE_USDDECK_H

#include <stdbool.h>

bool usddeckLoggingEnabled(void);

#endif
