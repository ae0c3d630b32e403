// sync.h - acceleration, attitude, thrust and distance through one and the same filter, so that what an
// incremental law or the learner compares is from the same instant (thesis section 3.2).
#ifndef FLIGHT_SYNC_H
#define FLIGHT_SYNC_H

#include "flight/lpf2.h"
#include "flight/thrust.h"
#include "flight/v3.h"

typedef struct {
  lpf2_coef_t filter;
  float lag_share; // of the motors in one period (thrust_lag_share)
  float period_s;
} sync_coef_t;

typedef struct {
  lpf2_t acc_w[3], att[4], distance;
  quat_t att_last; // last input, which decides the sign: q and -q are the same attitude
  thrust_t thrust;
  bool distance_known;
} sync_t;

typedef struct {
  v3_t acc_b_mps2; // specific force: +9.81 on z at rest
  quat_t q_wb;     // attitude, body to world; any length that quat_plausible takes
  float thrust_N;  // applied during the last period
  bool at_limit;   // thrust_N was at a limit
} sync_in_t;

typedef struct {
  v3_t acc_now_w_mps2; // without gravity, not filtered
  v3_t acc_w_mps2;     // without gravity, filtered
  quat_t q_wb;
  v3_t up_w;      // direction of thrust
  float thrust_N; // that the motors give in free air
} sync_out_t;

// cutoff_Hz: as lpf2_tune. motor_tau_s: > 0. ST_BAD_PARAM: cutoff_Hz out of range; *c is kept.
MUST_CHECK status_t sync_tune(sync_coef_t *c, float cutoff_Hz, float motor_tau_s, float period_s);

// Sets the state as if this sample had always been there; no distance is known.
void sync_start(sync_t *s, const sync_in_t *in);

// True if no bit flip shows in the state (lpf2_sum).
bool sync_good(const sync_t *s);

// Filters the sample of one period.
void sync_step(sync_t *s, const sync_coef_t *c, const sync_in_t *in, sync_out_t *out);

// Shifts the state as if all accelerations along the world's z had been larger by by_mps2.
void sync_shift_acc(sync_t *s, float by_mps2);

// Returns the distance to a surface through the same filter, once a period. An unknown distance is returned
// as it is, and the filter restarts after it.
float sync_distance_m(sync_t *s, const sync_coef_t *c, bool known, float distance_m);

#endif
