// here.h - comes before everything in src/firmware when it is compiled for the host: the app's one state is
// that of the vehicle which this thread flies.
#ifndef CRAZYFLIE_HERE_H
#define CRAZYFLIE_HERE_H

#include "stand_in.h"

#define GLUE (*(glue_t *)stand_in->app)

#endif
