// here.h - is included before everything in src/firmware when it is compiled for the host: makes the app's
// one state that of the vehicle that this thread flies.
#ifndef CRAZYFLIE_HERE_H
#define CRAZYFLIE_HERE_H

#include "stand_in.h"

#define GLUE (*(glue_t *)stand_in->app)

#endif
