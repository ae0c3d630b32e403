// eventtrigger.h - stand-in: the firmware's events. They have no payload: the app logs what belongs to one by
// name.
#ifndef CRAZYFLIE_EVENTTRIGGER_H
#define CRAZYFLIE_EVENTTRIGGER_H

#include "sections.h"

typedef section_event_t eventtrigger;

#define EVENTTRIGGER(event)                                                                                  \
  static const eventtrigger eventTrigger_##event = {#event};                                                 \
  static const eventtrigger *const section_event_##event                                                     \
      __attribute__((section("crazyflie_events"), used)) = &eventTrigger_##event;

void eventTrigger(const eventtrigger *event);

#endif
