// commander.h - stand-in: the commander, which decides who may set points.
#ifndef CRAZYFLIE_COMMANDER_H
#define CRAZYFLIE_COMMANDER_H

// Lets the high-level commander set points again.
void commanderRelaxPriority(void);

#endif
