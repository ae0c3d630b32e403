// test_outer.c - the whole outer loop: what it does with bad inputs, and that it flies.
#include "flight/outer.h"
#include "random.h"
#include "test.h"

#include <float.h>
#include <string.h>

// A step and its lesson in one tick.
static outer_out_t step_and_learn(outer_t *f, const flight_param_t *p, const outer_in_t *in) {
  const outer_out_t out = outer_step(f, p, in);
  outer_learn(f);
  return out;
}

static const float DT = 0.01f;
static const double NO_CEILING = 1e3;

// --- a vehicle to fly: a point that pushes along its body axis, both with a lag ---------------------------

typedef struct {
  double pos[3], vel[3], up[3]; // world
  double thrust_N, applied_N;
  double yaw, ceiling_m;
  int tick;
} vehicle_t;

static double ratio_at(double zc_m) {
  return 1.0 + 0.44 * exp(-80.0 * fmax(zc_m, 0.0));
}

static vehicle_t vehicle_at(double x, double y, double z, double ceiling_m) {
  const double weight_N = 0.032 * 9.81 / ratio_at(ceiling_m - z);
  return (vehicle_t){
      .pos = {x, y, z}, .up = {0, 0, 1}, .thrust_N = weight_N, .applied_N = weight_N, .ceiling_m = ceiling_m};
}

static double force_N(const vehicle_t *v) {
  return v->thrust_N * ratio_at(v->ceiling_m - v->pos[2]);
}

static void move(vehicle_t *v, const outer_out_t *command) {
  const double to[3] = {(double)command->up_w.x, (double)command->up_w.y, (double)command->up_w.z};
  const double h = 0.001;
  v->applied_N = (double)command->thrust_N;
  for (int step = 0; step < 10; step++) {
    for (int i = 0; i < 3; i++) {
      const double acc = force_N(v) / 0.032 * v->up[i] - (i == 2 ? 9.81 : 0.0);
      v->pos[i] += h * (v->vel[i] + 0.5 * h * acc);
      v->vel[i] += h * acc;
    }
    v->thrust_N = v->applied_N + (v->thrust_N - v->applied_N) * exp(-h / 0.0625);
    double length = 0.0;
    for (int i = 0; i < 3; i++) {
      v->up[i] += (to[i] - v->up[i]) * h / 0.03;
      length += v->up[i] * v->up[i];
    }
    for (int i = 0; i < 3; i++) v->up[i] /= sqrt(length);
  }
  v->tick++;
}

// The turn from level to `up`, after a yaw.
static quat_t attitude(const double up[3], double yaw) {
  const double w = sqrt(0.5 * (1.0 + up[2])), x = -up[1] / (2.0 * w), y = up[0] / (2.0 * w);
  const double c = cos(0.5 * yaw), s = sin(0.5 * yaw);
  return (quat_t){(float)(w * c), (float)(x * c + y * s), (float)(y * c - x * s), (float)(w * s)};
}

static v3_t v3_of(const double a[3]) {
  return (v3_t){(float)a[0], (float)a[1], (float)a[2]};
}

// What the vehicle's sensors say; a range sample on every tenth tick.
static outer_in_t sense(const vehicle_t *v, v3_t goal_m) {
  return (outer_in_t){.pos_w_m = v3_of(v->pos),
                      .vel_w_mps = v3_of(v->vel),
                      .acc_b_mps2 = {0, 0, (float)(force_N(v) / 0.032)},
                      .q_wb = attitude(v->up, v->yaw),
                      .thrust_N = (float)v->applied_N,
                      .range_new = v->tick % 10 == 0,
                      .range_m = (float)fmin((v->ceiling_m - v->pos[2]) / v->up[2], 32.767),
                      .setpoint = {.pos_w_m = goal_m}};
}

static flight_param_t defaults(void) {
  flight_param_t p;
  params_default(&p);
  return p;
}

static outer_t fresh(const flight_param_t *p) {
  outer_t f;
  memset(&f, 0, sizeof f);
  CHECK_OK(outer_init(&f, p, DT));
  return f;
}

static outer_out_t fly(outer_t *f, const flight_param_t *p, vehicle_t *v, v3_t goal_m, int ticks) {
  outer_out_t out = f->out;
  for (int k = 0; k < ticks; k++) {
    const outer_in_t in = sense(v, goal_m);
    out = step_and_learn(f, p, &in);
    move(v, &out);
  }
  return out;
}

