// radio.h - nobody feeds the firmware's watchdog any more: down, before it stops the motors in the air.
//
// Who flies the vehicle from a laptop feeds the emergency-stop watchdog (tools/cf.py: five times a second); a
// second after the last time it stops the motors at any height, while the high-level commander alone would
// hover on. Half a second after it this has the high-level commander land where the vehicle is, and feeds the
// watchdog in the other's place until it is down, RADIO_DOWN_MS at most. Then the watchdog does as ever: it
// stops the motors, and the vehicle must be restarted. Who feeds again has the say again. An emergency stop
// works throughout. A vehicle that was never fed is not touched, nor one that the guard hands over.
#ifndef FIRMWARE_RADIO_H
#define FIRMWARE_RADIO_H

#define RADIO_LOST_MS  500  // half of the watchdog's time
#define RADIO_DOWN_MS  8000 // from 3 m, twice the way
#define RADIO_SINK_MPS 0.5f

// Ten times a second at least.
void radio_watch(void);

#endif
