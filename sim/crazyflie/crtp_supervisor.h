// crtp_supervisor.h - stand-in: the emergency-stop watchdog, which is fed over the link.
#ifndef CRAZYFLIE_CRTP_SUPERVISOR_H
#define CRAZYFLIE_CRTP_SUPERVISOR_H

#include <stdint.h>

void crtpSupervisorNotifyEmergencyStopWatchdog(void);
uint32_t crtpSupervisorGetEmergencyStopWatchdogNotificationTick(void); // 0: never

#endif
