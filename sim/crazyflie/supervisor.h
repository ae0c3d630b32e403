// supervisor.h - stand-in: the supervisor says whether the vehicle flies and whether its motors may run.
#ifndef CRAZYFLIE_SUPERVISOR_H
#define CRAZYFLIE_SUPERVISOR_H

#include <stdbool.h>

bool supervisorCanFly(void);
bool supervisorIsFlying(void);
bool supervisorAreMotorsAllowedToRun(void);

#endif
