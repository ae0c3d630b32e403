// nature.h - the exam's second plant, written for the exam alone: it shares no line with sim/.
//
// Explicit midpoint at 0.5 ms. The lag is first order in the rotors' speeds. Thrust k w^2 and the drags act
// at each hub, with that hub's own velocity through the air and that rotor's own speed, so they damp turning.
#ifndef TEST_EXAM_OTHER_NATURE_H
#define TEST_EXAM_OTHER_NATURE_H

#include "exam/other/vec.h"

#define NATURE_STEP_S    0.0005
#define NATURE_G_MPS2    9.81
#define NATURE_DELAY_MAX 256 // steps

// Effects that no library has.
typedef enum {
  STRANGE_NONE,
  STRANGE_PLACE,
  STRANGE_LAYER,
  STRANGE_CORNER,
  STRANGE_PULSES,
  STRANGE_SHAKE
} strange_kind_t;

// A vehicle and its surroundings. Body axes x forward, y left, z up; world z up. Places are relative to the
// centre of mass.
typedef struct {
  double mass_kg, inertia_kgm2[3];
  double x_m[4], y_m[4], spin[4]; // spin +1: counter-clockwise from above
  double radius_m;
  double k_Ns2, torque_m;  // thrust over speed squared; torque over thrust
  double lag_s, delay_s;   // lag 0: none
  double most_radps;       // of a rotor
  double gain[4];          // of each rotor's thrust
  double hub_kg, climb_kg; // force over rotor speed and hub velocity: in the disc, along the axis
  double flap_kgm;         // moment over the same, about the axis about which the velocity tilts the disc
  double body_kgpm[3];     // drag of the body along each axis, over |v| v
  double lift_kgpm;        // thrust of all rotors, over the square of the speed in the disc
  double sag, sag_V;       // thrust times 1 - sag (1 - V / sag_V)
  double bend_pN;          // thrust of a rotor T + bend (T - hover)^2
  double ceiling_m, ceiling_share,
      ceiling_m0;        // INFINITY: none; gain at the ceiling, and distance at which it is a quarter of that
  double ground_share;   // times (R / 4 z)^2
  double rest_m;         // height of the centre of mass, and of the rotors, on the floor
  vec_t air_mps, push_N; // world
  strange_kind_t strange;
  double strange_N, strange_at[3];
} nature_t;

typedef struct {
  vec_t pos_m, vel_mps, rate_radps; // world, world, body
  turn_t q;
  double rotor_radps[4];
} nature_state_t;

typedef struct {
  const nature_t *nature;
  nature_state_t s;
  vec_t force_b_N; // specific force times mass, of the last step
  double volt, t_s;
  double late_radps[NATURE_DELAY_MAX][4];
  int steps;
  double felt_s; // for how long something outside the library acted at half its size or more
} nature_flight_t;

// Speed of each rotor in a hover.
double nature_hover_radps(const nature_t *n);

// Thrust that a surface adds at a height, as a share of the thrust in the open.
double nature_ceiling_gain(const nature_t *n, double height_m);
double nature_ground_gain(const nature_t *n, double height_m);

void nature_start(nature_flight_t *f, const nature_t *n, vec_t pos_m);
// One step with these commands.
void nature_step(nature_flight_t *f, const double command_radps[4]);

#endif
