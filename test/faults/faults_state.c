// faults_state.c - faults of set points, of parameters, of time, and of the pilot's own memory.
#include "faults/faults.h"

#include <string.h>

static void nan_setpoint(case_t *c, pilot_in_t *in, double since_s) {
  (void)c, (void)since_s;
  in->set.pos_w_m.z = (double)NAN;
}
static void far_setpoint(case_t *c, pilot_in_t *in, double since_s) {
  (void)c, (void)since_s;
  in->set.pos_w_m.z = 5.0;
}
static void clip_at_5_cm(case_t *c) {
  c->param.gap_min_m = 0.05f;
}
static void fixed_curve(case_t *c) {
  c->param.curve.mode = CURVE_FIXED;
}
static void absurd_param(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  static const float bad[] = {NAN, INFINITY, 1e9f, -1e9f};
  if (since_s > 5e-4) return;
  const param_row_t *row = &params_table[c->pick % (unsigned)params_count];
  memcpy((char *)&faults_pilot(c)->param + row->offset, &bad[(c->pick >> 8) % 4], sizeof(float));
}
static void bad_weights(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s < 5e-4) faults_pilot(c)->param.curve.fixed.w[c->pick % 7] = c->pick & 16 ? NAN : 1e9f;
}
// Writes the weights one by one and never commits them.
static void torn_weights(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  static const double other[] = {1.35, 0.4, -0.3, 0.1, -0.1, -0.4, -0.3};
  const int i = (int)(since_s * 1000.0 + 0.5);
  const char name[] = {'c', 'e', 'i', 'l', '.', 'w', (char)('1' + i), '\0'};
  if (i < 7) (void)crazyflie_set(&c->pilot.vehicle, name, other[i]);
}
static void broken_covariance(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s > 5e-4) return;
  c->memory_broken = true;
  const unsigned i = c->pick % 7;
  float(*P)[7] = faults_pilot(c)->flight->outer.learn.rls.P;
  if (c->pick & 128)
    P[i][(i + 1) % 7] += 1e-3f;
  else
    P[i][i] = c->pick & 64 ? -1.0f : NAN;
}
static void zero_curve(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s < 5e-4)
    for (int i = 0; i < 7; i++) faults_pilot(c)->param.curve.fixed.w[i] = -5.0f;
}
static void missed_calls(case_t *c, pilot_in_t *in, double since_s) {
  (void)in, (void)since_s;
  (void)faults_pilot(c);
  c->skip = c->pick % 2 != 0;
  c->twice = !c->skip;
}
static void wrapped(case_t *c) {
  if (!c->usual) c->step_off = 0xFFFFFFF0u - (uint32_t)(10.0 * floor(c->onset_s * 100.0));
}
static void again(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s > 5e-4) return;
  c->inner.reset(c->inner.state);
  c->shadow_pilot.reset(c->shadow_pilot.state);
  c->with_shadow = true;
}
static void never_reset(case_t *c, pilot_in_t *in, double since_s) {
  (void)c;
  if (since_s < 1.0)
    for (int i = 0; i < 3; i++) in->set.mode[i] = PILOT_OFF;
  in->set.thrust_N = 0.32;
}
static void bit_flip(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s > 5e-4) return;
  c->memory_broken = true;
  unsigned char *const at = (unsigned char *)&faults_pilot(c)->flight->outer.learn.rls;
  at[c->pick % sizeof(rls_t)] ^= (unsigned char)(1u << ((c->pick >> 16) % 8));
}
static void any_bit_flip(case_t *c, pilot_in_t *in, double since_s) {
  (void)in;
  if (since_s > 5e-4) return;
  c->memory_broken = true;
  unsigned char *const at = (unsigned char *)faults_pilot(c)->flight;
  at[c->pick % sizeof(flight_t)] ^= (unsigned char)(1u << ((c->pick >> 16) % 8));
}

// Ten minutes, of which the last nine are judged; the learner trusts each sample twice as much as usual.
static void for_ten_minutes(case_t *c) {
  c->plan.end_s = 600.0;
  c->onset_s = 60.0;
  c->param.learn.rls.lambda = 0.5f;
}

// --- criteria of their own --------------------------------------------------------------------------------

