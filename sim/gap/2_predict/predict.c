// predict.c - the model's derivative at measured states and logged commands.
#include "gap/2_predict/predict.h"

#include "gap/2_predict/eight.h"
#include "gap/2_predict/holds.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- one point --------------------------------------------------------------------------------------------

// Sets thrusts, and commands with which a plain lag changes them as fast as they did: the vehicle's own lag
// is in them already.
static void place_motors(body_t *b, const lagged_t *motors, int j) {
  b->rigid.plain_lag = true;
  for (int k = 0; k < ROTORS; k++) {
    b->y[RIGID_THRUST_N + k] = motors->thrust_N[k][j];
    b->rigid.command_N[k] = motors->thrust_N[k][j] + motors->rise_Nps[k][j] * b->rigid.motor_tau_s;
  }
}

static void in_sight(const grid_t *g, const model_t *m, const grid_point_t *p, const axes_t *axes,
                     fx_sensed_t *sight) {
  sight->acc_b_mps2 = d3(0.0, 0.0, 0.0);
  predict_sight(g, m, p, axes_up_b(axes).z, &sight->range_m, &sight->range_rate_mps);
}

// Computes readings and turning from `look` and `sight`.
static void predict(const body_t *b, passed_t *at) {
  at->sensed = at->sight;
  at->sensed.acc_b_mps2 = body_pull_b_mps2(b, b->y, &at->look, &at->turn_radps2);
  model_sense(b->model, &at->sensed);
}

static void put(const fx_sensed_t *sensed, d3_t turn_radps2, int j, double *const out[CHANNELS]) {
  double now[CHANNELS];
  d3_put(now, sensed->acc_b_mps2);
  d3_put(now + CH_WX, turn_radps2);
  now[CH_RANGE] = sensed->range_m;
  for (int c = 0; c < CHANNELS; c++) out[c][j] = now[c];
}

// --- the whole --------------------------------------------------------------------------------------------

static void keep(path_t *path, const body_t *b, passed_t *at, int j) {
  rigid_t now = b->rigid;
  memset(now.command_N, 0, sizeof now.command_N);
  if (j == 0 || memcmp(&now, &path->rigid[path->n_rigid - 1], sizeof now) != 0)
    path->rigid[path->n_rigid++] = now;
  at->rigid = path->n_rigid - 1;
  at->air_w_mps = b->plant.air_w_mps;
  path->at[j] = *at;
}

// Copies axes, rotors and surroundings by member: a copy of the whole waits for its own stores.
static void take_look(const body_look_t *from, body_look_t *to) {
  to->axes = from->axes;
  memcpy(to->ratio, from->ratio, sizeof to->ratio);
  memcpy(to->speed_radps, from->speed_radps, sizeof to->speed_radps);
  memcpy(to->turning, from->turning, sizeof to->turning);
}

// True if the rotors are at the same places, and turn faster by the same shares.
static bool same_rotors(const rigid_t *a, const rigid_t *b) {
  bool same = true;
  for (int i = 0; i < ROTORS; i++)
    same = same && a->rotor_x_m[i] == b->rotor_x_m[i] && a->rotor_y_m[i] == b->rotor_y_m[i] &&
           a->rotor_z_m[i] == b->rotor_z_m[i] && a->faster[i] == b->faster[i];
  return same;
}

// Finds what acts at a point. known: null, or the replay of a model that differs in effects at ticks only,
// with the same motors.
static void look_at(const body_t *b, const grid_t *g, const path_t *known, int j, passed_t *at) {
  const passed_t *const was = known ? &known->at[j] : NULL;
  if (was && same_rotors(&b->rigid, &known->rigid[was->rigid])) {
    take_look(&was->look, &at->look);
    body_look_load(b, b->y, &at->look);
    at->sight = was->sight;
    return;
  }
  body_look(b, 0, b->y, &at->look);
  in_sight(g, b->model, &g->point[j], &at->look.axes, &at->sight);
}

static void pass(body_t *b, const grid_t *g, const lagged_t *motors, const path_t *known, int j,
                 passed_t *at) {
  predict_place(b, &g->point[j]);
  b->t_s = g->point[j].t_s - g->point[0].t_s;
  place_motors(b, motors, j);
  if (b->n_tick > 0) body_effects(b, g->period_s);
  b->rigid.plain_lag = true; // effects may have reset it
  look_at(b, g, known, j, at);
  predict(b, at);
}

static void pass_alone(body_t *b, const grid_t *g, const lagged_t *motors, int j,
                       double *const out[CHANNELS]) {
  passed_t at;
  pass(b, g, motors, NULL, j, &at);
  put(&at.sensed, at.turn_radps2, j, out);
}

// Puts the body at the first point, and returns its motors. Null: no memory.
static const lagged_t *start(grid_t *g, body_t *b) {
  predict_place(b, &g->point[0]);
  if (b->n_tick > 0) body_effects(b, g->period_s); // may change lag and delay
  const lag_t lag = rigid_lag(&b->rigid);
  return grid_motors(g, &lag, b->plant.delay_s);
}

static bool same_motors(const path_t *known, const body_t *b) {
  const lag_t lag = rigid_lag(&b->rigid);
  return known && grid_same_motors(&known->lag, known->delay_s, &lag, b->plant.delay_s);
}

