// faults_range.c - faults of the upward range sensor.
#include "faults/faults.h"

#include <math.h>

static void range_is(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->range_m = c->size;
}
static void range_frozen(case_t *c, pilot_in_t *in, double since_s) {
  if (since_s < 5e-4) c->kept = in->range_m;
  in->range_m = c->kept;
  c->goal_m = since_s < 1.0 ? 0.12 : c->row->gap_m;
}
static void range_shift(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->range_m = fmax(in->range_m + c->size, 0.04);
}
// Climbs from 30 cm at 0.1 m/s until the range, which says too much, is 6 cm.
static void climb_by_range(case_t *c, pilot_in_t *in, double since_s) {
  range_shift(c, in, since_s);
  c->goal_m = fmax(0.3 - 0.1 * fmax(since_s - 1.5, 0.0), 0.06 - c->size);
}
static void biased(case_t *c) {
  c->onset_s = 0.0;
}
static void range_scale(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->range_m *= c->pick % 2 ? 1000.0 : 0.001;
}
static void below_floor(case_t *c, pilot_in_t *in, double since_s) {
  (void)in, (void)since_s;
  c->goal_m = 0.03;
}
static void locked_out(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s < 5e-4) faults_pilot(c)->flight->outer.ceiling.zc_m = 0.04f;
}
// Moves up and down at 0.3 m/s, 10 to 40 cm below the ceiling, while samples come late, twice or not at all.
static void late_samples(case_t *c, pilot_in_t *in, double since_s) {
  const double x = random_uniform(c->r, 0.0, 1.0);
  const double phase = fmod(since_s + 0.25, 1.0), down = phase < 0.5 ? phase : 1.0 - phase;
  c->goal_m = 0.125 + 0.3 * down;
  in->set.vel_mps.z = phase < 0.5 ? -0.3 : 0.3;
  if (in->range_new) {
    in->range_new = x > 0.3;
    c->kept = c->t_s;
  } else {
    in->range_new = x < 0.02 && isfinite(in->range_m); // the same sample again
  }
}
// Sways with up to 20 degrees of tilt.
static void swaying(case_t *c, pilot_in_t *in, double since_s) {
  (void)c;
  const double w = 3.14159265358979, top_m = 9.81 * tan(20.0 * 3.14159265358979 / 180.0) / (w * w);
  const double s = fmin(since_s, 2.0) / 2.0, size_m = top_m * s * s;
  in->set.pos_w_m.x = size_m * sin(w * since_s);
  in->set.vel_mps.x = size_m * w * cos(w * since_s);
  in->set.acc_w_mps2.x = -size_m * w * w * sin(w * since_s);
}

// --- criteria of their own --------------------------------------------------------------------------------

static const char *soon(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.moved_s >= 0.0 && c->seen.seen_s > c->seen.moved_s + 0.35 ? "retreat in time" : NULL;
}
static const char *no_pulse(const case_t *c, const flown_fault_t *usual) {
  return c->seen.pulse_N > usual->pulse_N + 0.05 * usual->hover_N ? "pulse" : NULL;
}
static const char *no_rise(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.rise_m > 0.02 ? "rise" : NULL;
}
static const char *distance_1_cm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.zc_error_m > 0.01 ? "distance" : NULL;
}
static const char *distance_18_mm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.zc_error_m > 0.018 ? "distance" : NULL;
}
// The vehicle moves at 0.3 m/s: three samples missed in a row leave an error of 2 cm.
static const char *distance_25_mm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.zc_error_m > 0.025 ? "distance" : NULL;
}
static const char *tilted_indeed(const case_t *c, const flown_fault_t *usual) {
  return c->seen.tilt_max_deg < 17.0 ? "tilt" : distance_18_mm(c, usual);
}
// Without a ceiling the flight may end at any height, in a hover or going down.
static const char *no_ceiling(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->pilot.flight->out.outer.zc_known ? "no ceiling" : NULL;
}
static void from_the_start(case_t *c) {
  c->onset_s = 0.0;
}

enum {
  DOWN = GUARD_RANGE_LOST | GUARD_RANGE_FROZEN | GUARD_BLIND | GUARD_TOO_NEAR | GUARD_RANGE_ODD,
};
#define EVER FAULTS_EVER
static const row_t rows[] = {
    {"13 range 32.767 after a ceiling", 'B', 0.06, EVER, EVER, 32.767, 32.767, range_is, GUARD_RANGE_LOST,
     0.37, 100, NULL, NULL, 0, false, false},
    {"14 range 0 from the start", 'N', 0.06, EVER, EVER, 0, 0, range_is, GUARD_RANGE_ODD, 0.25, 100,
     from_the_start, no_ceiling, 0, false, false},
    {"15 range frozen", 'B', 0.06, EVER, EVER, 0, 0, range_frozen, GUARD_RANGE_FROZEN, 2.0, 100, NULL, soon,
     0, false, false},
    {"16 range jumps down", 'A', 0.3, 0.1, 2, -0.2, -0.05, range_shift, 0, 0, 100, NULL, no_pulse, 0, false,
     false},
    {"17 range jumps up", 'A', 0.06, 0.1, 2, 0.05, 0.5, range_shift, GUARD_RANGE_ODD, 0.25, 99.5, NULL,
     no_rise, 0, false, false},
    {"18 range +bias in hover", 'N', 0.06, EVER, EVER, 0.05, 0.5, range_shift, 0, 0, 100, NULL, NULL, 0,
     false, false},
    {"18 range +5 to 10 cm, climbing by it", 'W', 0.3, EVER, EVER, 0.05, 0.1, climb_by_range, GUARD_RATIO,
     12.0, 99.5, biased, NULL, 0, false, false},
    {"18 range +10 to 50 cm, climbing by it", 'W', 0.3, EVER, EVER, 0.1, 0.5, climb_by_range, GUARD_RATIO,
     12.0, 99.5, biased, NULL, 0, false, false},
    {"19 below the floor, 3 cm", 'B', 0.10, EVER, EVER, 0, 0, below_floor, GUARD_BLIND, 6.0, 100, NULL, NULL,
     0, false, false},
    {"20 locked out at 4 cm", 'A', 0.3, 0.1, 0.1, 0, 0, locked_out, 0, 0, 99.9, NULL, distance_1_cm, 0, false,
     false},
    {"21 range late, missed, doubled", 'N', 0.2, EVER, EVER, 0, 0, late_samples, 0, 0, 99.5, NULL,
     distance_25_mm, 0, false, false},
    {"22 range x 1000 or / 1000", 'B', 0.06, EVER, EVER, 0, 0, range_scale, DOWN, 0.37, 100, NULL, NULL, 0,
     false, false},
    {"23 tilted to 20 deg", 'N', 0.2, EVER, EVER, 0, 0, swaying, 0, 0, 100, NULL, tilted_indeed, 0, false,
     false},
};

rows_t faults_of_range(void) {
  return (rows_t){rows, (int)(sizeof rows / sizeof *rows)};
}
