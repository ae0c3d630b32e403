// crtp_commander_high_level.h - stand-in: the high-level commander, which the app asks to land.
#ifndef CRAZYFLIE_CRTP_COMMANDER_HIGH_LEVEL_H
#define CRAZYFLIE_CRTP_COMMANDER_HIGH_LEVEL_H

#include <stdbool.h>

// Returns nonzero if it refuses.
int crtpCommanderHighLevelLandWithVelocity(const float height_m, const float velocity_m_s, bool relative);

#endif
