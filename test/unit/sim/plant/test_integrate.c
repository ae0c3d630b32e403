// test_integrate.c - SUNDIALS and the step by hand against each other and against what is known exactly.
#include "plant/integrate.h"
#include "rig/test.h"

typedef struct {
  double input, pole;
} lag_t;

static void lag_derivative(void *self, const double *y, double *dydt) {
  const lag_t *lag = self;
  dydt[0] = y[1];
  dydt[1] = lag->pole * (lag->input - y[1]) - sin(y[0]);
}

static ode_t lag_ode(lag_t *lag) {
  return (ode_t){.n = 2, .derivative = lag_derivative, .context = lag, .step_s = 0.002};
}

// The state after 10 s with an input that changes every 10 ms.
static void run(integrate_kind_t kind, double y[2]) {
  lag_t lag = {.pole = 16.0};
  const ode_t ode = lag_ode(&lag);
  integrate_t *i;
  y[0] = y[1] = 0.0;
  if (!CHECK_OK(integrate_open(&i, kind, &ode))) return;
  for (int tick = 0; tick < 1000; tick++) {
    lag.input = sin(0.7 * tick) + (tick % 7 > 3 ? 1.0 : -1.0);
    CHECK(integrate_to(i, y, 0.01));
  }
  integrate_close(i);
}

TEST(integrators_agree_after_ten_seconds_of_held_inputs) {
  double sundials[2], by_hand[2], reference[2];
  run(INTEGRATE_SUNDIALS, sundials);
  run(INTEGRATE_RK4, by_hand);
  run(INTEGRATE_REFERENCE, reference);
  for (int i = 0; i < 2; i++) {
    ROW("state %d", i);
    CHECK_NEAR(sundials[i], by_hand[i], 1e-12);  // the same method
    CHECK_NEAR(sundials[i], reference[i], 1e-8); // error of the fixed step; a missing reset gives 1e-3
  }
}

TEST(integrators_take_a_changed_input_from_the_first_instant) {
  // y' = input exactly: any use of the old input shows at full size.
  static const integrate_kind_t kinds[] = {INTEGRATE_SUNDIALS, INTEGRATE_RK4, INTEGRATE_REFERENCE};
  for (int k = 0; k < 3; k++) {
    ROW("kind %d", k);
    lag_t lag = {.pole = 1e3};
    const ode_t ode = lag_ode(&lag);
    integrate_t *i;
    double y[2] = {0.0, 0.0};
    if (!CHECK_OK(integrate_open(&i, kinds[k], &ode))) continue;
    lag.input = 0.0;
    (void)integrate_to(i, y, 0.01);
    lag.input = 1.0;
    (void)integrate_to(i, y, 0.002);
    // Four stages of a step h = 2 ms at pole 1000: 1 - (1 - 2 + 2 - 4/3 + 2/3) of the step, exactly.
    if (kinds[k] != INTEGRATE_REFERENCE) CHECK_NEAR(y[1], 1.0 - 1.0 / 3.0, 1e-3);
    if (kinds[k] == INTEGRATE_REFERENCE) CHECK_NEAR(y[1], 1.0 - exp(-2.0), 1e-6);
    integrate_close(i);
  }
}

TEST(integrators_refuse_what_they_cannot_integrate) {
  lag_t lag = {.pole = 1.0};
  static const struct {
    const char *what;
    int n;
    double step_s;
  } row[] = {{"no state", 0, 0.002},
             {"too many", ODE_MAX + 1, 0.002},
             {"no step", 2, 0.0},
             {"step nan", 2, (double)NAN}};
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++) {
    ROW("%s", row[k].what);
    ode_t ode = lag_ode(&lag);
    ode.n = row[k].n;
    ode.step_s = row[k].step_s;
    integrate_t *i;
    CHECK_STATUS(BAD_INPUT, integrate_open(&i, INTEGRATE_SUNDIALS, &ode));
  }
}
