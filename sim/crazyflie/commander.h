// commander.h - stand-in: who may set points, of several.
#ifndef CRAZYFLIE_COMMANDER_H
#define CRAZYFLIE_COMMANDER_H

// From now on the high-level commander may again.
void commanderRelaxPriority(void);

#endif
