// test_att_indi_step.c - single steps of the inner loop: start, bound of the rates, memory of the yaw,
// reference.
#include "flight/att_indi.h"
#include "flight/bounds.h"
#include "flight/params.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <math.h>

#define TICK_S 0.002f
#define G2_S   0.029f

typedef struct {
  att_indi_t att;
  flight_param_t param;
  lpf2_coef_t filter;
} loop_t;

static loop_t fresh(float cutoff_Hz) {
  loop_t l;
  params_default(&l.param);
  l.param.att.g2_s = G2_S;
  CHECK_OK(lpf2_tune(&l.filter, cutoff_Hz, 1.0f / TICK_S));
  att_indi_reset(&l.att);
  return l;
}

TEST(inner_loop_takes_over_a_turn_without_a_kick) {
  // What turns already has not begun to turn now: 3 rad/s in one period would be 1500 rad/s2.
  loop_t l = fresh(20.0f);
  const att_indi_in_t in = {
      .rate_b_radps = {3.0f, -3.0f, 3.0f}, .q_wb = {1, 0, 0, 0}, .q_ref = {1, 0, 0, 0}, .ratio = 1};
  const v3_t torque = att_indi_step(&l.att, &l.param.att, &l.filter, 0.03f, TICK_S, &in);
  const att_indi_param_t *p = &l.param.att;
  CHECK_NEAR(torque.x, -3.0f * p->quick * p->inertia_xx_kgm2 * p->kd_per_s, 1e-7);
  CHECK_NEAR(torque.y, 3.0f * p->quick * p->inertia_yy_kgm2 * p->kd_per_s, 1e-7);
  CHECK_NEAR(torque.z, -3.0f * p->quick * p->inertia_zz_kgm2 * p->kd_yaw_per_s / (1.0f + G2_S / TICK_S),
             1e-7);
}

TEST(inner_loop_wants_no_rate_beyond_its_bound) {
  static const struct {
    const char *what;
    quat_t q_ref;
    float yaw_rate_radps;
    v3_t want; // of the bound
  } row[] = {{"roll", {0.866f, 0.5f, 0, 0}, 0, {1, 0, 0}},
             {"roll, the other way", {0.866f, -0.5f, 0, 0}, 0, {-1, 0, 0}},
             {"pitch", {0.866f, 0, 0.5f, 0}, 0, {0, 1, 0}},
             {"yaw", {0.866f, 0, 0, 0.5f}, 0, {0, 0, 1}},
             {"yaw rate", {1, 0, 0, 0}, -30, {0, 0, -1}}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    loop_t l = fresh(0.0f);
    l.param.att.rate_max_radps = 1.5f;
    const att_indi_in_t in = {
        .q_wb = {1, 0, 0, 0}, .q_ref = row[i].q_ref, .yaw_rate_radps = row[i].yaw_rate_radps, .ratio = 1};
    const v3_t torque = att_indi_step(&l.att, &l.param.att, &l.filter, 0.03f, TICK_S, &in);
    const att_indi_param_t *p = &l.param.att;
    const float most = 1.5f * p->quick;
    CHECK_NEAR(torque.x, row[i].want.x * most * p->inertia_xx_kgm2 * p->kd_per_s, 1e-8);
    CHECK_NEAR(torque.y, row[i].want.y * most * p->inertia_yy_kgm2 * p->kd_per_s, 1e-8);
    CHECK_NEAR(torque.z, row[i].want.z * most * p->inertia_zz_kgm2 * p->kd_yaw_per_s / (1.0f + G2_S / TICK_S),
               1e-8);
  }
}

