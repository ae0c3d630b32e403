// test_gap_own_work.c - a delay, a lag, an inertia or a slope that is control's answer to a draught.
#include "body/body.h"
#include "exam/flights.h"
#include "gap/diagnose.h"
#include "rig/test.h"

#include <stdlib.h>

// Flown by a cascade without any lead: it answers late.
#define RATE_GAIN 9.8  // 1/s
#define TILT_GAIN 30.0 // 1/s2
#define SPAN_S    40.0

// A moment that comes and goes within a tenth of a second, as an angular acceleration, less about z; and a
// breath of air.
#define DRAUGHT_S   0.1
#define BREATH_MPS2 0.02
static const double DRAUGHT_RADPS2[] = {0.4, 0.4, 0.16};

static const signal_id_t SEEN[] = {SIG_X,  SIG_Y,  SIG_Z,  SIG_VX, SIG_VY, SIG_VZ, SIG_AX,
                                   SIG_AY, SIG_AZ, SIG_QW, SIG_QX, SIG_QY, SIG_QZ, SIG_GX,
                                   SIG_GY, SIG_GZ, SIG_M1, SIG_M2, SIG_M3, SIG_M4};
enum { N_SEEN = sizeof SEEN / sizeof *SEEN };

typedef struct {
  body_t body;
  random_t *random;
  double moment_Nm[3], force_N[3];
  bool moves; // briskly, from place to place; else it is left where it is
  d3_t at_m;  // where it is to be
} draught_t;

static d3_t noisy(const draught_t *d, d3_t v, double sd) {
  const double x = sd * random_normal(d->random), y = sd * random_normal(d->random),
               z = sd * random_normal(d->random);
  return d3_add(v, d3(x, y, z));
}

static void blow(draught_t *d, const model_t *m) {
  const double keep = exp(-EXAM_TICK_S / DRAUGHT_S), fresh = sqrt(1.0 - keep * keep);
  for (int i = 0; i < 3; i++) {
    const double moment_Nm = DRAUGHT_RADPS2[i] * m->frame.inertia_kgm2[i], force_N = BREATH_MPS2 * m->mass_kg;
    d->moment_Nm[i] = keep * d->moment_Nm[i] + fresh * moment_Nm * random_normal(d->random);
    d->force_N[i] = keep * d->force_N[i] + fresh * force_N * random_normal(d->random);
  }
  body_shake(&d->body, (push_t){d3_of(d->force_N), d3_of(d->moment_Nm)});
}

// One row; what it commands by it.
static void steer(draught_t *d, const model_t *m, double row[N_SEEN]) {
  const double *const y = d->body.y;
  const d3_t pos = noisy(d, d3_of(y + RIGID_POS_M), 1e-3), vel = noisy(d, d3_of(y + RIGID_VEL_MPS), 5e-3),
             acc = noisy(d, body_specific_force_b_mps2(&d->body), 0.1),
             rate = noisy(d, d3_of(y + RIGID_RATE_RADPS), 5e-3), angle = noisy(d, d3(0.0, 0.0, 0.0), 5e-4);
  const dq_t q =
      dq_mul(dq_of(y + RIGID_Q_WB), dq_unit((dq_t){1.0, 0.5 * angle.x, 0.5 * angle.y, 0.5 * angle.z}));
  const axes_t axes = axes_of(q);
  const d3_t off = d3_sub(d->at_m, pos);
  const double kp = d->moves ? 1.5 : 0.5, kd = d->moves ? 2.0 : 1.2; // 1/s2, 1/s
  const d3_t want = d3(kp * off.x - kd * vel.x, kp * off.y - kd * vel.y, G_MPS2 + 3.0 * off.z - 3.0 * vel.z);
  const d3_t pull = axes_to_body(&axes, d3_scale(1.0 / d3_norm(want), want));
  const d3_t nose = axes_to_body(&axes, d3(1.0, 0.0, 0.0));
  const double turn[] = {-TILT_GAIN * pull.y - RATE_GAIN * rate.x, TILT_GAIN * pull.x - RATE_GAIN * rate.y,
                         6.0 * nose.y - 4.0 * rate.z};
  double moment_Nm[3], motor_N[ROTORS];
  for (int i = 0; i < 3; i++) moment_Nm[i] = turn[i] * m->frame.inertia_kgm2[i];
  model_mix(&m->frame, m->mass_kg * want.z, moment_Nm, motor_N);
  const double now[] = {pos.x,      pos.y,      pos.z - body_rest_z_m(m),
                        vel.x,      vel.y,      vel.z,
                        acc.x,      acc.y,      acc.z,
                        q.w,        q.x,        q.y,
                        q.z,        rate.x,     rate.y,
                        rate.z,     motor_N[0], motor_N[1],
                        motor_N[2], motor_N[3]};
  for (int k = 0; k < N_SEEN; k++) row[k] = now[k];
}

