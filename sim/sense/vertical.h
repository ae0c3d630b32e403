// vertical.h - what a vehicle that moves on the vertical axis alone senses: without delay, exactly or with
// white noise. If the downward range has noise, height and climb come from a Kalman filter (kalman_z.h).
#ifndef SIM_SENSE_VERTICAL_H
#define SIM_SENSE_VERTICAL_H

#include "base/random.h"
#include "sense/kalman_z.h"
#include "sense/truth.h"

#define UP_FLOOR_M   0.04 // the upward sensor's reading at smaller distances
#define UP_MAX_M     4.0  // beyond this it reads UP_NOTHING_M
#define UP_NOTHING_M 32.767

// Standard deviations; 0: perfect.
typedef struct {
  const char *name;
  double acc_mps2;   // of an accelerometer sample
  double down_m;     // of a downward range sample; 0: height and climb are known exactly
  double up_m;       // of an upward range sample
  double gust_mps2;  // of the disturbing acceleration (first-order Gauss-Markov)
  double gust_tau_s; // its correlation time
} vertical_noise_t;

// Level none and the levels N1..N3 (assumed; N1 is the one that reproduces the thesis's pattern).
extern const vertical_noise_t vertical_noise_levels[];
extern const int vertical_noise_count;

typedef struct {
  kalman_z_t kalman;
  double period_s, gust_mps2;
  long tick;
} vertical_t;

typedef struct {
  double z_m, climb_mps, acc_mps2; // acc: without gravity
  bool range_new;
  double range_m; // upward, if range_new
} vertical_sample_t;

// Starts at height z_m, at rest; a sample every period_s.
void vertical_init(vertical_t *s, const vertical_noise_t *noise, double period_s, double z_m);
vertical_sample_t vertical_step(vertical_t *s, const vertical_noise_t *noise, random_t *r,
                                const truth_t *truth);

// The disturbing acceleration during the next period.
double vertical_gust_mps2(vertical_t *s, const vertical_noise_t *noise, random_t *r);

// The reading of the upward range sensor at distance gap_m (INFINITY: nothing above).
double vertical_up_m(const vertical_noise_t *noise, random_t *r, double gap_m);

#endif
