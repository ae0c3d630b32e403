// supervisor.h - stand-in: who says whether the vehicle flies and whether its motors may run.
#ifndef CRAZYFLIE_SUPERVISOR_H
#define CRAZYFLIE_SUPERVISOR_H

#include <stdbool.h>

bool supervisorCanFly(void);
bool supervisorIsFlying(void);
bool supervisorAreMotorsAllowedToRun(void);

#endif