// About one place, or from one to the next every two seconds.
static void fly_in_draught(const model_t *truth, bool moves, uint64_t seed, gap_flight_t *f) {
  const int n = (int)(SPAN_S / EXAM_TICK_S);
  draught_t d = {.random = random_open(seed), .moves = moves};
  body_start_t at = {.pos_w_m = {0.0, 0.0, 0.6}, .seed = seed};
  for (int k = 0; k < ROTORS; k++) at.thrust_N[k] = 0.25 * truth->mass_kg * G_MPS2;
  CHECK_OK(body_open(&d.body, truth, INTEGRATE_RK4, EXAM_TICK_S, &at));
  *f = (gap_flight_t){.name = "a draught", .motors_N = true, .rate_Hz = 1.0 / EXAM_TICK_S, .n = n};
  f->t_s = malloc((size_t)n * sizeof(double));
  for (int k = 0; k < N_SEEN; k++) f->v[SEEN[k]] = malloc((size_t)n * sizeof(double));
  for (int i = 0; i < n; i++) {
    double row[N_SEEN];
    const int leg = moves ? (int)(i * EXAM_TICK_S / 2.0) : 0;
    d.at_m = d3(0.4 * (leg & 1), 0.4 * (leg >> 1 & 1), 0.6 + 0.3 * (leg >> 2 & 1));
    blow(&d, truth);
    steer(&d, truth, row);
    f->t_s[i] = i * EXAM_TICK_S;
    for (int k = 0; k < N_SEEN; k++) f->v[SEEN[k]][i] = row[k];
    body_tick(&d.body, row + N_SEEN - ROTORS, EXAM_TICK_S);
  }
  body_close(&d.body);
  random_close(d.random);
}

TEST(gap_takes_control_that_answers_a_draught_for_no_effect) {
  static const struct {
    const char *what, *hidden;
    double value, motors_s, within;
    bool moves;
    uint64_t seed;
  } row[] = {{"slow motors, a hover", NULL, 0.0, 0.05, 0.0, false, 25},
             {"quicker ones", NULL, 0.0, 0.03, 0.0, false, 6},
             {"slower ones, which seem to turn more", NULL, 0.0, 0.07, 0.0, false, 300},
             {"commands that are late", "delay", 0.03, 0.05, 0.004, true, 8},
             {"slower motors", "motor_lag", 0.03, 0.03, 0.004, true, 9},
             {"a flatter thrust", "thrust_slope", -0.3, 0.03, 0.05, true, 10}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    model_t given, truth;
    gap_flight_t flight;
    diagnosis_t d;
    why_t why = {""};
    ROW("%s", row[i].what);
    CHECK_OK(exam_vehicle(&given, &why));
    given.motor_tau_s = row[i].motors_s;
    truth = given;
    if (row[i].hidden) {
      fx_use_t use = fx_use(fx_find(row[i].hidden));
      use.p[0] = row[i].value;
      CHECK_OK(model_add_fx(&truth, &use, &why));
    }
    fly_in_draught(&truth, row[i].moves, row[i].seed, &flight);
    const diagnose_job_t job = {.fit = &(gap_flights_t){&flight, 1}, .model = &given, .seed = 1};
    CHECK_OK(diagnose(&job, &d, &why));
    if (!row[i].hidden)
      CHECK(d.found.n == 0);
    else if (CHECK(d.found.n == 1 && d.found.chosen.use[0].fx == fx_find(row[i].hidden)))
      CHECK_NEAR(d.found.named[0].value[0], row[i].value, row[i].within);
    diagnosis_free(&d);
    gap_flight_free(&flight);
  }
}