TEST(inner_loop_does_about_y_what_it_does_about_x) {
  // The same story told about each axis, through what is held against, the bounds and the ceiling's term.
  loop_t about_x = fresh(20.0f), about_y = fresh(20.0f);
  about_x.param.att.inertia_yy_kgm2 = about_x.param.att.inertia_xx_kgm2;
  about_y.param.att = about_x.param.att;
  splitmix_t r = {7};
  for (int i = 0; i < 2000; i++) {
    const float rate = (float)splitmix_normal(&r, 2.0), torque_Nm = (float)splitmix_normal(&r, 2e-3);
    const float half = (float)splitmix_normal(&r, 0.2), ceiling_Nms = i % 3 ? -1e-5f * (float)(i % 50) : 0.0f;
    att_indi_in_t in = {.q_wb = {1, 0, 0, 0}, .ceiling_Nms = ceiling_Nms, .ratio = 1.1f, .trim_Nm = 1e-3f};
    in.rate_b_radps.x = rate, in.torque_b_Nm.x = torque_Nm,
    in.q_ref = (quat_t){sqrtf(1.0f - half * half), half, 0, 0};
    const v3_t x = att_indi_step(&about_x.att, &about_x.param.att, &about_x.filter, 0.03f, TICK_S, &in);
    in.rate_b_radps = (v3_t){.y = rate}, in.torque_b_Nm = (v3_t){.y = torque_Nm},
    in.q_ref = (quat_t){in.q_ref.w, 0, half, 0};
    const v3_t y = att_indi_step(&about_y.att, &about_y.param.att, &about_y.filter, 0.03f, TICK_S, &in);
    if (!CHECK(x.x == y.y && x.y == y.x)) break;
  }
}

TEST(inner_loop_gives_up_what_is_held_against_beyond_its_trim_about_each_axis) {
  // Torque that is applied for long and turns nothing: something holds the vehicle.
  const v3_t applied = {2e-3f, -3e-3f, 1e-3f};
  v3_t torque[2];
  for (int bounded = 0; bounded < 2; bounded++) {
    loop_t l = fresh(20.0f);
    const float trim_Nm = bounded ? 5e-4f : 1.0f;
    const att_indi_in_t in = {.q_wb = {1, 0, 0, 0},
                              .q_ref = {1, 0, 0, 0},
                              .torque_b_Nm = applied,
                              .ratio = 1,
                              .trim_Nm = trim_Nm,
                              .trim_yaw_Nm = trim_Nm};
    for (int i = 0; i < 500; i++)
      torque[bounded] = att_indi_step(&l.att, &l.param.att, &l.filter, 0.03f, TICK_S, &in);
  }
  CHECK_NEAR(torque[0].x, 2e-3, 1e-7);
  CHECK_NEAR(torque[1].x, 5e-4, 1e-7);
  CHECK_NEAR(torque[0].y, -3e-3, 1e-7);
  CHECK_NEAR(torque[1].y, -5e-4, 1e-7);
  CHECK_NEAR(torque[0].z, 1e-3, 1e-7);
  CHECK_NEAR(torque[1].z, 1e-3 - 5e-4 / (1.0 + (double)(G2_S / TICK_S)), 1e-7);
}

// While it grows, the rotors' inertia gives g times the growth besides: that is held against, too.
TEST(inner_loop_takes_the_torque_of_the_rotors_inertia_for_held_where_nothing_turns) {
  const float share = 0.03f, applied_Nm = 1e-3f, trim_Nm = 1e-4f, g = G2_S / TICK_S;
  float yaw_Nm[2];
  for (int bounded = 0; bounded < 2; bounded++) {
    loop_t l = fresh(0.0f);
    att_indi_in_t in = {.q_wb = {1, 0, 0, 0}, .q_ref = {1, 0, 0, 0}, .ratio = 1, .trim_Nm = 1.0f};
    in.trim_yaw_Nm = bounded ? trim_Nm : 1.0f;
    for (int k = 0; k < 2; k++) {
      in.torque_b_Nm.z = k ? applied_Nm : 0.0f;
      yaw_Nm[bounded] = att_indi_step(&l.att, &l.param.att, &l.filter, share, TICK_S, &in).z;
    }
  }
  const float held_Nm = (1.0f + g) * share * applied_Nm;
  CHECK_NEAR(yaw_Nm[0] - yaw_Nm[1], (held_Nm - trim_Nm) / (1.0f + g), 1e-9);
}

