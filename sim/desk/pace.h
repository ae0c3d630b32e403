// pace.h - how far the flight should be, by the wall clock.
#ifndef SIM_DESK_PACE_H
#define SIM_DESK_PACE_H

#define PACE_BEHIND_S 0.2 // a lag beyond this is given up, not caught up

typedef struct {
  double speed;    // simulated seconds per second
  double begin_s;  // wall clock at time 0 of the flight
  double behind_s; // how far the flight was behind at the last call, by the wall clock
} pace_t;

// Seconds of the wall clock since an arbitrary time; they never go back.
double pace_wall_s(void);

// Starts the pace of a flight that has come to at_s.
pace_t pace_begin(double speed, double wall_s, double at_s);

// Returns how far the flight should be now, in its own seconds. at_s: how far it has come.
double pace_until_s(pace_t *p, double wall_s, double at_s);

#endif
