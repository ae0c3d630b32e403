// test_sync.c - signals through one and the same filter.
#include "flight/sync.h"
#include "rig/test.h"

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
