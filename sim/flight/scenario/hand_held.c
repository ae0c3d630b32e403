// hand_held.c - the vehicle, motors off, carried by hand up to the ceiling in steps of 2 cm (thesis figures
// C.1 to C.6), and the ceiling's height by algorithm 1: estimated height + estimated distance.
//
//   each sensor sample:  zc += 0.1 (range - zc)
//   each 10 ms:          zc -= climb in these 10 ms
//
// With the gate this is the flight code's own (flight/ceiling.h, with all that it adds to the thesis),
// without it the two lines above. Nearer than its floor of 4 cm the upward sensor is wrong, and how it is
// wrong decides where the estimate without the gate goes: a sensor that stays at 40 mm (as here in flight)
// lifts the ceiling; one that says 0, as the thesis saw ("a distance of 0 cm is a wrong measurement"), lets
// it fall. Both are simulated, with and without gate.
#include "flight/scenario.h"

#include "base/constants.h"
#include "flight/ceiling.h"
#include "flight/drawn.h"
#include "sense/ekf.h"

#include <math.h>
#include <stdlib.h>

#define FIRST_GAP_M 0.20
#define STEP_M      0.02
#define STEPS       10 // 20, 18, ... 2 cm
#define REST_S      3.0
#define LIFT_S      6.0 // to the first gap, its hold included
#define HOLD_S      4.0
#define MOVE_S      1.0
#define GAIN        0.1
#define UP_AGE_S    0.07 // age of an upward sample, as the app assumes it
#define TICK_MS     10

typedef struct {
  bool gate, says_0;
  ceiling_t ceiling; // with the gate
  bool known;        // without it
  double zc_m;
} algorithm1_t;

static void predict(algorithm1_t *a, const ceiling_param_t *p, double climb_m) {
  a->zc_m -= climb_m;
  if (a->gate) ceiling_predict(&a->ceiling, p, (float)climb_m);
}

static void correct(algorithm1_t *a, const ceiling_param_t *p, double range_m, bool at_floor) {
  const double measured_m = a->says_0 && at_floor ? 0.0 : range_m;
  // A sample that the flight code refuses changes nothing.
  if (a->gate) (void)!ceiling_correct(&a->ceiling, p, (float)measured_m, (float)UP_AGE_S);
  if (!a->known) a->zc_m = measured_m;
  a->known = true;
  a->zc_m += GAIN * (measured_m - a->zc_m);
}

// Returns the ceiling's height: that of the rotors' plane plus the distance; NaN: none known.
static double height_of(const algorithm1_t *a, double height_m) {
  if (!a->gate) return height_m + a->zc_m;
  return a->ceiling.known ? height_m + (double)a->ceiling.zc_m : (double)NAN;
}

typedef struct {
  const model_t *model;
  const noise_t *noise;
  random_t *random;
  imu_t imu;
  range_t range;
  ekf_t ekf;
  ceiling_param_t param;
  double height_m, height_last_m; // estimated, of the rotors' plane: now, and at the last tick of 10 ms
  algorithm1_t way[4];
} hand_t;

static double gap_of(int step) {
  return FIRST_GAP_M - STEP_M * step;
}

// Returns the height of the rotors' plane: at rest, lifted, then step by step, with continuous acceleration.
static double path_m(const model_t *model, double t_s) {
  const double rest_m = body_rest_z_m(model) + body_rotor_z_m(model);
  const double since_s = t_s - REST_S - LIFT_S;
  const int step = since_s < 0.0 ? 0 : (int)(since_s / HOLD_S) + 1;
  const double from_m = step == 0 ? rest_m : model->ceiling_m - gap_of(step - 1);
  const double to_m = model->ceiling_m - gap_of(step);
  const double moved_s = step == 0 ? t_s - REST_S : since_s - HOLD_S * (step - 1);
  const double x = fmin(fmax(moved_s / (step == 0 ? 0.5 * LIFT_S : MOVE_S), 0.0), 1.0);
  return from_m + (to_m - from_m) * x * x * x * (10.0 + x * (-15.0 + x * 6.0));
}