// A flight in full swing, 6 cm below the ceiling, that learns.
static outer_t in_flight(flight_param_t *p, vehicle_t *v) {
  *p = defaults();
  p->curve.mode = CURVE_LIVE;
  outer_t f = fresh(p);
  *v = vehicle_at(0.1, -0.1, 0.80, 1.0);
  fly(&f, p, v, (v3_t){0, 0, 0.94f}, 503);
  CHECK(f.ceiling.known && f.learn.rls.count > 100);
  return f;
}

// --- what is compared -----------------------------------------------------------------------------------

static bool same_out(const outer_out_t *a, const outer_out_t *b) {
  const float x[] = {a->up_w.x, a->up_w.y, a->up_w.z, a->thrust_N, a->zc_m, a->at.ratio, a->at.slope_per_m};
  const float y[] = {b->up_w.x, b->up_w.y, b->up_w.z, b->thrust_N, b->zc_m, b->at.ratio, b->at.slope_per_m};
  return memcmp(x, y, sizeof x) == 0 && a->zc_known == b->zc_known;
}

// All but the counters of faults. `out` has padding and is compared by its fields.
static bool same_state(const outer_t *a, const outer_t *b) {
  return same_out(&a->out, &b->out) && memcmp(a, b, offsetof(outer_t, out)) == 0;
}
_Static_assert(offsetof(outer_t, out) + sizeof(outer_out_t) == offsetof(outer_t, faults),
               "something behind `out` would not be compared");

static unsigned sum_of_faults(const outer_t *f) {
  unsigned sum = 0;
  for (int i = 0; i < ST_COUNT; i++) sum += f->faults[i];
  return sum;
}

static bool is_command(const outer_out_t *out, const flight_param_t *p) {
  const double up2 = (double)v3_dot(out->up_w, out->up_w);
  const double side = hypot((double)out->up_w.x, (double)out->up_w.y);
  return fabs(up2 - 1.0) < 1e-5 && out->up_w.z > 0.0f && side <= sin((double)p->pos.tilt_max_rad) + 1e-5 &&
         out->thrust_N >= 0.0f && out->thrust_N <= p->pos.thrust_max_N && f_finite(out->zc_m) &&
         out->at.ratio >= p->curve.ratio_min && out->at.ratio <= p->curve.ratio_max &&
         f_finite(out->at.slope_per_m);
}

// --- bad inputs -------------------------------------------------------------------------------------------

TEST(outer_changes_nothing_on_an_input_that_is_not_a_number) {
  // Faults rows 1, 3, 4.
  static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY, 1e38f, -1e38f, FLT_MAX};
  flight_param_t p;
  vehicle_t v;
  const outer_t start = in_flight(&p, &v);
  int fields = 0;
  for (size_t field = 0; field < sizeof(outer_in_t); field += sizeof(float)) {
    if (field == offsetof(outer_in_t, range_new) || field == offsetof(outer_in_t, range_m) ||
        field == offsetof(outer_in_t, range_age_s))
      continue;
    fields++;
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
      ROW("%g at byte %d", (double)bad[k], (int)field);
      outer_t f;
      memcpy(&f, &start, sizeof f);
      outer_in_t in = sense(&v, (v3_t){0, 0, 0.94f});
      memcpy((char *)&in + field, &bad[k], sizeof bad[k]);
      const outer_out_t out = step_and_learn(&f, &p, &in);
      CHECK(same_out(&out, &start.out));
      CHECK(is_command(&out, &p));
      CHECK(same_state(&f, &start));
      const status_t kind = field >= offsetof(outer_in_t, setpoint) ? ST_BAD_SETPOINT : ST_BAD_INPUT;
      CHECK(f.faults[kind] == start.faults[kind] + 1);
      CHECK(sum_of_faults(&f) == sum_of_faults(&start) + 1);
    }
  }
  CHECK(fields == 23);
}

