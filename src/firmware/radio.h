// radio.h - lands when nobody feeds the firmware's watchdog any more, before it stops the motors in the air.
//
// A laptop that flies the vehicle feeds the emergency-stop watchdog (tools/cf.py: five times a second). A
// second after the last time the watchdog stops the motors at any height, while the high-level commander
// alone would hover on. Half a second after it, this has the high-level commander land where the vehicle is,
// and feeds the watchdog in the laptop's place until it is down, RADIO_DOWN_MS at most. Then the watchdog
// acts as usual: it stops the motors, and the vehicle must be restarted. If the laptop feeds again, it has
// control again. An emergency stop works throughout. Nothing is done if the watchdog was never fed, or if the
// guard hands over.
#ifndef FIRMWARE_RADIO_H
#define FIRMWARE_RADIO_H

#define RADIO_LOST_MS  500  // half of the watchdog's time
#define RADIO_DOWN_MS  8000 // a descent from 3 m takes 6 s
#define RADIO_SINK_MPS 0.5f

// Call at least ten times a second.
void radio_watch(void);

#endif