TEST(inner_loop_remembers_the_yaw_that_was_applied_not_the_one_it_wanted) {
  // Mixing gave all of the yaw up, five times: the next increment is the first one again.
  loop_t l = fresh(0.0f);
  const att_indi_in_t in = {.q_wb = {1, 0, 0, 0}, .q_ref = {0.995f, 0, 0, 0.0998f}, .ratio = 1};
  v3_t torque[5];
  for (int k = 0; k < 5; k++) torque[k] = att_indi_step(&l.att, &l.param.att, &l.filter, 0.03f, TICK_S, &in);
  CHECK(torque[0].z > 1e-6f);
  for (int k = 1; k < 5; k++) CHECK_NEAR(torque[k].z, torque[0].z, 1e-10);
}

TEST(inner_loop_takes_the_shorter_way_whatever_the_sign_of_the_quaternions) {
  for (int signs = 0; signs < 4; signs++) {
    ROW("signs %d", signs);
    const float a = signs & 1 ? -1.0f : 1.0f, b = signs & 2 ? -1.0f : 1.0f;
    const v3_t e = att_indi_error(&(quat_t){.w = a}, &(quat_t){.w = b * 0.995f, .z = b * 0.0998f});
    CHECK_NEAR(e.z, 0.1996, 1e-4);
    CHECK(e.x == 0.0f && e.y == 0.0f);
  }
}

TEST(attitude_reference_points_the_thrust_and_the_nose) {
  for (int deg = -175; deg <= 180; deg += 5) {
    ROW("%d deg", deg);
    const double yaw = deg * 3.14159265358979 / 180.0;
    const sincos_t heading = {(float)sin(yaw), (float)cos(yaw)};
    const v3_t up = {0.2f, -0.1f, sqrtf(0.95f)};
    const quat_t q = att_indi_reference(up, heading);
    const v3_t got = quat_up(q),
               level = quat_to_world(att_indi_reference((v3_t){0, 0, 1}, heading), (v3_t){1, 0, 0});
    CHECK_NEAR(quat_dot(q, q), 1.0, 1e-5);
    CHECK_NEAR(got.x, up.x, 1e-5);
    CHECK_NEAR(got.y, up.y, 1e-5);
    CHECK_NEAR(level.x, cos(yaw), 1e-5);
    CHECK_NEAR(level.y, sin(yaw), 1e-5);
  }
}

TEST(inner_loop_knows_a_state_that_can_be) {
  loop_t l = fresh(20.0f);
  att_indi_in_t in = {.q_wb = {1, 0, 0, 0}, .q_ref = {1, 0, 0, 0}, .ratio = 1};
  ROW("after the wildest rates that are taken");
  for (int k = 0; k < 300; k++) {
    const float to = k % 2 ? -BOUND_RATE_RADPS : BOUND_RATE_RADPS;
    in.rate_b_radps = (v3_t){to, to, to};
    (void)att_indi_step(&l.att, &l.param.att, &l.filter, 0.03f, TICK_S, &in);
    CHECK(att_indi_good(&l.att));
  }
  static const struct {
    float state;
    bool good;
  } row[] = {{0.9e6f, true}, {1.1e6f, false}, {-1.1e6f, false}, {1e30f, false}, {NAN, false}};
  att_indi_t s;
  float *const at[] = {
      &s.acc[0].y1, &s.acc[2].x2, &s.torque[1].y1, &s.torque[2].x1, &s.torque_model_Nm.y,
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (unsigned k = 0; k < sizeof at / sizeof *at; k++) {
      ROW("state %u is %g", k, (double)row[i].state);
      att_indi_reset(&s);
      *at[k] = row[i].state;
      CHECK(att_indi_good(&s) == row[i].good);
    }
}