TEST(outer_holds_an_attitude_that_is_none) {
  // Faults row 47. Half to twice the length of a quaternion is normalised, the rest is no attitude.
  static const struct {
    float scale;
    bool used;
  } row[] = {{0.0f, false}, {0.1f, false}, {0.49f, false}, {0.51f, true},
             {1.5f, true},  {1.99f, true}, {2.1f, false}};
  flight_param_t p;
  vehicle_t v;
  const outer_t start = in_flight(&p, &v);
  outer_t plain;
  memcpy(&plain, &start, sizeof plain);
  outer_in_t in = sense(&v, (v3_t){0, 0, 0.94f});
  const outer_out_t want = step_and_learn(&plain, &p, &in);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("length %g", (double)row[i].scale);
    outer_t f;
    memcpy(&f, &start, sizeof f);
    outer_in_t scaled = in;
    const float k = row[i].scale;
    scaled.q_wb = (quat_t){k * in.q_wb.w, k * in.q_wb.x, k * in.q_wb.y, k * in.q_wb.z};
    const outer_out_t out = step_and_learn(&f, &p, &scaled);
    CHECK(f.faults[ST_BAD_INPUT] == (row[i].used ? 0u : 1u));
    CHECK(same_state(&f, &start) == !row[i].used);
    if (row[i].used) CHECK_NEAR(out.thrust_N, want.thrust_N, 1e-6);
  }
}

TEST(outer_gives_a_safe_command_before_it_has_seen_a_good_sample) {
  const flight_param_t p = defaults();
  outer_t f = fresh(&p);
  vehicle_t v = vehicle_at(0, 0, 0.5, 1.0);
  outer_in_t in = sense(&v, (v3_t){0, 0, 0.9f});
  in.acc_b_mps2.z = NAN;
  const outer_out_t out = step_and_learn(&f, &p, &in);
  CHECK(out.thrust_N == 0.0f && out.up_w.z == 1.0f && out.at.ratio == 1.0f && !out.zc_known);
  CHECK(!f.started);
}

TEST(outer_counts_a_bad_range_and_flies_on_as_without_it) {
  // Faults rows 13, 14, 22.
  static const float bad[] = {NAN, INFINITY, -INFINITY, 1e38f, 32.767f, 0.0f, -0.3f, 300.0f};
  flight_param_t p;
  vehicle_t v;
  const outer_t start = in_flight(&p, &v);
  for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
    ROW("%g", (double)bad[k]);
    outer_t f, twin;
    memcpy(&f, &start, sizeof f);
    memcpy(&twin, &start, sizeof twin);
    outer_in_t in = sense(&v, (v3_t){0, 0, 0.94f});
    in.range_new = true;
    in.range_m = bad[k];
    const outer_out_t out = step_and_learn(&f, &p, &in);
    in.range_new = false;
    const outer_out_t want = step_and_learn(&twin, &p, &in);
    CHECK(same_out(&out, &want));
    CHECK(same_state(&f, &twin));
    CHECK(f.faults[ST_BAD_RANGE] == start.faults[ST_BAD_RANGE] + 1);
    CHECK(sum_of_faults(&f) == sum_of_faults(&twin) + 1);
  }
}

TEST(outer_counts_a_sample_whose_age_is_none_and_flies_on_without_it) {
  static const float age_s[] = {NAN, INFINITY, -INFINITY, -0.01f};
  for (unsigned i = 0; i < sizeof age_s / sizeof *age_s; i++) {
    ROW("age %g s", (double)age_s[i]);
    flight_param_t p;
    vehicle_t v;
    const outer_t start = in_flight(&p, &v);
    outer_t f, twin;
    memcpy(&f, &start, sizeof f);
    memcpy(&twin, &start, sizeof twin);
    outer_in_t in = sense(&v, (v3_t){0, 0, 0.94f});
    in.range_new = false;
    const outer_out_t want = step_and_learn(&twin, &p, &in);
    in.range_new = true;
    in.range_m = 0.1f;
    in.range_age_s = age_s[i];
    const outer_out_t out = step_and_learn(&f, &p, &in);
    CHECK(same_out(&out, &want));
    CHECK(f.faults[ST_BAD_RANGE] == twin.faults[ST_BAD_RANGE] + 1);
  }
}

TEST(outer_outputs_stay_in_their_limits_whatever_comes) {
  // G1 and G2 of the fault list: 20000 ticks of which most have something wrong.
  static const float odd[] = {NAN,   INFINITY, -INFINITY, 1e38f,   1e-45f, 0.0f,
                              -1.0f, 1.0f,     99.0f,     -999.0f, 9999.0f};
  random_t r = {1};
  flight_param_t p = defaults();
  p.curve.mode = CURVE_LIVE;
  outer_t f = fresh(&p);
  vehicle_t v = vehicle_at(0, 0, 0.9, 1.0);
  int bad = 0;
  for (int k = 0; k < 20000; k++) {
    v.pos[2] = random_between(&r, 0.3, 1.0);
    outer_in_t in = sense(&v, (v3_t){0, 0, 0.94f});
    for (int n = (int)(random_bits(&r) % 4); n > 0; n--) {
      const size_t field = sizeof(float) * (random_bits(&r) % (sizeof(outer_in_t) / sizeof(float)));
      if (field != offsetof(outer_in_t, range_new))
        memcpy((char *)&in + field, &odd[random_bits(&r) % (sizeof odd / sizeof *odd)], sizeof(float));
    }
    const outer_out_t out = step_and_learn(&f, &p, &in);
    if (!is_command(&out, &p) || out.zc_m < 0.0f || out.zc_m > 4.0f) bad++;
    for (int i = 0; i < RBF_N; i++)
      if (!(fabsf(f.learn.rls.theta.w[i]) <= RLS_WEIGHT_MAX)) bad++;
  }
  CHECK(bad == 0);
}

