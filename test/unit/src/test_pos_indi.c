// test_pos_indi.c - the position law against the thesis's eqs 14-17 inverted numerically, and its properties.
#include "flight/pos_indi.h"
#include "rig/law.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <stddef.h>

static const rbf_point_t FREE_AIR = {1.0f, 0.0f};
static const double M = 0.032, G = 9.81;

// --- thesis eq. 14 in its own frame: north, east, down; angles phi, theta, psi ----------------------------

typedef struct {
  double x, y, z;
} d3_t;

typedef struct {
  double phi, theta, psi, thrust, zc; // of the linearisation point or beside it
  double rho, rho_slope, zc0;         // the curve is rho + slope (zc - zc0)
} thesis_t;

// xi'' = g e3 + (rho(zc)/m) T_N, T_N = -T b3, b3 the third column of Rz(psi) Ry(theta) Rx(phi).
static d3_t thesis_acc(const thesis_t *s) {
  const double k = -(s->rho + s->rho_slope * (s->zc - s->zc0)) * s->thrust / M;
  const double sp = sin(s->phi), cp = cos(s->phi), st = sin(s->theta), ct = cos(s->theta);
  const double sy = sin(s->psi), cy = cos(s->psi);
  return (d3_t){k * (cp * st * cy + sp * sy), k * (cp * st * sy - sp * cy), G + k * cp * ct};
}

// Central difference of eq. 14 by the number at `field`.
static d3_t partial(thesis_t s, size_t field, double h) {
  double *const x = (double *)(void *)((char *)&s + field);
  *x += h;
  const d3_t up = thesis_acc(&s);
  *x -= 2.0 * h;
  const d3_t down = thesis_acc(&s);
  return (d3_t){(up.x - down.x) / (2 * h), (up.y - down.y) / (2 * h), (up.z - down.z) / (2 * h)};
}

static double det(d3_t a, d3_t b, d3_t c) {
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}

// The increments of (phi, theta, T) that change the acceleration by e when the distance changes by dzc:
// Cramer's rule on d/dphi, d/dtheta, d/dT, with the ceiling's term on the left.
static d3_t thesis_increments(const thesis_t *s, d3_t e, double dzc) {
  const d3_t a = partial(*s, offsetof(thesis_t, phi), 1e-5), b = partial(*s, offsetof(thesis_t, theta), 1e-5);
  const d3_t c = partial(*s, offsetof(thesis_t, thrust), 1e-5), z = partial(*s, offsetof(thesis_t, zc), 1e-4);
  const d3_t y = {e.x - z.x * dzc, e.y - z.y * dzc, e.z - z.z * dzc};
  const double whole = det(a, b, c);
  return (d3_t){det(y, b, c) / whole, det(a, y, c) / whole, det(a, b, y) / whole};
}

// Ours: x forward, y left, z up. The thesis's axes turned by half a turn about x, in the world and in the
// body.
static quat_t attitude(double phi, double theta, double psi) {
  const double cr = cos(phi / 2), sr = sin(phi / 2), cp = cos(theta / 2), sp = sin(theta / 2);
  const double cy = cos(psi / 2), sy = sin(psi / 2);
  return (quat_t){(float)(cr * cp * cy + sr * sp * sy), (float)(sr * cp * cy - cr * sp * sy),
                  (float)-(cr * sp * cy + sr * cp * sy), (float)-(cr * cp * sy - sr * sp * cy)};
}

TEST(pos_indi_agrees_with_the_thesis_inverted_numerically) {
  splitmix_t r = {1};
  double worst_angle = 0.0, worst_thrust = 0.0;
  for (int k = 0; k < 2000; k++) {
    thesis_t s = {.phi = splitmix_between(&r, -LAW_PI / 3, LAW_PI / 3),
                  .theta = splitmix_between(&r, -LAW_PI / 3, LAW_PI / 3),
                  .psi = splitmix_between(&r, -LAW_PI, LAW_PI),
                  .thrust = M * G * splitmix_between(&r, 0.5, 2.0),
                  .rho = splitmix_between(&r, 0.8, 1.6),
                  .rho_slope = splitmix_between(&r, -40.0, 10.0)};
    s.zc = s.zc0 = splitmix_between(&r, 0.0, 0.1);
    const d3_t e = {splitmix_between(&r, -10, 10), splitmix_between(&r, -10, 10),
                    splitmix_between(&r, -10, 10)};
    const double sink_mps = splitmix_between(&r, -0.5, 0.5);
    const d3_t want = thesis_increments(&s, e, (double)law_param.lead_s * sink_mps); // zc grows when sinking

    const float dzc_m = pos_indi_nearing_m(&law_param, (float)-sink_mps, 0.0f, 0.0f);
    const pos_step_t got =
        pos_indi_step(&law_param, attitude(s.phi, s.theta, s.psi), (float)s.thrust,
                      (v3_t){(float)e.x, (float)-e.y, (float)-e.z}, dzc_m,
                      (rbf_point_t){.ratio = (float)s.rho, .slope_per_m = (float)s.rho_slope});

    // d theta turns about the pitch axis of the body by cos(phi) d theta, to the right where ours is to the
    // left.
    const double size = sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
    const double angle = M * size / (s.rho * s.thrust);
    const double thrust = (M * size + fabs(s.thrust * s.rho_slope * 0.3 * sink_mps)) / s.rho;
    worst_angle = fmax(worst_angle, fabs((double)got.roll_rad - want.x) / angle);
    worst_angle = fmax(worst_angle, fabs((double)got.pitch_rad + cos(s.phi) * want.y) / angle);
    worst_thrust = fmax(worst_thrust, fabs((double)got.thrust_N - want.z) / thrust);
  }
  CHECK_NEAR(worst_angle, 0.0, 1e-4);
  CHECK_NEAR(worst_thrust, 0.0, 1e-4);
}

