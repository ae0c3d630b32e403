// stock_indi_outer.h - the position loop of the Crazyflie firmware's INDI, with its faults.
//
//   v_ref = 1.0 (p_ref - p),  a_ref = 5.0 (v_ref - v),  e = a_ref - R a_f - g      all in north-east-down
//   roll += y_b e / 9.81,  pitch -= x_b e / (9.81 cos roll),  thrust += -(z_b e)/K_thr
//
// x_b, y_b, z_b are the body axes at the filtered angles. The columns of the firmware's matrix G are z_b and
// its derivatives by roll and pitch, times -9.81, and thus orthogonal; its Moore-Penrose inverse gives the
// second line. 500 Hz; acceleration, angles and thrust pass the same 8 Hz low-pass, the thrust also a lag of
// gain 0.03149. Source: bitcraze/crazyflie-firmware 2a18fc29, position_controller_indi.c.
//
// Faults kept (numbers as in stock_indi.h): 3, 5, 6, 7, 8; and T/m is always 9.81.
#ifndef SIM_CRAZYFLIE_STOCK_INDI_OUTER_H
#define SIM_CRAZYFLIE_STOCK_INDI_OUTER_H

#include "base/lowpass.h"
#include "crazyflie/stock_units.h"

typedef struct {
  double kp_per_s, kd_per_s;
  double thrust_mps2; // K_thr: acceleration per unit of thrust
  double tilt_max_deg;
  double lag_gain;   // of the thrust, per tick of 2 ms
  double cutoff_Hz;  // read only when the controller is selected
  double thrust_max; // units
} stock_indi_outer_param_t;

stock_indi_outer_param_t stock_indi_outer_default(void);

typedef struct {
  lowpass_t acc[3], angle[3], thrust_filter;
  double lagged_thrust;               // units
  double roll_rad, pitch_rad, thrust; // commands; pitch nose up, thrust in units
} stock_indi_outer_t;

// Does what the firmware does when the controller is selected: filters start at 0, the thrust is NOT reset.
void stock_indi_outer_select(stock_indi_outer_t *s, const stock_indi_outer_param_t *p);

// Runs one period of 2 ms.
void stock_indi_outer_step(stock_indi_outer_t *s, const stock_indi_outer_param_t *p, const pilot_in_t *in,
                           const stock_view_t *view);

#endif
