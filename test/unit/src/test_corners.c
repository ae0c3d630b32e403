// test_corners.c - hover in closed loop with parameters at the ends of their ranges, while calls are missed:
// ten seconds 0.5 m below a ceiling. SEED=N takes other sets and noise.
#include "rig/flight_state.h"
#include "rig/splitmix.h"
#include "rig/rig6.h"
#include "rig/share.h"
#include "rig/test.h"

#include <string.h>

#define HOVER_M   1.0
#define CEILING_M 1.5
#define FLOWN_MS  10000
#define OFF_M     0.1
#define MOST_N    0.15 // of a motor: more it does not have, whatever it is asked for

typedef struct {
  flight_t f;
  rig6_t rig;
  splitmix_t random;
  int missed_ms; // still to come
  double off_m;  // farthest from where it should hover, over the second half
} corner_t;

static v3_t v3_of(d3_t a) {
  return (v3_t){(float)a.x, (float)a.y, (float)a.z};
}

static d3_t shaken(splitmix_t *r, d3_t a, double sd) {
  return (d3_t){a.x + splitmix_normal(r, sd), a.y + splitmix_normal(r, sd), a.z + splitmix_normal(r, sd)};
}

static flight_in_t seen(corner_t *c, int ms) {
  const pilot_setpoint_t none = {.yaw_rad = 0.0};
  const pilot_in_t in = rig6_sense(&c->rig, &none);
  const double up = dq_to_world(in.q_wb, d3(0.0, 0.0, 1.0)).z;
  flight_in_t to = {
      .step = (uint32_t)ms,
      .rate_b_radps = v3_of(shaken(&c->random, in.gyro_b_radps, 0.02)),
      .acc_b_mps2 = v3_of(shaken(&c->random, in.acc_b_mps2, 0.3)),
      .pos_w_m = v3_of(shaken(&c->random, in.pos_w_m, 0.0005)),
      .vel_w_mps = v3_of(shaken(&c->random, in.vel_w_mps, 0.01)),
      .q_wb = {(float)in.q_wb.w, (float)in.q_wb.x, (float)in.q_wb.y, (float)in.q_wb.z},
      .range_new = ms % 100 == 0,
      .range_m = up > 0.5 ? (float)((CEILING_M - in.pos_w_m.z) / up) : 0.0f,
      .range_age_s = 0.02f,
      .setpoint = {.x = AXIS_POSITION,
                   .y = AXIS_POSITION,
                   .z = AXIS_POSITION,
                   .pos_w_m = {.z = (float)HOVER_M}},
  };
  for (int i = 0; i < MOTORS; i++) to.force_N[i] = (float)in.applied_N[i];
  return to;
}

// One call in fifty begins a hole of up to 20 ms.
static bool is_called(corner_t *c) {
  if (c->missed_ms > 0) {
    c->missed_ms--;
    return false;
  }
  if (splitmix_bits(&c->random) % 50 == 0) c->missed_ms = (int)(splitmix_bits(&c->random) % 20);
  return true;
}

static bool think(corner_t *c, int ms, double motor_N[MOTORS]) {
  const flight_in_t in = seen(c, ms);
  const flight_out_t *out = flight_step(&c->f, &in);
  for (int i = 0; i < MOTORS; i++) {
    const float N = out->motors.force_N[i];
    if (!CHECK(N >= 0.0f && N <= c->f.outer.param.mixer.force_max_N)) return false;
    motor_N[i] = fmin((double)N, MOST_N);
  }
  const char *bad = flight_not_finite(&c->f);
  if (bad) ROW("%s", bad);
  return CHECK(bad == NULL);
}