// --- parameters in flight ---------------------------------------------------------------------------------

TEST(outer_keeps_the_last_good_parameters) {
  // Faults rows 31, 32: the twin never sees the bad set.
  static const float bad[] = {NAN, INFINITY, -INFINITY, 1e9f, -1e9f};
  flight_param_t p;
  vehicle_t v;
  const outer_t start = in_flight(&p, &v);
  for (int i = 0; i < params_count; i++)
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
      ROW("%s = %g", params_table[i].name, (double)bad[k]);
      outer_t f, twin;
      memcpy(&f, &start, sizeof f);
      memcpy(&twin, &start, sizeof twin);
      flight_param_t absurd = p;
      memcpy((char *)&absurd + params_table[i].offset, &bad[k], sizeof(float));
      vehicle_t there = v;
      for (int tick = 0; tick < 6; tick++) {
        const outer_in_t in = sense(&there, (v3_t){0.02f, 0, 0.93f});
        const outer_out_t out = step_and_learn(&f, tick < 3 ? &absurd : &p, &in);
        const outer_out_t want = step_and_learn(&twin, &p, &in);
        CHECK(same_out(&out, &want));
        move(&there, &want);
      }
      CHECK(same_state(&f, &twin));
      CHECK(f.faults[ST_BAD_PARAM] == start.faults[ST_BAD_PARAM] + 3);
    }
}

TEST(outer_refuses_a_cut_off_beyond_nyquist_in_flight) {
  flight_param_t p = defaults();
  p.cutoff_Hz = 2.0f;
  outer_t f;
  CHECK_OK(outer_init(&f, &p, 0.1f));
  flight_param_t fast = p;
  fast.cutoff_Hz = 8.0f; // in its range, but not at 10 Hz
  vehicle_t v = vehicle_at(0, 0, 0.5, NO_CEILING);
  const outer_in_t in = sense(&v, (v3_t){0, 0, 0.5f});
  (void)step_and_learn(&f, &fast, &in);
  CHECK(f.faults[ST_BAD_PARAM] == 1);
  CHECK(f.param.cutoff_Hz == 2.0f);
}

TEST(outer_takes_a_good_set_over_at_once) {
  flight_param_t p;
  vehicle_t v;
  const outer_t start = in_flight(&p, &v);
  static const struct {
    const char *name;
    float value;
  } row[] = {{"indiPos.kp", 2},       {"indiPos.kd", 8}, {"indiPos.cutoff", 20}, {"indiPos.tauMot", 0.1f},
             {"indiPos.mass", 0.04f}, {"ceil.mode", 0},  {"ceil.kz", 2},         {"ceil.zOn", 0.01f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].name);
    outer_t f, twin;
    memcpy(&f, &start, sizeof f);
    memcpy(&twin, &start, sizeof twin);
    p.curve.mode = CURVE_THEORY; // the learned curve may be flat here
    flight_param_t changed = p;
    CHECK_OK(params_set(&changed, params_find(row[i].name), row[i].value));
    outer_in_t in = sense(&v, (v3_t){0.1f, 0, 0.93f});
    in.vel_w_mps.z = 0.05f;
    in.thrust_N += 0.02f;
    const outer_out_t out = step_and_learn(&f, &changed, &in);
    const outer_out_t before = step_and_learn(&twin, &p, &in);
    CHECK(!same_out(&out, &before));
    CHECK(memcmp(&f.param, &changed, sizeof changed) == 0);
    CHECK(f.faults[ST_BAD_PARAM] == 0);
  }
}

