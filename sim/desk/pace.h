// pace.h - how far the flight should be, by the clock on the wall.
#ifndef SIM_DESK_PACE_H
#define SIM_DESK_PACE_H

#define PACE_BEHIND_S 0.2 // farther behind than this, the time is let go: nothing hurries after it

typedef struct {
  double speed;    // simulated seconds a second
  double begin_s;  // of the wall's clock, when the flight's was 0
  double behind_s; // of the wall's clock, as it was looked at last
} pace_t;

// Seconds since whenever, which never go back.
double pace_wall_s(void);

// The flight has come to at_s.
pace_t pace_begin(double speed, double wall_s, double at_s);

// How far it should be now, in its own seconds; it has come to at_s.
double pace_until_s(pace_t *p, double wall_s, double at_s);

#endif
