// test_formula_a6.c - the controller of the thesis's eq. A.6, as it is printed.
#include "flight/lpf2.h"
#include "rig/flights.h"
#include "rig/test.h"

// The printed eq. A.6 has lost the thrust T0 in front of the slope's sum, which makes K_v act 1/T0
// times as strongly. Written here and nowhere else; filters and motor model as in the other flights of
// appendix A.
typedef struct {
  lpf2_coef_t filter;
  lpf2_t acc, command;
  double thrust_N;
  float lead_s;
} printed_t;

static void printed_step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  printed_t *s = state;
  const double m = 0.032, z_m = in->pos_w_m.z, climb_mps = in->vel_w_mps.z, zc = 0.5 - z_m;
  double applied_N = 0.0;
  for (int i = 0; i < PILOT_MOTORS; i++) applied_N += in->applied_N[i];
  const double acc = (double)lpf2_step(&s->acc, &s->filter, (float)(in->acc_b_mps2.z - 9.81));
  const double command = (double)lpf2_step(&s->command, &s->filter, (float)applied_N);
  s->thrust_N += (1.0 - exp(-0.16)) * (command - s->thrust_N);
  const double excess = zc < 0.1 ? 0.44 * exp(-80.0 * zc) : 0.0;
  const double wanted = 5.0 * (in->set.pos_w_m.z - z_m - climb_mps);
  const double slope_term = 1.0 / m * -80.0 * excess * (double)s->lead_s * climb_mps; // T0 is missing
  for (int i = 0; i < PILOT_MOTORS; i++)
    motor_N[i] = 0.25 * (s->thrust_N + m / (1.0 + excess) * (wanted - acc + slope_term));
}

static void printed_reset(void *state) {
  (void)state;
}

TEST(formula_a6_as_printed_is_as_slow_as_a_lead_of_one_second) {
  static const struct {
    float cutoff_Hz;
    double t90_s;
  } row[] = {{0.0f, 10.85}, {8.0f, 10.59}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g Hz", (double)row[i].cutoff_Hz);
    printed_t state = {.lead_s = 0.3f};
    CHECK_OK(lpf2_tune(&state.filter, row[i].cutoff_Hz, 100.0f));
    const pilot_t printed = {.state = &state, .step = printed_step, .reset = printed_reset};
    const setup_t setup = flights_appendix_a(FLY_INDI_THEORY, row[i].cutoff_Hz, 0.3f, true);
    const segment_t last = flights_last_by(&setup, &printed, NULL);
    CHECK_NEAR(last.overshoot_mm, 0.0, 0.05);
    CHECK_NEAR(last.t90_s, row[i].t90_s, 0.02);
    CHECK(isnan(last.settle_1mm_s));
  }
}