TEST(outer_init_refuses_what_cannot_fly) {
  static const struct {
    const char *what;
    float period_s, cutoff_Hz;
    int32_t mode;
  } row[] = {
      {"period zero", 0.0f, 8, 1},         {"period negative", -0.01f, 8, 1},
      {"period nan", NAN, 8, 1},           {"period too long", 0.11f, 1, 1},
      {"period too short", 0.0009f, 8, 1}, {"cut-off beyond nyquist", 0.1f, 8, 1},
      {"cut-off nan", 0.01f, NAN, 1},      {"no such mode", 0.01f, 8, 7},
  };
  flight_param_t p;
  vehicle_t v;
  const outer_t start = in_flight(&p, &v);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    outer_t f;
    memcpy(&f, &start, sizeof f);
    flight_param_t bad = defaults();
    bad.cutoff_Hz = row[i].cutoff_Hz;
    bad.curve.mode = row[i].mode;
    CHECK_STATUS(ST_BAD_PARAM, outer_init(&f, &bad, row[i].period_s));
    CHECK(memcmp(&f, &start, sizeof f) == 0);
  }
}

// --- the same bits ----------------------------------------------------------------------------------------

TEST(outer_without_a_ceiling_is_plain_indi_to_the_bit) {
  // Faults row 41.
  static const struct {
    const char *what;
    bool new_samples;
    double ceiling_m;
  } row[] = {{"no samples", false, NO_CEILING},
             {"no echo", true, NO_CEILING},
             {"beyond far", true, 3.0},
             {"in sight, beyond zOn", true, 0.95}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int32_t mode = CURVE_FIXED; mode <= CURVE_THEORY; mode++) {
      ROW("%s, mode %d", row[i].what, (int)mode);
      flight_param_t p = defaults(), off = p;
      p.curve.mode = mode;
      off.curve.mode = CURVE_OFF;
      p.curve.clip = off.curve.clip = 0;
      outer_t f = fresh(&p), twin = fresh(&off);
      vehicle_t v = vehicle_at(0.2, -0.1, 0.4, row[i].ceiling_m);
      int differ = 0;
      for (int k = 0; k < 500; k++) {
        outer_in_t in = sense(&v, (v3_t){0, 0, k < 200 ? 0.7f : 0.5f});
        in.range_new = in.range_new && row[i].new_samples;
        const outer_out_t out = step_and_learn(&f, &p, &in);
        const outer_out_t want = step_and_learn(&twin, &off, &in);
        if (!same_out(&out, &want)) differ++;
        if (k == 499) CHECK(out.zc_known == (i == 3));
        move(&v, &out);
      }
      CHECK(differ == 0);
    }
}

TEST(outer_does_the_same_for_q_and_minus_q) {
  flight_param_t p;
  vehicle_t v;
  (void)in_flight(&p, &v);
  outer_t f = fresh(&p), twin = fresh(&p);
  v = vehicle_at(0.3, 0.2, 0.8, 1.0);
  v.yaw = 2.0;
  random_t r = {2};
  int differ = 0, flipped = 0;
  for (int k = 0; k < 500; k++) {
    outer_in_t in = sense(&v, (v3_t){0, 0, 0.94f});
    const outer_out_t want = step_and_learn(&twin, &p, &in);
    if (k == 0 || random_bits(&r) % 2 == 0) { // the very first one, too
      in.q_wb = (quat_t){-in.q_wb.w, -in.q_wb.x, -in.q_wb.y, -in.q_wb.z};
      flipped++;
    }
    const outer_out_t out = step_and_learn(&f, &p, &in);
    if (!same_out(&out, &want)) differ++;
    move(&v, &want);
  }
  CHECK(differ == 0);
  CHECK(flipped > 200 && flipped < 300);
}

TEST(outer_of_one_vehicle_does_not_touch_that_of_another) {
  flight_param_t p = defaults(), other = p;
  other.curve.mode = p.curve.mode = CURVE_LIVE;
  other.pos.kp_per_s = 2.0f;
  other.cutoff_Hz = 20.0f;
  outer_t alone = fresh(&p), one = fresh(&p), two = fresh(&other);
  vehicle_t va = vehicle_at(0.1, 0, 0.8, 1.0), v1 = va, v2 = vehicle_at(-0.3, 0.2, 0.6, 0.9);
  int differ = 0;
  for (int k = 0; k < 400; k++) {
    const outer_out_t want = fly(&alone, &p, &va, (v3_t){0, 0, 0.95f}, 1);
    const outer_out_t out = fly(&one, &p, &v1, (v3_t){0, 0, 0.95f}, 1);
    (void)fly(&two, &other, &v2, (v3_t){0, 0, 0.8f}, 1);
    if (!same_out(&out, &want)) differ++;
  }
  CHECK(differ == 0);
  CHECK(same_state(&alone, &one));
}