// A tenth of hover is a step. A fault may add half of that, because noise alone makes steps of 6 to 13 %: to
// the largest step within 1 s, and, in the first 50 ms, to the thrust in the same millisecond of the usual
// flight, which has the same noise (FAULTS_TABLE=3 prints both).
static const char *adds_no_step(const case_t *c, const flown_fault_t *usual) {
  const double most_N = 0.05 * usual->hover_N;
  if (c->seen.step_max_N > usual->step_max_N + most_N) return "step";
  return faults_added_N(&c->seen, usual) > most_N ? "step at once" : NULL;
}
static const char *gap_40_mm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.gap_min_m < 0.8 * (double)c->param.gap_min_m ? "0.8 of ceil.min" : NULL;
}
static const char *no_kick(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.kick_N > 3.0 * c->seen.kick_usual_N ? "kick" : NULL;
}
static const char *as_fresh(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.shadow_differs ? "as fresh" : NULL;
}

#define EVER FAULTS_EVER
static const row_t rows[] = {
    {"4 set point NaN", 'B', 0.06, EVER, EVER, 0, 0, nan_setpoint, GUARD_SETPOINT, 0.03, 100, NULL,
     adds_no_step, 0, false, false},
    {"5 set point above, ceil.min 5 cm", 'N', 0.10, EVER, EVER, 0, 0, far_setpoint, 0, 0, 100, clip_at_5_cm,
     gap_40_mm, 0, false, false},
    {"5 set point above, ceil.min 2 cm", 'N', 0.10, EVER, EVER, 0, 0, far_setpoint, 0, 0, 99.5, NULL,
     gap_40_mm, 0, false, false},
    {"31 absurd parameter", 'A', 0.06, EVER, EVER, 0, 0, absurd_param, 0, 0, 100, NULL, NULL, 0, true, false},
    {"32 weights NaN or 1e9", 'A', 0.06, EVER, EVER, 0, 0, bad_weights, 0, 0, 100, fixed_curve, NULL, 0, true,
     false},
    {"33 torn weights", 'N', 0.06, 0.007, 0.007, 0, 0, torn_weights, 0, 0, 100, fixed_curve, NULL, 0, true,
     false},
    {"34 covariance broken", 'A', 0.06, 0.1, 0.1, 0, 0, broken_covariance, 0, 0, 99.9, NULL, NULL, 1.0, false,
     false},
    {"37 curve at -5", 'A', 0.06, EVER, EVER, 0, 0, zero_curve, 0, 0, 100, fixed_curve, adds_no_step, 0,
     false, false},
    {"43 missed or doubled calls", 'A', 0.06, 0.001, 0.05, 0, 0, missed_calls, 0, 0, 99.9, NULL, no_kick, 0,
     false, false},
    {"44 step counter wraps", 'A', 0.06, 0.1, 0.1, 0, 0, NULL, 0, 0, 100, wrapped, NULL, 0, true, false},
    {"49 started again in flight", 'N', 0.06, EVER, EVER, 0, 0, again, 0, 0, 100, NULL, as_fresh, 0, false,
     false},
    {"49 height let go and taken up again", 'N', 0.20, EVER, EVER, 0, 0, never_reset, 0, 0, 100, NULL, NULL,
     0, false, false},
    {"50 a bit of the learner flips", 'A', 0.06, 0.1, 0.1, 0, 0, bit_flip, 0, 0, 99.6, NULL, NULL, 1.0, false,
     false},
    {"50 any bit flips", 'A', 0.06, 0.1, 0.1, 0, 0, any_bit_flip, 0, 0, 98.8, NULL, NULL, 1.0, false, true},
};

static const char *no_drift(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  const float at_m = (float)c->row->gap_m;
  const float before = rbf_at(&c->weights, at_m).ratio,
              now = rbf_at(&c->pilot.flight->outer.learn.rls.theta, at_m).ratio;
  return fabsf(now - before) > 0.01f * before ? "drift" : NULL;
}
static const row_t long_row = {"35 ten minutes", 'N',      0.06, EVER,  EVER, 0, 0, NULL, 0, 0, 100,
                               for_ten_minutes,  no_drift, 0,    false, false};

rows_t faults_of_patience(void) {
  return (rows_t){&long_row, 1};
}

rows_t faults_of_state(void) {
  return (rows_t){rows, (int)(sizeof rows / sizeof *rows)};
}