static done_t run_points(grid_t *g, body_t *b, const lagged_t *motors, const path_t *known, path_t *path,
                         double *const out[CHANNELS], why_t *why) {
  if (path) path->lag = rigid_lag(&b->rigid), path->delay_s = b->plant.delay_s;
  if (!same_motors(known, b)) known = NULL;
  if (path ? eight_keep(g, b, motors, path, out) : known && eight_again(g, b, known, out)) return DONE;
  if (!path && eight_replay(g, b, motors, pass_alone, out)) return DONE;
  if (path && !(path->at = malloc((size_t)g->n * sizeof(passed_t))))
    return error_failed(why, "out of memory");
  if (known && !known->at) known = NULL;
  for (int j = 0; j < g->n; j++) {
    passed_t at;
    pass(b, g, motors, known, j, &at);
    if (path) keep(path, b, &at, j);
    put(&at.sensed, at.turn_radps2, j, out);
  }
  return DONE;
}

static done_t run(grid_t *g, body_t *b, const path_t *known, path_t *path, double *const out[CHANNELS],
                  why_t *why) {
  const lagged_t *const motors = start(g, b);
  if (!motors) return error_failed(why, "out of memory");
  const rigid_t first = b->rigid;
  TRY(run_points(g, b, motors, known, path, out, why));
  holds_add(g, &first, motors, out);
  return DONE;
}

static done_t open_body(body_t *b, const grid_t *g, const model_t *m, why_t *why) {
  const body_start_t start = {.seed = 1};
  if (body_open(b, m, INTEGRATE_RK4, g->period_s, &start) == DONE) return DONE;
  return error_failed(why, "%s: a model that cannot be replayed", m->name);
}

static done_t replay_into(grid_t *g, const model_t *m, const path_t *known, path_t *path,
                          double *const out[CHANNELS], why_t *why) {
  body_t b;
  if (g->n == 0) return DONE;
  TRY(open_body(&b, g, m, why));
  const done_t status = run(g, &b, known, path, out, why);
  body_close(&b);
  return status;
}

done_t replay(grid_t *g, const model_t *m, double *const out[CHANNELS], why_t *why) {
  return replay_into(g, m, NULL, NULL, out, why);
}

// --- one effect more --------------------------------------------------------------------------------------

done_t replay_keep(grid_t *g, const model_t *m, path_t *path, double *const out[CHANNELS], why_t *why) {
  const size_t n = (size_t)g->n + 1;
  *path = (path_t){.model = m, .rigid = malloc(n * sizeof(rigid_t))};
  if (!path->rigid) return error_failed(why, "out of memory");
  return replay_into(g, m, NULL, path, out, why);
}

void path_free(path_t *path) {
  free(path->at);
  free(path->rigid);
  free(path->kept);
  *path = (path_t){.at = NULL};
}

// Replays an effect that moves the vehicle.
static void run_moved(const grid_t *g, body_t *b, const path_t *path, const lagged_t *motors,
                      const fx_use_t *more, double *const out[CHANNELS]) {
  for (int j = 0, rigid = -1; j < g->n; j++) {
    passed_t at;
    const passed_t *const was = &path->at[j];
    take_look(&was->look, &at.look);
    at.look.load = was->look.load;
    at.look.loaded = was->look.loaded;
    at.sight = was->sight;
    predict_place(b, &g->point[j]);
    if (was->rigid != rigid) b->rigid = path->rigid[rigid = was->rigid];
    b->plant.air_w_mps = was->air_w_mps;
    place_motors(b, motors, j);
    body_look_more(b, more, b->y, &at.look);
    predict(b, &at);
    put(&at.sensed, at.turn_radps2, j, out);
  }
}

// Replays an effect on sensors only.
static void run_sensed(const grid_t *g, const path_t *path, const fx_use_t *more,
                       double *const out[CHANNELS]) {
  for (int j = 0; j < g->n; j++) {
    fx_sensed_t sensed = path->at[j].sensed;
    more->fx->sense(more, &sensed);
    put(&sensed, path->at[j].turn_radps2, j, out);
  }
}

static bool has(const model_t *m, const fx_t *fx) {
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx == fx) return true;
  return false;
}

// Replays any other effect: of both kinds, at ticks, or in place of the model's own.
static done_t run_anew(grid_t *g, const path_t *path, const fx_use_t *more, double *const out[CHANNELS],
                       why_t *why) {
  model_t m = *path->model;
  const bool changes = !more->fx->excess && !more->fx->sense && !has(&m, more->fx);
  TRY(model_add_fx(&m, more, why));
  return replay_into(g, &m, changes ? path : NULL, NULL, out, why);
}

// Replays either of the two. False: what was kept does not allow it.
static bool run_more(grid_t *g, body_t *b, const path_t *path, const lagged_t *motors, const fx_use_t *more,
                     double *const out[CHANNELS]) {
  if (eight_more(g, b, path, more, out)) return true;
  if (!path->at) return false;
  if (more->fx->sense)
    run_sensed(g, path, more, out);
  else
    run_moved(g, b, path, motors, more, out);
  return true;
}

done_t replay_with(grid_t *g, const path_t *path, const fx_use_t *more, double *const out[CHANNELS],
                   why_t *why) {
  const fx_t *const fx = more->fx;
  const bool moves = fx->load || fx->excess;
  if (fx->tick || moves == (fx->sense != NULL) || has(path->model, fx))
    return run_anew(g, path, more, out, why);
  body_t b;
  if (g->n == 0) return DONE;
  TRY(open_body(&b, g, path->model, why));
  const lagged_t *const motors = start(g, &b);
  const rigid_t first = b.rigid;
  const bool done = motors && run_more(g, &b, path, motors, more, out);
  if (done) holds_add(g, &first, motors, out);
  body_close(&b);
  if (!motors) return error_failed(why, "out of memory");
  return done ? DONE : run_anew(g, path, more, out, why);
}
