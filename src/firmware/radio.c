// radio.c - lands before the firmware's watchdog stops the motors in the air.
#include "radio.h"

#include "FreeRTOS.h"
#include "commander.h"
#include "crtp_commander_high_level.h"
#include "crtp_supervisor.h"
#include "glue.h"
#include "supervisor.h"
#include "task.h"

static uint32_t last_fed_ms(void) {
  return crtpSupervisorGetEmergencyStopWatchdogNotificationTick(); // a tick is a millisecond; 0: never
}

static void feed(radio_t *r) {
  crtpSupervisorNotifyEmergencyStopWatchdog();
  r->fed_ms = last_fed_ms();
}

static void descend(radio_t *r, uint32_t now_ms) {
  commanderRelaxPriority(); // the stream of single set points has ended
  if (crtpCommanderHighLevelLandWithVelocity(0.0f, RADIO_SINK_MPS, false) != 0) return;
  r->descends = true;
  r->since_ms = now_ms;
  feed(r);
}

void radio_watch(void) {
  radio_t *const r = &GLUE.radio;
  const uint32_t fed_ms = last_fed_ms(), now_ms = xTaskGetTickCount(); // in this order: now_ms is not earlier
  const bool others = fed_ms != r->fed_ms;                             // somebody else has fed since
  const bool leave = !supervisorIsFlying() || fed_ms == 0 || GLUE.flight.guard.action == GUARD_HAND_OVER;
  if (leave || others) r->descends = false;
  if (leave) return;
  if (r->descends) {
    if (now_ms - r->since_ms < RADIO_DOWN_MS) feed(r);
  } else if (others && now_ms - fed_ms >= RADIO_LOST_MS) {
    descend(r, now_ms);
  }
}