TEST(outer_started_again_is_as_one_that_never_flew) {
  flight_param_t p;
  vehicle_t v;
  outer_t used = in_flight(&p, &v);
  CHECK_OK(outer_init(&used, &p, DT));
  outer_t first = fresh(&p);
  vehicle_t va = vehicle_at(0.1, 0, 0.8, 1.0), vb = va;
  int differ = 0;
  for (int k = 0; k < 300; k++) {
    const outer_out_t a = fly(&used, &p, &va, (v3_t){0, 0, 0.95f}, 1);
    const outer_out_t b = fly(&first, &p, &vb, (v3_t){0, 0, 0.95f}, 1);
    if (!same_out(&a, &b)) differ++;
  }
  CHECK(differ == 0);
  CHECK(sum_of_faults(&used) == sum_of_faults(&first));
}

// --- take-over ------------------------------------------------------------------------------------------

// A vehicle that already does what the set point asks for, so that nothing is to be changed.
static const struct {
  const char *what;
  v3_t vel, up, acc; // acc: with `up` the one that follows from thrust 1.02 m g
} STEADY[] = {
    {"hover", {0, 0, 0}, {0, 0, 1}, {0, 0, 0.1962f}},
    {"climb at 0.5 m/s", {0, 0, 0.5f}, {0, 0, 1}, {0, 0, 0.1962f}},
    {"climb at 2 m/s", {0, 0, 2.0f}, {0, 0, 1}, {0, 0, 0.1962f}},
    {"tilted forward", {1, 0, 0}, {0.2f, 0, 0.9797959f}, {2.00124f, 0, -0.00597f}},
    {"tilted to the left", {0, 0.5f, 0}, {0, 0.2f, 0.9797959f}, {0, 2.00124f, -0.00597f}},
};

TEST(outer_takes_over_without_a_bump) {
  for (unsigned i = 0; i < sizeof STEADY / sizeof *STEADY; i++)
    for (int yaw = 0; yaw < 3; yaw++) {
      ROW("%s, yaw %d", STEADY[i].what, yaw);
      flight_param_t p = defaults();
      p.bias.pole_radps = 0.0f; // velocity and acceleration are of an instant here, not of a flight
      outer_t f = fresh(&p);
      const double up[3] = {(double)STEADY[i].up.x, (double)STEADY[i].up.y, (double)STEADY[i].up.z};
      const float thrust_N = 1.02f * 0.032f * GRAVITY_MPS2;
      outer_in_t in = {.vel_w_mps = STEADY[i].vel,
                       .acc_b_mps2 = {0, 0, thrust_N / 0.032f},
                       .q_wb = attitude(up, (double)yaw),
                       .thrust_N = thrust_N};
      in.setpoint = (pos_setpoint_t){.vel_w_mps = in.vel_w_mps, .acc_w_mps2 = STEADY[i].acc};
      for (int k = 0; k < 50; k++) {
        in.pos_w_m = in.setpoint.pos_w_m = v3_scale((float)k * DT, in.vel_w_mps);
        const outer_out_t out = step_and_learn(&f, &p, &in);
        CHECK_NEAR(out.thrust_N, thrust_N, 2e-6);
        CHECK_NEAR(out.up_w.x, STEADY[i].up.x, 1e-5);
        CHECK_NEAR(out.up_w.y, STEADY[i].up.y, 1e-5);
      }
      CHECK(sum_of_faults(&f) == 0); // nothing was wrong
    }
}

// --- the ceiling ------------------------------------------------------------------------------------------

TEST(outer_takes_a_reset_of_the_height_for_no_climb) {
  // Faults row 45.
  static const double jump_m[] = {0.3, -0.3, 0.05, -0.02};
  for (unsigned i = 0; i < sizeof jump_m / sizeof *jump_m; i++) {
    ROW("%g m", jump_m[i]);
    flight_param_t p;
    vehicle_t v;
    outer_t f = in_flight(&p, &v);
    const unsigned before = f.faults[ST_JUMP];
    v3_t goal = {0, 0, 0.94f};
    double worst = 0.0;
    for (int k = 0; k < 100; k++) {
      outer_in_t in = sense(&v, goal);
      if (k >= 7) {
        in.pos_w_m.z += (float)jump_m[i];
        in.setpoint.pos_w_m.z += (float)jump_m[i];
      }
      const outer_out_t out = step_and_learn(&f, &p, &in);
      worst = fmax(worst, fabs((double)out.zc_m - (v.ceiling_m - v.pos[2])));
      move(&v, &out);
    }
    CHECK_NEAR(worst, 0.0, 0.02);
    CHECK(f.faults[ST_JUMP] == before + 1);
  }
}