// False: something was not finite or beyond what may be asked for.
static bool hover(corner_t *c, const flight_param_t *p, uint64_t seed) {
  rig6_param_t body = rig6_crazyflie();
  body.ceiling_m = CEILING_M;
  body.floor = true;
  *c = (corner_t){.rig = rig6_at(&body, d3(0.0, 0.0, HOVER_M), 0.0, true), .random = {seed}};
  CHECK_OK(flight_init(&c->f, p));
  double motor_N[MOTORS];
  for (int i = 0; i < MOTORS; i++) motor_N[i] = c->rig.command_N[i];
  for (int ms = 0; ms < FLOWN_MS; ms++) {
    if (is_called(c) && !think(c, ms, motor_N)) return false;
    rig6_step(&c->rig, motor_N);
    const double off_m = d3_norm(d3_sub(c->rig.pos_w_m, d3(0.0, 0.0, HOVER_M)));
    if (ms > FLOWN_MS / 2 && !(off_m <= c->off_m)) c->off_m = off_m;
  }
  return true;
}

static void at_end(flight_param_t *p, const param_row_t *row, bool most) {
  (void)!params_set(p, row, most ? row->max : row->min); // what its row allows, if not what the set does
}

// Alone these take the hover away, as they must: a loop that is too slow or too fast for the vehicle, a
// vehicle of another size, motors that may not carry it.
static const struct {
  const char *name;
  bool most, at_the_edge; // at the edge: the noise decides
} unflyable[] = {
    {"indiPos.kp", true, false},      {"indiPos.kd", false, false},    {"indiPos.kdz", false, false},
    {"indiPos.tauMot", false, false}, {"indiPos.mass", false, true},   {"indiPos.tMax", false, false},
    {"indiAtt.kp", false, false},     {"indiAtt.kp", true, false},     {"indiAtt.kd", false, false},
    {"indiAtt.jxx", false, false},    {"indiAtt.jxx", true, false},    {"indiAtt.jyy", false, false},
    {"indiAtt.jyy", true, false},     {"indiAtt.quick", false, false}, {"indiAtt.arm", false, false},
    {"indiAtt.arm", true, false},     {"indiAtt.yawArm", true, true},  {"indiAtt.fMax", false, false},
    {"indiAtt.jzz", false, true},     {"indiAtt.g2", true, true},      {"indiAtt.kpYaw", true, true},
};
static const int unflyable_count = sizeof unflyable / sizeof *unflyable;

static int find_unflyable(const char *name, bool most) {
  int i = 0;
  while (i < unflyable_count && (strcmp(unflyable[i].name, name) != 0 || unflyable[i].most != most)) i++;
  return i;
}

TEST(a_parameter_at_an_end_of_its_range_hovers_is_refused_or_is_known_not_to) {
  int known = 0;
  for (int i = 0; i < params_count; i++)
    for (int most = 0; most < 2; most++) {
      const param_row_t *row = &params_table[i];
      flight_param_t p;
      params_default(&p);
      at_end(&p, row, most);
      if (params_check(&p) != ST_OK) continue;
      corner_t c;
      ROW("%s at its %s", row->name, most ? "greatest" : "least");
      if (!hover(&c, &p, share_seed(1) + (uint64_t)i)) return;
      const int which = find_unflyable(row->name, most);
      const bool is_known = which < unflyable_count;
      known += is_known;
      CHECK((c.off_m < OFF_M) != is_known || (is_known && unflyable[which].at_the_edge));
    }
  CHECK(known == unflyable_count); // none of a name that is no more, or that is refused
}

TEST(parameters_at_their_ends_together_stay_finite_and_within_limits_or_are_refused) {
  const int count = test_long() ? 4000 : 100;
  splitmix_t r = {share_seed(1)};
  int flown = 0;
  for (int k = 0; k < count; k++) {
    flight_param_t p;
    params_default(&p);
    const uint64_t some = 1 + splitmix_bits(&r) % 16;
    for (int i = 0; i < params_count; i++)
      if (splitmix_bits(&r) % 16 < some) at_end(&p, &params_table[i], splitmix_bits(&r) % 2);
    ROW("set %d", k);
    if (params_check(&p) != ST_OK) {
      flight_t f;
      CHECK_STATUS(ST_BAD_PARAM, flight_init(&f, &p));
      continue;
    }
    corner_t c;
    if (!hover(&c, &p, splitmix_bits(&r))) return;
    flown++;
  }
  CHECK(flown >= count / 8);
}
