// test_flight_height_lost.c - a height that is reset again and again: how far it is taken out, and what then.
#include "rig/hover6.h"
#include "rig/test.h"

static const struct {
  const char *what;
  int jumps;
  double by_m, every_s;
  bool back, goes_down; // back: every second jump is back
} jumped[] = {
    {"one of 30 cm", 1, 0.3, 0.2, false, false},
    {"nine of 10 cm", 9, 0.1, 0.2, false, false},
    {"20 of 10 cm in 4 s", 20, 0.1, 0.2, false, true}, // was 2 m off without a reason
    {"20 of -10 cm in 4 s", 20, -0.1, 0.2, false, true},
    {"300 of 0.5 m in 15 s", 300, 0.5, 0.05, false, true},
    {"300 of 0.5 m there and back", 300, 0.5, 0.05, true, false},
    {"50 m for 0.2 s", 2, 50.0, 0.2, true, false},
    {"50 m for 0.4 s", 2, 50.0, 0.4, true, true},
};

// Let go and taken up again, the height is a new one.
static void take_up_again(hover6_t *r) {
  r->in.set.mode[0] = r->in.set.mode[1] = r->in.set.mode[2] = PILOT_OFF;
  r->in.set.thrust_N = 0.32;
  hover6_fly(r, 0.02);
  for (int k = 0; k < 3; k++) r->in.set.mode[k] = PILOT_POSITION;
  r->in.set.pos_w_m = hover6_pos_m(r);
  r->in.set.pos_w_m.z += r->height_off_m;
  hover6_fly(r, 0.5);
}

TEST(flight_goes_down_where_resets_of_the_height_sum_up) {
  for (unsigned i = 0; i < sizeof jumped / sizeof *jumped; i++) {
    ROW("%s", jumped[i].what);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    r.in.set.pos_w_m.z = r.body.y[RIGID_POS_M + 2] = 5.0;
    hover6_fly(&r, 1.0);
    double highest_m = 0.0, most_N = 0.0;
    for (int k = 0; k < jumped[i].jumps; k++) {
      r.height_off_m += jumped[i].back && k % 2 == 1 ? -jumped[i].by_m : jumped[i].by_m;
      hover6_fly(&r, jumped[i].every_s);
      highest_m = fmax(highest_m, hover6_pos_m(&r).z);
      for (int m = 0; m < 4; m++) most_N = fmax(most_N, r.in.applied_N[m]);
    }
    hover6_fly(&r, 1.0);
    const guard_t *g = &r.flight.flight->guard;
    CHECK(((g->latched & GUARD_HEIGHT_LOST) != 0) == jumped[i].goes_down);
    CHECK((g->action == GUARD_RETREAT) == jumped[i].goes_down);
    CHECK((g->latched & GUARD_HEIGHT_JUMP) != 0);
    if (jumped[i].goes_down)
      CHECK(hover6_pos_m(&r).z < 4.9);
    else
      CHECK_NEAR(hover6_pos_m(&r).z, 5.0, 0.02);
    CHECK(highest_m < 5.05);
    CHECK(most_N < 1.3 * 0.08); // no pulse of thrust
    take_up_again(&r);
    CHECK((g->now & ~(unsigned)GUARD_RANGE_ODD) == 0); // nothing comes from the range sensor here
    CHECK(g->action == GUARD_FLY);
    CHECK_NEAR(r.flight.flight->height_off_m, 0.0, 0.0);
    body_close(&r.body);
  }
}

// A clipped accelerometer is replaced by what the thrust does; the bias that the outer loop takes off must be
// in it.
TEST(flight_holds_its_height_where_an_accelerometer_with_a_bias_is_lost) {
  static const double bias_mps2[] = {0.0, 0.45, -0.45};
  for (unsigned i = 0; i < sizeof bias_mps2 / sizeof *bias_mps2; i++) {
    ROW("bias %g m/s2", bias_mps2[i]);
    hover6_t r = {.in = {.step = 0}};
    hover6_start(&r, 0.0);
    hover6_fly(&r, 2.0);
    r.acc_bias_b_mps2.z = bias_mps2[i];
    hover6_fly(&r, 10.0);
    const double z_m = hover6_pos_m(&r).z;
    double worst_m = 0.0;
    for (int k = 0; k < 500; k++) {
      r.acc_bias_b_mps2.z = k < 250 ? 300.0 : bias_mps2[i]; // beyond 20 g for half a second
      r.acc_bias_b_mps2.z += k % 2 ? 0.05 : -0.05;          // not frozen
      hover6_fly(&r, 0.002);
      worst_m = fmax(worst_m, fabs(hover6_pos_m(&r).z - z_m));
    }
    ROW("bias %g m/s2: %g mm off", bias_mps2[i], 1e3 * worst_m);
    CHECK(worst_m < 0.005);
    body_close(&r.body);
  }
}