TEST(outer_knows_the_ceiling_after_a_row_of_bad_inputs_in_a_climb) {
  // What was climbed while the inputs were bad is in the height of the first good one.
  static const struct {
    int ticks;
    double climb_mps, from_m;
  } row[] = {{1, 0.3, 0.7}, {3, 0.3, 0.7}, {10, 0.3, 0.7}, {25, 0.3, 0.7}, {25, -0.3, 0.7}, {3, 0.8, 0.55}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d ticks at %g m/s", row[i].ticks, row[i].climb_mps);
    const flight_param_t p = defaults();
    outer_t f = fresh(&p);
    vehicle_t v = vehicle_at(0, 0, row[i].from_m, 1.0);
    outer_out_t out = f.out;
    for (int k = 0; k < 50; k++) {
      v.vel[2] = row[i].climb_mps;
      v.pos[2] = row[i].from_m + row[i].climb_mps * 0.01 * k;
      v.tick = k;
      outer_in_t in = sense(&v, (v3_t){0, 0, 0.9f});
      if (k > 5) in.range_new = false;
      if (k >= 10 && k < 10 + row[i].ticks) in.acc_b_mps2.x = NAN;
      out = step_and_learn(&f, &p, &in);
    }
    CHECK_NEAR(out.zc_m, v.ceiling_m - v.pos[2], 0.02);
  }
}

TEST(outer_corrects_a_slant_range) {
  // Faults row 23: 20 degrees make 6 % of the distance.
  static const double tilt = 20.0 * 3.14159265358979 / 180.0;
  for (int towards = 0; towards < 12; towards++)
    for (int yaw = 0; yaw < 3; yaw++) {
      ROW("towards %d deg, yaw %d rad", 30 * towards, yaw);
      const flight_param_t p = defaults();
      outer_t f = fresh(&p);
      vehicle_t v = vehicle_at(0, 0, 0.6, 1.0);
      const double about = 0.5235987755983 * towards;
      v.up[0] = sin(tilt) * cos(about);
      v.up[1] = sin(tilt) * sin(about);
      v.up[2] = cos(tilt);
      v.yaw = yaw;
      for (v.tick = 0; v.tick < 50; v.tick++) {
        const outer_in_t in = sense(&v, (v3_t){0, 0, 0.6f});
        const outer_out_t out = step_and_learn(&f, &p, &in);
        CHECK_NEAR(out.zc_m, 0.4, 1e-4);
      }
    }
}

TEST(outer_uses_the_age_of_a_range_sample) {
  // At 0.3 m/s a sample that is 130 ms old is 4 cm off.
  const flight_param_t p = defaults();
  outer_t f = fresh(&p);
  for (int k = 0; k < 120; k++) {
    ROW("tick %d", k);
    const float gap_m = 0.45f - 0.003f * (float)k;
    const outer_in_t in = {.pos_w_m = {0, 0, 1.0f - gap_m},
                           .vel_w_mps = {0, 0, 0.3f},
                           .acc_b_mps2 = {0, 0, GRAVITY_MPS2},
                           .q_wb = {1, 0, 0, 0},
                           .thrust_N = 0.314f,
                           .range_new = k >= 13 && k % 10 == 3,
                           .range_m = gap_m + 0.039f,
                           .range_age_s = 0.13f};
    const outer_out_t out = step_and_learn(&f, &p, &in);
    if (k >= 13) CHECK_NEAR(out.zc_m, gap_m, 0.004); // the climb of the very first tick is not known
  }
}

// --- it flies ---------------------------------------------------------------------------------------------

