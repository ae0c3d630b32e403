// crtp_commander_high_level.h - stand-in: the high-level commander, of which the app asks a landing.
#ifndef CRAZYFLIE_CRTP_COMMANDER_HIGH_LEVEL_H
#define CRAZYFLIE_CRTP_COMMANDER_HIGH_LEVEL_H

#include <stdbool.h>

// Nonzero: it will not.
int crtpCommanderHighLevelLandWithVelocity(const float height_m, const float velocity_m_s, bool relative);

#endif