// --- properties -----------------------------------------------------------------------------------------

static quat_t random_attitude(splitmix_t *r, double tilt_max) {
  const double tilt = splitmix_between(r, 0, tilt_max), about = splitmix_between(r, -LAW_PI, LAW_PI);
  const double yaw = splitmix_between(r, -LAW_PI, LAW_PI);
  // A tilt about a level axis after a yaw.
  const double c = cos(tilt / 2), x = sin(tilt / 2) * cos(about), y = sin(tilt / 2) * sin(about);
  const double cy = cos(yaw / 2), sy = sin(yaw / 2);
  return (quat_t){(float)(c * cy), (float)(x * cy + y * sy), (float)(y * cy - x * sy), (float)(c * sy)};
}

static v3_t random_vector(splitmix_t *r, double bound) {
  return (v3_t){(float)splitmix_between(r, -bound, bound), (float)splitmix_between(r, -bound, bound),
                (float)splitmix_between(r, -bound, bound)};
}

TEST(pos_indi_ceiling_term_acts_on_the_thrust_alone) {
  splitmix_t r = {2};
  for (int k = 0; k < 200; k++) {
    const quat_t q = random_attitude(&r, LAW_PI / 3);
    const v3_t e = random_vector(&r, 10);
    const float thrust_N = (float)splitmix_between(&r, 0.2, 0.5),
                climb = (float)splitmix_between(&r, -0.5, 0.5),
                dzc_m = pos_indi_nearing_m(&law_param, climb, 0.0f, 0.0f);
    const rbf_point_t flat = {1.1f, 0.0f}, steep = {1.1f, -20.0f};
    const pos_step_t without = pos_indi_step(&law_param, q, thrust_N, e, dzc_m, flat);
    const pos_step_t with = pos_indi_step(&law_param, q, thrust_N, e, dzc_m, steep);
    CHECK(with.roll_rad == without.roll_rad && with.pitch_rad == without.pitch_rad);
    // A climb towards the ceiling, where the thrust grows, asks for less thrust.
    CHECK_NEAR(with.thrust_N - without.thrust_N, -thrust_N * 20.0f * 0.3f * climb / 1.1f, 1e-5);
  }
}

TEST(pos_indi_foretells_the_distance_by_its_law) {
  static const struct {
    const char *what;
    int32_t law;
    float climb_mps, wanted_mps;
    double want_m;
  } row[] = {
      {"thesis: by its lead of 0.3 s, whatever is wanted", LAW_THESIS, 0.1f, 0.1f, -0.03},
      {"predicted, as wanted: by the lag alone", LAW_PREDICTED, 0.1f, 0.1f, -0.004},
      {"predicted, not wanted: by the lag, and what is to be caught", LAW_PREDICTED, 0.1f, 0.0f, -0.009},
      {"predicted, slower than wanted", LAW_PREDICTED, 0.0f, 0.1f, 0.005},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    pos_indi_param_t p = law_param;
    p.law = row[i].law;
    p.catch_s = 0.05f;
    CHECK_NEAR(pos_indi_nearing_m(&p, row[i].climb_mps, row[i].wanted_mps, 0.04f), row[i].want_m, 1e-8);
  }
}

TEST(pos_indi_increment_of_the_thrust_alone_is_as_many_times_as_large_as_it_is_to_be_quick) {
  pos_indi_param_t p = law_param;
  const rbf_point_t at = {1.1f, -5.0f};
  const v3_t e = {0.1f, 0.2f, 0.3f};
  const pos_step_t once = pos_indi_step(&p, (quat_t){.w = 1.0f}, 0.3f, e, 0.001f, at);
  p.quick = 3.0f;
  const pos_step_t quick = pos_indi_step(&p, (quat_t){.w = 1.0f}, 0.3f, e, 0.001f, at);
  CHECK_NEAR(quick.thrust_N, 3.0 * (double)once.thrust_N, 1e-8);
  CHECK(quick.roll_rad == once.roll_rad && quick.pitch_rad == once.pitch_rad);
}