static truth_t carried(const model_t *model, double t_s) {
  const double h = 1e-3, now_m = path_m(model, t_s);
  const double before_m = path_m(model, t_s - h), after_m = path_m(model, t_s + h);
  const double z_m = now_m - body_rotor_z_m(model);
  return (truth_t){
      .pos_w_m = {0.0, 0.0, z_m},
      .vel_w_mps = {0.0, 0.0, (after_m - before_m) / (2.0 * h)},
      .q_wb = {1.0, 0.0, 0.0, 0.0},
      .force_b_mps2 = {0.0, 0.0, (after_m - 2.0 * now_m + before_m) / (h * h) + G_MPS2},
      .up_m = model->ceiling_m - now_m,
      .down_m = z_m - body_rest_z_m(model),
  };
}

static void hand_ms(hand_t *s, long ms) {
  const truth_t truth = carried(s->model, 1e-3 * (double)ms);
  const imu_sample_t imu = imu_step(&s->imu, &s->noise->imu, s->random, &truth);
  const range_sample_t range = range_step(&s->range, &s->noise->range, s->random, &truth);
  const ekf_in_t in = {
      .imu = imu,
      .range_new = range.down_new,
      .range_m = range.down_m,
      .flow_new = range.flow_new,
      .flow_x = range.flow_x,
      .flow_y = range.flow_y,
      .flow_span_s = range.flow_span_s,
  };
  s->height_m = ekf_step(&s->ekf, &in).pos_w_m.z + body_rest_z_m(s->model) + body_rotor_z_m(s->model);
  // A new upward sample falls on a tick, of which its period is a multiple.
  if (ms % TICK_MS != 0) return;
  const double climb_m = s->height_m - s->height_last_m;
  s->height_last_m = s->height_m;
  for (int i = 0; i < 4; i++) {
    predict(&s->way[i], &s->param, climb_m);
    if (range.up_new && range.up_mm < RANGE_UP_NOTHING_MM)
      correct(&s->way[i], &s->param, 1e-3 * range.up_mm, range.up_mm <= RANGE_UP_FLOOR_MM);
  }
}

static void tell(const hand_t *s, int step, result_t *result) {
  static const char *const name[] = {"stays_40_no_gate_mm", "stays_40_gate_mm", "says_0_no_gate_mm",
                                     "says_0_gate_mm"};
  cJSON *row = result_add_row(result, "ceiling_height");
  cJSON_AddNumberToObject(row, "gap_mm", 1e3 * gap_of(step));
  cJSON_AddNumberToObject(row, "height_mm", 1e3 * s->height_m);
  for (int i = 0; i < 4; i++) cJSON_AddNumberToObject(row, name[i], 1e3 * height_of(&s->way[i], s->height_m));
}

static void carry(hand_t *s, result_t *result) {
  imu_init(&s->imu);
  range_init(&s->range);
  ekf_init(&s->ekf, &ekf_firmware, 0.0);
  for (int i = 0; i < 4; i++) ceiling_init(&s->way[i].ceiling, 1e-3f * TICK_MS);
  long ms = 0;
  for (int step = 0; step < STEPS; step++) {
    const long until = lround(1e3 * (REST_S + LIFT_S + HOLD_S * step));
    while (ms < until) hand_ms(s, ms++);
    tell(s, step, result);
  }
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  if (request->kind || request->n_set > 0 || request->n_effect > 0 || request->no_effects ||
      request->integrate != INTEGRATE_SUNDIALS || request->log_500_Hz || request->log_calls)
    return error_set(why,
                     "--controller, --set, --effect, --integrator, --log-rate: in hand-held nobody flies; "
                     "allowed are --vehicle, --noise, --seed");
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI, why));
  TRY(setup_apply(&setup, request, why));
  TRY(scenario_check_ladder(&setup.model, why));
  drawn_t drawn;
  TRY(drawn_of(&setup.plan.noise.vary, request->seed, &drawn, why));
  drawn_sense(&drawn, &setup.plan.noise);
  hand_t *s = calloc(1, sizeof *s);
  if (!s) return error_failed(why, "out of memory");
  *s = (hand_t){
      .model = &setup.model,
      .noise = &setup.plan.noise,
      .random = random_open(request->seed),
      .param = setup.flight.ceiling,
      .way = {{.says_0 = false}, {.gate = true}, {.says_0 = true}, {.gate = true, .says_0 = true}},
  };
  const done_t status = s->random ? DONE : error_failed(why, "out of memory");
  if (status == DONE) carry(s, result);
  random_close(s->random);
  free(s);
  return status;
}

const scenario_t scenario_hand_held = {
    .name = "hand-held",
    .brief = "carried up to the ceiling by hand: the ceiling's height by algorithm 1, with and without gate "
             "(thesis C.3)",
    .run = run,
};
