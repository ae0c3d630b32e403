// hide.h - vehicles of all sizes for the second plant, and what can be hidden in them.
#ifndef TEST_EXAM_OTHER_HIDE_H
#define TEST_EXAM_OTHER_HIDE_H

#include "exam/other/nature.h"

// What is hidden in the sensors.
typedef struct {
  vec_t acc_mps2, acc_turn_rad; // bias and turn of the accelerometer
  double range_m, range_late_s;
} dishonest_t;

// Draws a vehicle of 0.03 to 1.5 kg, in a room without a ceiling, with drags (known to its user) or without.
nature_t hide_vehicle(dice_t *d);

#define HIDE_EFFECTS 20
#define HIDE_DELAY_S 0.010 // typical
#define HIDE_LAG_S   0.020
const char *hide_name(int i);
int hide_number(const char *name); // HIDE_EFFECTS: no such effect
// Hides effect i at `times` its typical size; which (0..1) chooses its sign, rotor or direction. Typical
// sizes are a Crazyflie's, scaled to the vehicle: shares of weight, arm and inertia, rates and lengths.
void hide_effect(int i, double times, double which, nature_t *n, dishonest_t *senses);
// Changes the vehicle so that it can show the effect and its user does not know it already. Call it before
// the vehicle file is written.
void hide_prepare(int i, dice_t *d, nature_t *n);

// Hides effect i outside the library in flights that go as far as `far_m`. Returns the right answer:
// coordinate and channels.
typedef struct {
  const char *what, *coordinate; // "": any
  unsigned channels;             // bits: force_x, force_y, force_z, turn_x, turn_y, turn_z
} hide_strange_t;
#define HIDE_STRANGE 5
hide_strange_t hide_strange(int i, double times, dice_t *d, double far_m, nature_t *n);

// Returns how far a vehicle flies, over a Crazyflie.
double hide_stretch(const nature_t *n);

#endif
