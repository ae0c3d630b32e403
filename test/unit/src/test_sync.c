// test_sync.c - signals through one and the same filter.
#include "flight/bounds.h"
#include "flight/sync.h"
#include "rig/test.h"

#include <math.h>

#define PERIOD_S 0.01f

static sync_coef_t coef(void) {
  sync_coef_t c;
  CHECK_OK(sync_tune(&c, 8.0f, 0.06f, PERIOD_S));
  return c;
}

static const sync_in_t HOVER = {
    .acc_b_mps2 = {0.0f, 0.0f, 9.81f}, .q_wb = {1.0f, 0.0f, 0.0f, 0.0f}, .thrust_N = 0.3f};

TEST(distance_that_comes_into_sight_starts_its_filter_afresh) {
  const sync_coef_t c = coef();
  sync_t s;
  sync_start(&s, &HOVER);
  ROW("first seen");
  CHECK_NEAR(sync_distance_m(&s, &c, true, 0.5f), 0.5, 1e-6);
  ROW("filtered from then on");
  const float next_m = sync_distance_m(&s, &c, true, 0.1f);
  CHECK(next_m > 0.4f && next_m < 0.5f);
  ROW("out of sight it is what was said");
  CHECK(sync_distance_m(&s, &c, false, 0.2f) == 0.2f);
  ROW("seen again");
  CHECK_NEAR(sync_distance_m(&s, &c, true, 0.3f), 0.3, 1e-6);
  ROW("seen at once after a new start");
  sync_start(&s, &HOVER);
  CHECK_NEAR(sync_distance_m(&s, &c, true, 0.05f), 0.05, 1e-6);
}

TEST(sync_starts_with_the_attitude_of_now_whatever_it_was_before) {
  const sync_coef_t c = coef();
  sync_t s, twin = {.distance_known = false};
  sync_in_t in = HOVER;
  sync_start(&twin, &in);
  s = twin;
  s.att_last = (quat_t){-1.0f, 0.0f, 0.0f, 0.0f}; // the same attitude with the other sign
  sync_start(&s, &in);
  for (int k = 0; k < 20; k++) {
    sync_out_t out, want;
    in.q_wb = quat_unit((quat_t){1.0f, 0.01f * (float)k, 0.0f, 0.0f});
    sync_step(&s, &c, &in, &out);
    sync_step(&twin, &c, &in, &want);
    ROW("step %d", k);
    CHECK(out.up_w.y == want.up_w.y && out.q_wb.w == want.q_wb.w);
  }
}

TEST(sync_knows_a_state_that_can_be) {
  const sync_coef_t c = coef();
  sync_in_t in = HOVER;
  sync_t s;
  sync_out_t out;
  sync_start(&s, &in);
  ROW("after the wildest inputs that are taken");
  for (int k = 0; k < 300; k++) {
    const float to = k / 20 % 2 ? -BOUND_ACC_MPS2 : BOUND_ACC_MPS2;
    in.acc_b_mps2 = (v3_t){to, to, to};
    in.q_wb = (quat_t){0.8804762f, -0.3279852f, 0.3279852f, 0.0f}; // the diagonal of the body stands upright
    in.thrust_N = BOUND_THRUST_N;
    sync_step(&s, &c, &in, &out);
    (void)sync_distance_m(&s, &c, true, 4.0f);
    CHECK(sync_good(&s));
  }
  static const struct {
    float state;
    bool good;
  } row[] = {{1.9e4f, true}, {2.1e4f, false}, {-2.1e4f, false}, {1e30f, false}, {NAN, false}};
  float *const at[] = {&s.acc_w[0].y1, &s.acc_w[2].x2,   &s.att[1].y1,     &s.att[3].x1,
                       &s.distance.y2, &s.thrust.lpf.y1, &s.thrust.model_N};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (unsigned k = 0; k < sizeof at / sizeof *at; k++) {
      ROW("state %u is %g", k, (double)row[i].state);
      sync_start(&s, &HOVER);
      s.distance_known = true;
      lpf2_reset(&s.distance, 0.1f);
      *at[k] = row[i].state;
      CHECK(sync_good(&s) == row[i].good);
    }
}

TEST(sync_does_not_judge_a_distance_that_is_out_of_sight) {
  const sync_coef_t c = coef();
  sync_t s;
  sync_start(&s, &HOVER);
  s.distance.y1 = NAN; // nothing would mend it
  CHECK(sync_good(&s));
  CHECK_NEAR(sync_distance_m(&s, &c, true, 0.3f), 0.3, 1e-6);
  CHECK(sync_good(&s));
}
