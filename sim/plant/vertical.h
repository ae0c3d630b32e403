// vertical.h - the vehicle on its vertical axis: height, climb and thrust (thesis appendix A, eq. A.3).
//
//   z' = v,   m v' = ratio T + F - m g,   T' = (command - T) / tau
//
// Ceiling and ground are met without a bounce, by a machine of two modes: free, and at rest on a surface with
// height and climb frozen until the net force points away from it. At rest the vehicle lies NUDGE inside, so
// that the next approach is a zero crossing again and cannot be missed: a plain bounce tunnels.
#ifndef SIM_PLANT_VERTICAL_H
#define SIM_PLANT_VERTICAL_H

#define PLANT_GRAVITY_MPS2 9.81
#define VERTICAL_NUDGE_M   1e-7

// Order of the state in y[VERTICAL_N].
enum { VERTICAL_Z_M, VERTICAL_CLIMB_MPS, VERTICAL_THRUST_N, VERTICAL_N };

typedef enum { CONTACT_NONE, CONTACT_GROUND, CONTACT_CEILING } contact_t;

typedef struct {
  double mass_kg;     // > 0
  double motor_tau_s; // > 0
  double ceiling_m;   // height at which the rotor plane touches; INFINITY: none. The ground is at 0
  double command_N;   // held
  double force_N;     // held; from outside, upwards
  contact_t contact;
} vertical_t;

// dydt for state y, where the rotors give `ratio` times their free thrust.
void vertical_derivative(const vertical_t *v, const double y[VERTICAL_N], double ratio,
                         double dydt[VERTICAL_N]);

// The vertical acceleration: 0 at rest on a surface.
double vertical_acc_mps2(const vertical_t *v, const double y[VERTICAL_N], double ratio);

// Above 0 while the mode holds: free, the distance to the nearer surface; at rest, the acceleration into the
// surface that the force would give.
double vertical_margin(const vertical_t *v, const double y[VERTICAL_N], double ratio);

// The margin came to zero: the other mode begins. Touching sets the climb to 0.
void vertical_switch(vertical_t *v, double y[VERTICAL_N]);

#endif
