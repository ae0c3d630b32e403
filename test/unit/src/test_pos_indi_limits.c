// test_pos_indi_limits.c - the limits of the position law, and where it is singular.
#include "flight/pos_indi.h"
#include "rig/law.h"
#include "rig/test.h"

TEST(pos_indi_limits_the_thrust_and_says_so) {
  static const struct {
    const char *what;
    float thrust_N, step_N, want_N;
    bool at_limit;
  } row[] = {
      {"within", 0.3f, 0.1f, 0.4f, false},        {"just within", 0.3f, 0.2999f, 0.5999f, false},
      {"too much", 0.3f, 0.5f, 0.6f, true},       {"exactly the most", 0.6f, 0.0f, 0.6f, true},
      {"below nothing", 0.3f, -0.5f, 0.0f, true}, {"nothing", 0.0f, 0.0f, 0.0f, true},
      {"huge", 0.3f, 1e30f, 0.6f, true},          {"huge, downwards", 0.3f, -1e30f, 0.0f, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const pos_step_t step = {.thrust_N = row[i].step_N};
    const pos_command_t c = pos_indi_command(&law_param, (quat_t){1, 0, 0, 0}, row[i].thrust_N, step);
    CHECK_NEAR(c.thrust_N, row[i].want_N, 1e-6);
    CHECK(c.at_limit == row[i].at_limit);
  }
}

static double tilt_of(v3_t up) {
  return atan2(hypot((double)up.x, (double)up.y), (double)up.z);
}

TEST(pos_indi_limits_the_tilt_and_keeps_its_direction) {
  static const float tilt_max[] = {0.02f, 0.35f, 0.8f};
  for (unsigned i = 0; i < sizeof tilt_max / sizeof *tilt_max; i++)
    for (int k = 0; k < 36; k++)
      for (int m = 1; m <= 4; m++) {
        ROW("largest %g, asked for %d x that, towards %d deg", (double)tilt_max[i], m, 10 * k);
        pos_indi_param_t p = law_param;
        p.tilt_max_rad = tilt_max[i];
        // The step is the tangent of the tilt, from level.
        const double towards = LAW_PI / 18 * k, asked = 0.75 * m * (double)tilt_max[i];
        const double length = asked < 1.5 ? tan(asked) : 14.0;
        const pos_step_t step = {.pitch_rad = (float)(length * cos(towards)),
                                 .roll_rad = (float)(-length * sin(towards))};
        const v3_t up = pos_indi_command(&p, (quat_t){1, 0, 0, 0}, 0.3f, step).up_w;
        CHECK_NEAR(tilt_of(up), fmin(asked, (double)tilt_max[i]), 1e-5);
        CHECK_NEAR(v3_dot(up, up), 1.0, 1e-6);
        CHECK_NEAR((double)up.x * sin(towards) - (double)up.y * cos(towards), 0.0, 1e-6);
      }
}

TEST(pos_indi_stays_bounded_where_the_law_is_singular) {
  // Faults row 38: tilts of 80 to 180 degrees, and thrust of nothing.
  static const float thrust_N[] = {0.0f, 1e-30f, -0.0f, -0.1f, 0.001f, 0.3f, 100.0f};
  static const v3_t error[] = {{0, 0, 0}, {20, -20, 20}, {-1000, 1000, -1000}, {0, 0, -20}, {1e-30f, 0, 0}};
  static const rbf_point_t at[] = {{1.0f, 0.0f}, {0.1f, -500.0f}, {5.0f, 500.0f}};
  int bad = 0;
  for (int degrees = 80; degrees <= 180; degrees++)
    for (int about = 0; about < 360; about += 30)
      for (unsigned t = 0; t < 7; t++)
        for (unsigned e = 0; e < 5; e++)
          for (unsigned c = 0; c < 3; c++) {
            const double half = LAW_PI / 360 * degrees, axis = LAW_PI / 180 * about;
            const quat_t q = {(float)cos(half), (float)(sin(half) * cos(axis)),
                              (float)(sin(half) * sin(axis)), 0};
            const pos_step_t step = pos_indi_step(&law_param, q, thrust_N[t], error[e], 1.0f, at[c]);
            // m a/(ratio floor m g) is the most that a division by little thrust can make of an error.
            const float most = 1.01f * 1733.0f / (at[c].ratio * law_param.thrust_floor * GRAVITY_MPS2);
            const pos_command_t command = pos_indi_command(&law_param, q, thrust_N[t], step);
            const bool ok = fabsf(step.roll_rad) <= most && fabsf(step.pitch_rad) <= most &&
                            f_finite(step.thrust_N) && command.thrust_N >= 0.0f &&
                            command.thrust_N <= law_param.thrust_max_N &&
                            fabs((double)v3_dot(command.up_w, command.up_w) - 1.0) < 1e-5 &&
                            tilt_of(command.up_w) <= (double)law_param.tilt_max_rad + 1e-5;
            if (!ok && bad++ == 0)
              ROW("%d deg about %d, thrust %u, error %u, curve %u", degrees, about, t, e, c);
          }
  CHECK(bad == 0);
}

TEST(pos_indi_commands_level_when_exactly_upside_down) {
  static const quat_t q[] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0.6f, 0.8f, 0}};
  for (unsigned i = 0; i < sizeof q / sizeof *q; i++) {
    ROW("row %u", i);
    const pos_command_t c = pos_indi_command(&law_param, q[i], 0.3f, (pos_step_t){0, 0, 0});
    CHECK(c.up_w.x == 0.0f && c.up_w.y == 0.0f && c.up_w.z == 1.0f);
  }
}
