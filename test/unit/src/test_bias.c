// test_bias.c - the bias of the accelerometer, alone and behind the estimator.
#include "flight/bias.h"
#include "flight/setup.h"
#include "rig/test.h"

#include "base/random.h"

#include <string.h>

static const v3_t NONE = {0, 0, 0};

static status_t step_of(bias_t *s, const bias_param_t *p, v3_t acc_mps2, v3_t pos_m, v3_t vel_mps,
                        float period_s) {
  bias_coef_t c;
  bias_tune(&c, p, period_s);
  return bias_step(s, p, &c, acc_mps2, pos_m, vel_mps);
}

static bias_t started(void) {
  bias_t s;
  bias_start(&s, NONE, NONE);
  return s;
}

// A vehicle that stands still and feels acc_mps2 for so many steps.
static void stand(bias_t *s, const bias_param_t *p, v3_t acc_mps2, float period_s, int steps) {
  for (int k = 0; k < steps; k++) CHECK_OK(step_of(s, p, acc_mps2, NONE, NONE, period_s));
}

TEST(bias_is_found_as_fast_as_three_lags_at_its_pole) {
  static const struct {
    float pole_radps, period_s;
  } row[] = {{1.0f, 0.01f}, {5.0f, 0.01f}, {10.0f, 0.01f}, {10.0f, 0.002f}, {0.5f, 0.05f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    const bias_param_t p = {.pole_radps = row[i].pole_radps, .max_mps2 = 0.5f};
    const double w = (double)p.pole_radps, dt = (double)row[i].period_s;
    bias_t s = started();
    for (int k = 1; k * dt * w < 12.0; k++) {
      ROW("pole %g rad/s, every %g s, after %g s", w, dt, k * dt);
      stand(&s, &p, (v3_t){0, -0.2f, 0.1f}, row[i].period_s, 1);
      const double x = w * dt * (k + 0.5), share = 1.0 - exp(-x) * (1.0 + x + 0.5 * x * x); // of held inputs
      CHECK_NEAR(s.bias_mps2.z, 0.1 * share, 0.1 * 0.2 * w * dt);
      CHECK_NEAR(s.bias_mps2.y, -0.2 * share, 0.2 * 0.2 * w * dt);
    }
    CHECK_NEAR(s.bias_mps2.z, 0.1, 1e-4);
    CHECK_NEAR(s.bias_mps2.y, -0.2, 2e-4);
    CHECK(s.bias_mps2.x == 0.0f);
  }
}

TEST(bias_is_found_without_overshoot_at_any_pole_and_any_interval) {
  // Euler's rule over the interval diverged at pole 10 from 30 ms on, at pole 5 from 50 ms on.
  static const float poles[] = {0.05f, 1.0f, 5.0f, 10.0f, 1000.0f}, periods[] = {0.001f, 0.03f, 0.05f, 0.1f};
  for (unsigned i = 0; i < 5; i++)
    for (unsigned j = 0; j < 4; j++) {
      const bias_param_t p = {.pole_radps = poles[i], .max_mps2 = 0.5f, .vel_s = 0.5f};
      bias_t s = started();
      float least = 0.0f;
      for (int k = 0; (float)k * periods[j] * poles[i] < 15.0f || k < 20; k++) {
        ROW("pole %g rad/s, every %g s, step %d", (double)poles[i], (double)periods[j], k);
        stand(&s, &p, (v3_t){.z = 0.1f}, periods[j], 1);
        if (!CHECK(s.bias_mps2.z >= least - 1e-6f && s.bias_mps2.z <= 0.1f + 1e-6f)) break;
        least = s.bias_mps2.z;
      }
      CHECK_NEAR(s.bias_mps2.z, 0.1, 1e-3);
    }
}

TEST(bias_stays_in_its_bound_whatever_the_pole_the_interval_and_the_inputs) {
  random_t *r = random_open(5);
  bias_t s = started();
  for (int k = 0; k < 200000; k++) {
    const bias_param_t p = {.pole_radps = (float)pow(10.0, random_uniform(r, -30.0, 1.0)),
                            .max_mps2 = (float)random_uniform(r, 0.0, 5.0),
                            .vel_s = (float)pow(10.0, random_uniform(r, -38.0, 1.0))};
    const float period_s = (float)pow(10.0, random_uniform(r, -3.0, 1.0));
    const v3_t acc = {(float)(100.0 * random_normal(r)), (float)(1.0 * random_normal(r)), 1000.0f};
    const v3_t pos = {(float)(1.0 * random_normal(r)), 0.0f, (float)(3000.0 * random_normal(r))};
    const v3_t vel = {(float)(3.0 * random_normal(r)), (float)(0.1 * random_normal(r)), 20.0f};
    if (!CHECK_OK(step_of(&s, &p, acc, pos, vel, period_s))) return;
    if (!CHECK(v3_within(s.bias_mps2, 5.0f) && v3_within(s.vel_off_mps, BIAS_JUMP_MPS))) return;
  }
  random_close(r);
  const bias_param_t p = {.pole_radps = 1.0f, .max_mps2 = 0.3f, .vel_s = 0.5f};
  stand(&s, &p, NONE, 0.01f, 1); // a lower bound acts at once
  CHECK(v3_within(s.bias_mps2, 0.3f));
  stand(&s, &p, NONE, 0.01f, 2000);
  CHECK(v3_within(s.bias_mps2, 1e-3f) && v3_within(s.vel_off_mps, 1e-3f));
}

TEST(bias_takes_no_motion_for_one) {
  static const struct {
    float pole_radps, period_s;
    double worst_mps2; // the acceleration is felt half an interval before the position shows it
  } row[] = {{1.0f, 0.01f, 0.005}, {5.0f, 0.01f, 0.03}, {1.0f, 0.05f, 0.03}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("pole %g rad/s, every %g s", (double)row[i].pole_radps, (double)row[i].period_s);
    const bias_param_t p = {.pole_radps = row[i].pole_radps, .max_mps2 = 0.5f, .vel_s = 0.5f};
    const double dt = (double)row[i].period_s;
    bias_t s;
    bias_start(&s, (v3_t){0, 0, 0.5f}, NONE);
    double z = 0.5, v = 0.0, worst = 0.0, off = 0.0;
    for (double t = 0.0; t < 30.0; t += dt) {
      const double a = sin(1.3 * t) + (fmod(t, 7.0) < 1.0 ? 1.0 : fmod(t, 7.0) < 2.0 ? -1.0 : 0.0);
      CHECK_OK(step_of(&s, &p, (v3_t){.z = (float)a}, (v3_t){.z = (float)z}, (v3_t){.z = (float)v},
                       row[i].period_s));
      z += dt * v + 0.5 * dt * dt * a;
      v += dt * a;
      worst = fmax(worst, fabs((double)s.bias_mps2.z));
      off = fmax(off, fabs((double)s.vel_off_mps.z));
    }
    CHECK(worst < row[i].worst_mps2);
    CHECK(off < 0.55 * dt * 2.0); // half an interval of 2 m/s2
  }
}

TEST(bias_finds_what_the_velocity_is_wrong_by) {
  static const bias_param_t p = {.pole_radps = 1.0f, .max_mps2 = 0.5f, .vel_s = 0.5f};
  bias_t s;
  bias_start(&s, (v3_t){.x = -0.01f}, (v3_t){.x = 1.0f});
  for (int k = 0; k <= 250; k++) { // at 1 m/s
    CHECK_OK(step_of(&s, &p, NONE, (v3_t){.x = 0.01f * (float)k}, (v3_t){.x = 1.05f, .z = -0.1f}, 0.01f));
    const double share = 1.0 - exp(-0.01 * (k + 1) / 0.5);
    CHECK_NEAR(s.vel_off_mps.x, 0.05 * share, 1e-4);
    CHECK_NEAR(bias_free_velocity(&s, (v3_t){.z = -0.1f}).z, -0.1 * (1.0 - share), 1e-5);
  }
  const bias_param_t off = {.pole_radps = 1.0f, .max_mps2 = 0.5f, .vel_s = 0.0f};
  CHECK_OK(step_of(&s, &off, NONE, (v3_t){.x = 2.51f}, (v3_t){.x = 1.05f}, 0.01f));
  CHECK(s.vel_off_mps.x == 0.0f && s.vel_off_mps.y == 0.0f && s.vel_off_mps.z == 0.0f);
}

TEST(bias_learns_nothing_of_a_gap_or_a_jump) {
  static const struct {
    const char *what;
    float period_s, moved_m;
    bool learns;
  } row[] = {{"0.3 m in 2 s without a call", 2.0f, 0.3f, false}, // was the bound, -0.5 m/s2
             {"a little longer than a gap", 0.101f, 0.3f, false},
             {"not quite a gap", 0.099f, 0.3f, true},
             {"a jump of 5.1 cm", 0.01f, 0.051f, false},
             {"back by 5.1 cm", 0.01f, -0.051f, false},
             {"a move of 4.9 cm", 0.01f, 0.049f, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    static const bias_param_t p = {.pole_radps = 1.0f, .max_mps2 = 0.5f, .vel_s = 0.5f};
    bias_t s = started();
    stand(&s, &p, (v3_t){.z = 0.1f}, 0.01f, 2000);
    const v3_t there = {.z = row[i].moved_m};
    CHECK_OK(step_of(&s, &p, (v3_t){.z = 0.1f}, there, NONE, row[i].period_s));
    float worst = 0.0f;
    for (int k = 0; k < 1000; k++) {
      CHECK_OK(step_of(&s, &p, (v3_t){.z = 0.1f}, there, NONE, 0.01f));
      worst = f_max(fabsf(s.bias_mps2.z - 0.1f), worst);
    }
    CHECK((worst > 5e-3f) == row[i].learns);
  }
}

TEST(bias_goes_on_after_a_gap_with_the_velocity_of_then) {
  static const bias_param_t p = {.pole_radps = 5.0f, .max_mps2 = 0.5f, .vel_s = 0.5f};
  bias_t s = started();
  stand(&s, &p, (v3_t){.z = 0.1f}, 0.01f, 1000);
  for (int k = 1; k <= 50; k++) { // it starts to climb with 2 m/s2
    const float t_s = 0.01f * (float)k;
    CHECK_OK(step_of(&s, &p, (v3_t){.z = 2.1f}, (v3_t){.z = t_s * t_s}, (v3_t){.z = 2.0f * t_s}, 0.01f));
  }
  CHECK_NEAR(s.bias_mps2.z, 0.1, 0.02); // the climb begins between two samples
  float z_m = 2.25f;                    // and is found at 1 m/s
  CHECK_OK(step_of(&s, &p, (v3_t){.z = 0.1f}, (v3_t){.z = z_m}, (v3_t){.z = 1.0f}, 2.0f));
  for (int k = 0; k < 500; k++) {
    z_m += 0.01f;
    CHECK_OK(step_of(&s, &p, (v3_t){.z = 0.1f}, (v3_t){.z = z_m}, (v3_t){.z = 1.0f}, 0.01f));
    if (!CHECK_NEAR(s.bias_mps2.z, 0.1, 0.02)) return;
  }
}

TEST(bias_shifts_with_the_origin) {
  static const bias_param_t p = {.pole_radps = 5.0f, .max_mps2 = 0.5f, .vel_s = 0.5f};
  bias_t s = started();
  const v3_t by_m = {0.02f, -0.03f, 0.04f};
  bias_shift(&s, by_m);
  for (int k = 0; k < 100; k++) CHECK_OK(step_of(&s, &p, NONE, by_m, NONE, 0.01f));
  CHECK(v3_within(s.bias_mps2, 1e-6f) && v3_within(s.vel_off_mps, 1e-6f));
}

TEST(bias_starts_afresh_where_its_state_is_none) {
  static const bias_param_t p = {.pole_radps = 1.0f, .max_mps2 = 0.5f, .vel_s = 0.5f};
  static const float odd[] = {NAN, INFINITY, -INFINITY, 3e38f, 1e6f};
  for (size_t at = 0; at < sizeof(bias_t); at += sizeof(float))
    for (unsigned i = 0; i < sizeof odd / sizeof *odd; i++) {
      ROW("float %zu is %g", at / sizeof(float), (double)odd[i]);
      bias_t s = started();
      stand(&s, &p, (v3_t){.z = 0.1f}, 0.01f, 2000);
      memcpy((char *)&s + at, &odd[i], sizeof(float));
      const bool place = at >= offsetof(bias_t, pos_last_m) && at < offsetof(bias_t, acc_slow_mps2);
      // A place that is none is a jump: nothing is lost.
      CHECK_STATUS(place ? ST_OK : ST_BAD_STATE, step_of(&s, &p, (v3_t){.z = 0.1f}, NONE, NONE, 0.01f));
      CHECK_NEAR(s.bias_mps2.z, place ? 0.1 : 0.0, 1e-4);
      CHECK(v3_within(s.vel_off_mps, 1e-4f));
      stand(&s, &p, (v3_t){.z = 0.1f}, 0.01f, 1500);
      CHECK_NEAR(s.bias_mps2.z, 0.1, 1e-3);
    }
}

TEST(bias_takes_a_state_for_one_up_to_2000) {
  static const bias_param_t p = {.pole_radps = 1.0f, .max_mps2 = 0.5f};
  bias_t s = started();
  s.first_mps2.x = 1999.0f;
  CHECK_OK(step_of(&s, &p, NONE, NONE, NONE, 0.01f));
  s = started();
  s.first_mps2.x = 2001.0f;
  CHECK_STATUS(ST_BAD_STATE, step_of(&s, &p, NONE, NONE, NONE, 0.01f));
}

TEST(bias_is_bounded_and_off_when_its_pole_is_zero) {
  bias_t s = started();
  const bias_param_t bounded = {.pole_radps = 1.0f, .max_mps2 = 0.3f},
                     off = {.pole_radps = 0.0f, .max_mps2 = 0.3f};
  stand(&s, &bounded, (v3_t){-5.0f, -5.0f, 5.0f}, 0.01f, 3000);
  CHECK_NEAR(s.bias_mps2.z, 0.3, 1e-5);
  CHECK_NEAR(s.bias_mps2.y, -0.3, 1e-5);
  CHECK_NEAR(s.bias_mps2.x, -0.3, 1e-5);
  stand(&s, &bounded, NONE, 0.01f, 1200); // of the 5 m/s2 no more is left than one lag keeps
  CHECK_NEAR(s.bias_mps2.z, 0.0, 0.02);
  stand(&s, &bounded, (v3_t){.z = 5.0f}, 0.01f, 100);
  stand(&s, &off, (v3_t){.z = 5.0f}, 0.01f, 1);
  CHECK(s.bias_mps2.z == 0.0f && s.vel_off_mps.z == 0.0f);
}

TEST(bias_behind_the_estimator_leaves_a_millimetre_of_two_centimetres) {
  // 0.01 g: -(b/Kd + 0.153 b)/Kp - 0.0122 b is 3.6 cm with the thesis's gains, 1.5 cm with those that ship;
  // with the bias found only what the estimator's height itself is wrong by stays.
  for (int on = 0; on < 2; on++) {
    ROW("bias %s", on ? "found" : "not looked for");
    setup_t setup;
    why_t why;
    CHECK_OK(setup_thesis(&setup, FLY_INDI, &why));
    const request_t nothing = {.integrate = INTEGRATE_RK4, .no_effects = true};
    CHECK_OK(setup_apply(&setup, &nothing, &why));
    const double gap_m[] = {0.15};
    setup_ladder(&setup, gap_m, 1, 0.0);
    setup.plan.below_estimate = false; // the height itself is judged
    setup.plan.end_s = 25.0;
    setup.plan.noise = *noise_find("quiet");
    setup.plan.noise.imu.acc_bias_b_mps2.z = 0.0981;
    setup.flight.bias.pole_radps = on ? 1.0f : 0.0f;
    flown_t flown;
    if (!CHECK_OK(setup_fly(&setup, &flown, &why))) continue;
    CHECK_NEAR(flown.segment[0].mean_error_mm, on ? -1.2 : -14.8, on ? 1.5 : 1.5);
    flown_free(&flown);
  }
}