TEST(outer_settles_at_the_set_point_in_all_three_axes) {
  static const struct {
    double x, y, z, yaw;
  } row[] = {{0.3, -0.2, 0.5, 0.0}, {-0.4, 0.3, 0.9, 2.0}, {0.0, 0.5, 0.7, -1.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("row %u", i);
    const flight_param_t p = defaults();
    outer_t f = fresh(&p);
    vehicle_t v = vehicle_at(row[i].x, row[i].y, row[i].z, NO_CEILING);
    v.yaw = row[i].yaw;
    const outer_out_t out = fly(&f, &p, &v, (v3_t){0.1f, 0.1f, 0.7f}, 1200);
    CHECK_NEAR(v.pos[0], 0.1, 1e-3);
    CHECK_NEAR(v.pos[1], 0.1, 1e-3);
    CHECK_NEAR(v.pos[2], 0.7, 1e-3);
    CHECK_NEAR(out.thrust_N, 0.032 * 9.81, 1e-4);
  }
}

TEST(outer_learns_the_curve_where_it_flew) {
  static const double gap_m[] = {0.10, 0.08, 0.06, 0.04, 0.03};
  flight_param_t p = defaults();
  p.curve.mode = CURVE_LIVE;
  p.curve.fixed = (rbf_weights_t){{1, 0, 0, 0, 0, 0, 0}};
  p.learn.far_m = 0.5f;
  outer_t f = fresh(&p);
  vehicle_t v = vehicle_at(0, 0, 0.80, 1.0);
  for (int i = 0; i < 5; i++) fly(&f, &p, &v, (v3_t){0, 0, (float)(1.0 - gap_m[i])}, 1000);
  CHECK(f.learn.rls.count > 4500);
  for (int i = 0; i < 5; i++) {
    ROW("%g m", gap_m[i]);
    CHECK_NEAR(rbf_at(&f.learn.rls.theta, (float)gap_m[i]).ratio, ratio_at(gap_m[i]), 2e-3);
  }
}

TEST(outer_learns_the_thrust_along_its_axis_not_the_lift) {
  // 12 degrees of tilt take 2 % of the lift and nothing of the thrust.
  static const double up[] = {0.1470157, 0.1470157, 0.9781476};
  flight_param_t p = defaults();
  p.curve.mode = CURVE_LIVE;
  p.learn_after_s = 0.0f;
  p.bias.pole_radps = 0.0f;
  p.curve.fixed = (rbf_weights_t){{1, 0, 0, 0, 0, 0, 0}};
  outer_t f = fresh(&p);
  const float thrust_N = 0.3f;
  for (int k = 0; k < 500; k++) {
    const outer_in_t in = {.acc_b_mps2 = {0, 0, 1.05f * thrust_N / p.pos.mass_kg},
                           .q_wb = attitude(up, 1.0),
                           .thrust_N = thrust_N,
                           .range_new = k % 10 == 0,
                           .range_m = 0.06f / (float)up[2]};
    (void)step_and_learn(&f, &p, &in);
  }
  CHECK(f.learn.rls.count == 500);
  CHECK_NEAR(rbf_at(&f.learn.rls.theta, 0.06f).ratio, 1.05, 1e-3);
}

TEST(outer_learns_only_in_the_mode_that_learns) {
  for (int32_t mode = CURVE_OFF; mode <= CURVE_THEORY; mode++) {
    ROW("mode %d", (int)mode);
    flight_param_t p = defaults();
    p.curve.mode = mode;
    outer_t f = fresh(&p);
    vehicle_t v = vehicle_at(0, 0, 0.94, 1.0);
    fly(&f, &p, &v, (v3_t){0, 0, 0.95f}, 300);
    const bool same = memcmp(&f.learn.rls.theta, &p.curve.fixed, sizeof p.curve.fixed) == 0;
    CHECK(same == (mode != CURVE_LIVE));
    CHECK((f.learn.rls.count == 0) == (mode != CURVE_LIVE));
  }
}

TEST(outer_teaches_nothing_after_a_saturated_command) {
  flight_param_t p;
  vehicle_t v;
  outer_t f = in_flight(&p, &v);
  p.step_max_N = 1.0f;
  outer_in_t in = sense(&v, (v3_t){0, 0, 5.0f});
  in.setpoint.acc_w_mps2.z = 50.0f;
  in.thrust_N = 0.45f;
  const outer_out_t out = step_and_learn(&f, &p, &in);
  CHECK(out.thrust_N == p.pos.thrust_max_N);
  const unsigned count = f.learn.rls.count;
  for (int k = 1; k < 50; k++) {
    ROW("tick %d", k);
    in = sense(&v, (v3_t){0, 0, 0.94f});
    (void)step_and_learn(&f, &p, &in);
    if (k <= 19) CHECK(f.learn.rls.count == count);
  }
  CHECK(f.learn.rls.count > count);
}
