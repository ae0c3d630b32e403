// effectiveness.h - control effectiveness G1 and G2 of the inner loop from a 500 Hz log, by least squares.
//
//   d w'_f = G1 d u_f + G2 d u'_f      (Smeur 2016; thesis 5.1 and C.2; G2 in yaw only)
//
// w' is the derivative of a gyro rate, u the state of the motors: the command through their first-order lag;
// d is the difference of successive ticks, f the same Butterworth low-pass for both. Four poles by default:
// with two, a second difference lets the gyro's noise through at all frequencies. u is taken at the time
// of w': the command of a tick acts after it, and a difference of rates lies in the middle of its period.
//
// The log has the Crazyflie's columns: tick or timestamp (ms), controller.r_roll, r_pitch, r_yaw (rad/s; roll
// right, nose up, counter-clockwise), controller.cmd_roll, cmd_pitch, cmd_yaw (units; yaw CLOCKWISE), and,
// where it is there, controller.cmd_thrust (units). Results count yaw clockwise. While the app flies, these
// stand still. A log without them is read by the app's own columns, indiIn.step, p, q, r and indi.m1..m4,
// from which the commands are computed; at 500 Hz in odd steps, or every call, as the uSD deck writes it
// (tools/usd/config.txt).
#ifndef SIM_LOGS_EFFECTIVENESS_H
#define SIM_LOGS_EFFECTIVENESS_H

#include "base/error.h"
#include <stdbool.h>

#define EFFECTIVENESS_PERIOD_S 0.002
#define EFFECTIVENESS_GAP_S                                                                                  \
  0.05 // shorter gaps are interpolated linearly; after longer ones everything starts anew
#define EFFECTIVENESS_DELAY_S  0.1
#define EFFECTIVENESS_SETTLE_S 0.5 // nothing counts so long after a start

typedef struct {
  double lag_s;      // of the motors, > 0
  double delay_s;    // 0 to EFFECTIVENESS_DELAY_S, to whole ticks: of motors and gyro filter, beside the lag
  double cutoff_Hz;  // 0.1 to 100
  int poles;         // 2 or 4
  double thrust_min; // units: rows below do not count (only where cmd_thrust is logged)
  double
      motor_max_N; // for the app's own columns: what 65535 stands for, THRUST_MAX of the firmware's platform
  bool as_stock;   // as the firmware's own numbers were found: rows count as successive ticks whatever their
                   // time, all count from the first row on, and u is the lag's output at the same row
} effectiveness_job_t;

// 62.5 ms, 4 Hz, 4 poles, thrust above 10000.
effectiveness_job_t effectiveness_default(void);
// 61.7 ms, 4 Hz, 4 poles, as_stock: gives the firmware's G1 from the firmware's log, and the size of its G2.
// The sign of G2 is the other one, which no rotor's inertia gives, and 14 % of the yaw is explained.
effectiveness_job_t effectiveness_stock(void);

typedef struct {
  double g1[3];        // roll, pitch, yaw: rad/s2 per unit
  double g2;           // yaw: rad/s2 per unit/s. A law written for one tick uses g2 / EFFECTIVENESS_PERIOD_S
  double explained[3]; // share of the variance of d w'_f, roll, pitch, yaw
  long rows, bridged, starts; // read; ticks put in; stretches without a long gap
  long used;                  // ticks that counted
} effectiveness_t;

// The numbers in the firmware (bitcraze/crazyflie-firmware 2a18fc29, controller_indi.h). G1 is in the units
// above. The firmware uses G2 per unit and tick of 2 ms, but the same digits, fitted, are per unit/s: 500
// times less.
#define EFFECTIVENESS_STOCK_G1                                                                               \
  { 0.0066146, 0.0052125, 0.001497 }
#define EFFECTIVENESS_STOCK_G2 4.3475e-5

// BAD_INPUT: no such file, a column missing, not a number, ticks that do not rise or are not those of a
// 500 Hz log, more ticks missing than present, or an axis whose command never moves; names file, line and
// column.
MUST_CHECK done_t effectiveness_fit(const char *path, const effectiveness_job_t *job, effectiveness_t *result,
                                    why_t *why);

#endif
