// sensors.h - what the sensors make of the vertical axis: rate, floor and noise.
#ifndef SIM_SENSE_SENSORS_H
#define SIM_SENSE_SENSORS_H

#include "base/random.h"

#define UP_FLOOR_M   0.04 // nearer than this the upward sensor says this
#define UP_MAX_M     4.0  // farther than this it says UP_NOTHING_M
#define UP_NOTHING_M 32.767

// Standard deviations; 0: perfect.
typedef struct {
  const char *name;
  double acc_mps2;   // of an accelerometer sample
  double down_m;     // of a downward range sample; 0: height and climb are known exactly
  double up_m;       // of an upward range sample
  double gust_mps2;  // of the disturbing acceleration (first-order Gauss-Markov)
  double gust_tau_s; // its correlation time
} noise_t;

// none, and the levels N1..N3 (an assumption; N1 is the one that reproduces the thesis's pattern).
extern const noise_t noise_levels[];
extern const int noise_count;

// One step of the disturbance.
double sensors_gust(const noise_t *noise, random_t *r, double gust_mps2, double period_s);

// The upward range sensor at distance gap_m (INFINITY: nothing above).
double sensors_up_m(const noise_t *noise, random_t *r, double gap_m);

#endif
