// pid.h - the peer of thesis section 4.2: PID on height, optionally with a feed-forward of the ceiling
// effect.
//
//   u_c = clip(P e + I int(e) + D N (e - x)),   x' = N (e - x)    filtered derivative, forward Euler
//   T_c = u_c + m g - (ratio - 1)(u + m g)                        feed-forward, after the clip
//
// e: set point minus height; u + m g: thrust of the rotors; ratio: by Cheeseman-Bennett, with the clip of
// section 4.2.2. With N fixed the discrete derivative is unstable at periods of 2/N and more, which explains
// the thesis's "untunable at 0.02 s" (src/README.md, reading rules).
#ifndef SIM_PILOTS_PID_H
#define SIM_PILOTS_PID_H

#include "crazyflie/pilot.h"

typedef struct {
  double p, i, d; // N/m, N/(m s), N s/m
  double n_per_s; // of the derivative filter
  double limit_N; // of the PID's output, in both directions
  double hover_N; // m g
  bool feed_forward;
  double ceiling_m; // height of the ceiling, for the feed-forward
  double radius_m;  // rotor
  double ratio_max;
} pid_param_t;

typedef struct {
  pid_param_t param;
  double period_s;
  double integral, slow_error; // of the error; the derivative filter's state
  double ratio;                // as believed
} pid_peer_t;

// To be stepped every period_s; *pid must stay where it is.
pilot_t pid_pilot(pid_peer_t *pid, const pid_param_t *param, double period_s);

#endif