TEST(pos_indi_has_gains_of_its_own_for_the_height) {
  pos_indi_param_t p = law_param;
  p.kp_z_per_s = 2.0f;
  p.kd_z_per_s = 8.0f;
  const pos_setpoint_t sp = {.pos_w_m = {0.1f, 0.1f, 0.1f}};
  const v3_t a = pos_indi_wanted_acc(&p, &sp, (v3_t){0, 0, 0}, (v3_t){0, 0, 0});
  CHECK_NEAR(a.x, 0.5, 1e-7);
  CHECK_NEAR(a.y, 0.5, 1e-7);
  CHECK_NEAR(a.z, 1.6, 1e-6);
}

TEST(pos_indi_command_gives_the_acceleration_that_was_wanted) {
  // Rotation and thrust together, put into m a = rho T b - m g again; what is left is of second order.
  splitmix_t r = {3};
  pos_indi_param_t p = law_param;
  p.tilt_max_rad = 0.8f;
  for (int k = 0; k < 500; k++) {
    const quat_t q = random_attitude(&r, 0.6);
    const float thrust_N = (float)splitmix_between(&r, 0.2, 0.4), rho = (float)splitmix_between(&r, 1.0, 1.4);
    const v3_t e = random_vector(&r, 0.3);
    const pos_step_t step = pos_indi_step(&p, q, thrust_N, e, 0.0f, (rbf_point_t){.ratio = rho});
    const pos_command_t c = pos_indi_command(&p, q, thrust_N, step);
    const v3_t before = v3_scale(rho * thrust_N / p.mass_kg, quat_up(q));
    const v3_t after = v3_scale(rho * c.thrust_N / p.mass_kg, c.up_w);
    const v3_t left = v3_sub(v3_sub(after, before), e);
    ROW("sample %d", k);
    CHECK_NEAR(sqrtf(v3_dot(left, left)), 0.0, 0.03); // e^2 (m/T) with |e| <= 0.52
  }
}

TEST(pos_indi_command_turns_the_thrust_by_roll_and_pitch) {
  static const struct {
    const char *what;
    pos_step_t step;
    v3_t up;
  } row[] = {
      {"nothing", {0, 0, 0}, {0, 0, 1}},
      {"pitch: nose down, forward", {.pitch_rad = 0.1f}, {0.0998334f, 0, 0.9950042f}},
      {"roll: to the right", {.roll_rad = 0.1f}, {0, -0.0998334f, 0.9950042f}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const pos_command_t c = pos_indi_command(&law_param, (quat_t){1, 0, 0, 0}, 0.3f, row[i].step);
    CHECK_NEAR(c.up_w.x, row[i].up.x, 4e-4); // third order of 0.1
    CHECK_NEAR(c.up_w.y, row[i].up.y, 4e-4);
    CHECK_NEAR(c.up_w.z, row[i].up.z, 4e-4);
    CHECK_NEAR(c.thrust_N, 0.3, 1e-7);
    CHECK(!c.at_limit);
  }
}

TEST(pos_indi_asks_for_the_acceleration_of_its_gains) {
  static const struct {
    const char *what;
    pos_setpoint_t sp;
    v3_t pos, vel, want;
  } row[] = {
      {"there", {.pos_w_m = {1, 2, 3}}, {1, 2, 3}, {0, 0, 0}, {0, 0, 0}},
      {"position", {.pos_w_m = {1, 2, 3}}, {0.9f, 2.2f, 2.7f}, {0, 0, 0}, {0.5f, -1.0f, 1.5f}},
      {"velocity", {.pos_w_m = {0, 0, 0}}, {0, 0, 0}, {0.1f, -0.2f, 0.3f}, {-0.5f, 1.0f, -1.5f}},
      {"feed-forward",
       {.vel_w_mps = {0.1f, 0, 0}, .acc_w_mps2 = {0, 1, 2}},
       {0, 0, 0},
       {0, 0, 0},
       {0.5f, 1, 2}},
      {"bound", {.pos_w_m = {100, -100, 0.1f}}, {0, 0, 0}, {0, 0, 0}, {20, -20, 0.5f}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const v3_t a = pos_indi_wanted_acc(&law_param, &row[i].sp, row[i].pos, row[i].vel);
    CHECK_NEAR(a.x, row[i].want.x, 2e-6);
    CHECK_NEAR(a.y, row[i].want.y, 2e-6);
    CHECK_NEAR(a.z, row[i].want.z, 2e-6);
  }
}

TEST(pos_indi_holds_what_is_already_right) {
  splitmix_t r = {4};
  for (int k = 0; k < 100; k++) {
    const quat_t q = random_attitude(&r, 0.3);
    const pos_step_t step = pos_indi_step(&law_param, q, 0.35f, (v3_t){0, 0, 0}, 0.0f, FREE_AIR);
    const pos_command_t c = pos_indi_command(&law_param, q, 0.35f, step);
    const v3_t turned = v3_sub(c.up_w, quat_up(q));
    CHECK(c.thrust_N == 0.35f);
    CHECK_NEAR(v3_dot(turned, turned), 0.0, 1e-12);
  }
}
