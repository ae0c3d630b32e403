// battery.h - one lithium-polymer cell under the motors' load.
//
//   U = U0(charge) - R I,   I = I0 + sum over rotors q_i (a f_i + b f_i^2),   charge' = -I / capacity
//
// f_i: thrust in free air, N. q_i: share of the current that remains where the inflow is hindered. U0: a
// table over the charge, linear between its points.
#ifndef SIM_PLANT_BATTERY_H
#define SIM_PLANT_BATTERY_H

#define BATTERY_TABLE_MAX 21

typedef struct {
  double capacity_As;               // > 0; 0: no battery is modelled, and the voltage stays BATTERY_FULL_V
  double resistance_ohm;            // >= 0   internal, including plugs and wires
  double idle_A;                    // >= 0   of electronics and decks
  double a_ApN;                     // >= 0   ampere per newton of one motor
  double b_ApN2;                    // >= 0   ampere per newton squared of one motor
  int n;                            // points of the table, 2..BATTERY_TABLE_MAX
  double open_V[BATTERY_TABLE_MAX]; // without load, at charge 0, 1/(n-1), .., 1
} battery_param_t;

// Voltage of a model without a battery.
#define BATTERY_FULL_V 4.2

// Open-circuit voltage at charge 0..1; constant outside that range.
double battery_open_V(const battery_param_t *p, double charge);

// Total current with n rotors. thrust_N: in free air; negative thrusts draw nothing. left: the share of each
// rotor's current that remains; null: all of it.
double battery_current_A(const battery_param_t *p, const double *thrust_N, const double *left, int n);

// Voltage at the terminals, >= 0.
double battery_voltage_V(const battery_param_t *p, double charge, double current_A);

// The charge after span_s at that current, >= 0.
double battery_discharge(const battery_param_t *p, double charge, double current_A, double span_s);

#endif
