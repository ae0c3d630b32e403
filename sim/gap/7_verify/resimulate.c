// resimulate.c - the held-out flight flown again by a model.
#include "gap/7_verify/resimulate.h"

#include <math.h>
#include <stdlib.h>

#define PILOT_STEP_S 0.002
#define LEVEL        2.0 // 1/s, horizontal: position error to velocity (as the nominal flights' pilot)
#define PUSH         3.0 // 1/s, horizontal: velocity error to acceleration
// Least stiffness in height: a ceiling pulls harder the nearer the vehicle is (thesis 3.1.4), and a pilot
// that is softer than that loses the right model as well as the wrong one.
#define HEIGHT 16.0 // 1/s2
#define CLIMB  8.0  // 1/s

typedef struct {
  const grid_t *g;
  const model_t *pilots; // whose mass and rotors the pilot assumes: the same for every model
  const closed_loop_t *loop;
  int turn; // the one whose points count; below 0: all points do
  body_t body;
} flight_again_t;

// --- the pilot ------------------------------------------------------------------------------------------

static void correct(const flight_again_t *a, const grid_point_t *track, double motor_N[ROTORS]) {
  const frame_t *f = &a->pilots->frame;
  const closed_loop_t *w = a->loop;
  const double *y = a->body.y;
  const axes_t axes = axes_of(dq_of(y + RIGID_Q_WB)), wanted = axes_of(track->q_wb);
  const d3_t off = d3_sub(track->pos_w_m, d3_of(y + RIGID_POS_M));
  const d3_t slip = d3_sub(track->vel_w_mps, d3_of(y + RIGID_VEL_MPS));
  const d3_t turn = d3_sub(track->rate_b_radps, d3_of(y + RIGID_RATE_RADPS));
  const d3_t push = d3(PUSH * (LEVEL * off.x + slip.x), PUSH * (LEVEL * off.y + slip.y), 0.0);
  // Where the thrust should point: as it was measured, and towards the track.
  const d3_t up_w = d3_add_scaled(wanted.z, 1.0 / G_MPS2, push);
  const d3_t pull_b = axes_to_body(&axes, d3_scale(1.0 / d3_norm(up_w), up_w));
  const d3_t nose_b = axes_to_body(&axes, wanted.x);
  const double moment_Nm[] = {
      f->inertia_kgm2[0] * (w->tilt_gain * -pull_b.y + w->rate_gain[0] * turn.x),
      f->inertia_kgm2[1] * (w->tilt_gain * pull_b.x + w->rate_gain[1] * turn.y),
      f->inertia_kgm2[2] * w->rate_gain[2] * (2.0 * atan2(nose_b.y, nose_b.x) + turn.z),
  };
  const double lift =
      a->pilots->mass_kg * (fmax(w->height_gain, HEIGHT) * off.z + fmax(w->climb_gain, CLIMB) * slip.z);
  double more_N[ROTORS];
  model_mix(f, lift, moment_Nm, more_N);
  for (int k = 0; k < ROTORS; k++)
    motor_N[k] = fmax(0.0, fmin(motor_N[k] + more_N[k], 0.25 * a->pilots->thrust_max_N));
}

// --- the flight -----------------------------------------------------------------------------------------

// Returns the sample with which a point begins, by its time. Counting would not do: points leave out what a
// segment's end cuts off, samples what a gap in time does.
static int sample_of(const grid_t *g, int j) {
  const double log_s = g->period_s / g->every, from_s = g->point[j].t_s - 0.5 * g->every * log_s;
  const double *const t_s = g->flight->t_s + g->from;
  int low = 0, high = g->samples - g->every;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (t_s[middle] < from_s)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static done_t put(flight_again_t *a, const model_t *m, int j, why_t *why) {
  const grid_point_t *p = &a->g->point[j];
  const int first = sample_of(a->g, j);
  body_start_t start = {.pos_w_m = p->pos_w_m,
                        .vel_w_mps = p->vel_w_mps,
                        .q_wb = p->q_wb,
                        .rate_b_radps = p->rate_b_radps,
                        .seed = 1};
  for (int k = 0; k < ROTORS; k++) start.thrust_N[k] = a->g->command_N[k][first];
  if (a->body.integrate) body_close(&a->body);
  a->body.integrate = NULL;
  if (body_open(&a->body, m, INTEGRATE_RK4, model_step_s(m, PILOT_STEP_S), &start) == DONE) return DONE;
  return error_failed(why, "%s: a model that cannot be flown", m->name);
}

// Flies the samples of one point.
static void fly_point(flight_again_t *a, int j, int first_sample) {
  const grid_t *g = a->g;
  const double log_s = g->period_s / g->every;
  const int inner = (int)fmax(1.0, round(log_s / PILOT_STEP_S));
  for (int i = first_sample; i < first_sample + g->every; i++)
    for (int k = 0; k < inner; k++) {
      double motor_N[ROTORS];
      for (int r = 0; r < ROTORS; r++) motor_N[r] = g->command_N[r][i];
      a->body.vbat_V = g->point[j].vbat_V;
      correct(a, &g->point[j], motor_N);
      body_tick(&a->body, motor_N, log_s / inner);
    }
}

// Adds the squared errors and their number to the tally, over the points whose turn it is. off_m: null where
// the flight is not drawn.
static done_t fly_again(flight_again_t *a, const model_t *m, again_t *tally, double *const off_m[3],
                        long *points, why_t *why) {
  const grid_t *g = a->g;
  bool flying = false;
  for (int j = 0; j < g->n; j++) {
    const grid_point_t *p = &g->point[j];
    const bool go_on = flying && p->ok && p->segment == g->point[j - 1].segment;
    const bool counts = a->turn < 0 || by_turns_at(g, j) == a->turn;
    for (int k = 0; k < 3 && off_m && counts; k++) off_m[k][j] = (double)NAN;
    flying = p->ok;
    if (!p->ok) continue;
    if (!go_on) TRY(put(a, m, j, why));
    d3_t off = d3_sub(d3_of(a->body.y + RIGID_POS_M), p->pos_w_m);
    double far_m = d3_norm(off);
    const double off_z_m = fmin(fabs(off.z), RESIMULATE_LOST_M); // NaN counts as lost
    if (a->body.broken || !(far_m <= RESIMULATE_LOST_M)) {
      far_m = RESIMULATE_LOST_M;
      tally->lost += counts;
      TRY(put(a, m, j, why));
      off = d3_sub(d3_of(a->body.y + RIGID_POS_M), p->pos_w_m);
    }
    fly_point(a, j, sample_of(g, j));
    if (!counts) continue;
    tally->rms_m += far_m * far_m;
    tally->height_m += off_z_m * off_z_m;
    ++*points;
    if (off_m) off_m[0][j] = off.x, off_m[1][j] = off.y, off_m[2][j] = off.z;
  }
  return DONE;
}

// turns: what is added to the pilots' model. *flew: something did.
static done_t fly_all(const set_t *held, const by_turns_t *turns, const model_t *pilots,
                      const closed_loop_t *loop, again_t *to, bool *flew, why_t *why) {
  long points = 0;
  for (int i = 0; i < held->n_grid * turns->n; i++) {
    const int f = i / turns->n, turn = i % turns->n;
    model_t m;
    TRY(chosen_model(&turns->of[turn], pilots, &m, why));
    flight_again_t *const a = calloc(1, sizeof *a);
    if (!a) return error_failed(why, "out of memory");
    a->g = &held->grid[f], a->pilots = pilots, a->loop = loop;
    a->turn = turns->n > 1 ? turn : -1;
    const done_t status = fly_again(a, &m, to, f == 0 ? to->off_m : NULL, &points, why);
    if (a->body.integrate) body_close(&a->body);
    free(a);
    TRY(status);
  }
  *flew = points > 0;
  to->rms_m = sqrt(to->rms_m / (double)points);
  to->height_m = sqrt(to->height_m / (double)points);
  return DONE;
}

static const char *obstacle(const set_t *held) {
  const grid_t *g = &held->grid[0];
  if (!g->has_position) return "the log has no position";
  if (!g->has_velocity) return "the log has no velocity";
  if (!g->has_attitude || !g->has_rates) return "the log has no attitude or no rates";
  return NULL;
}

static bool take_room(resimulation_t *r, const grid_t *g) {
  const size_t n = (size_t)g->n + 1;
  r->n = g->n;
  r->t_s = calloc(7 * n, sizeof(double));
  for (size_t k = 0; k < 3 && r->t_s; k++) {
    r->before.off_m[k] = r->t_s + (1 + k) * n;
    r->after.off_m[k] = r->t_s + (4 + k) * n;
  }
  for (int j = 0; r->t_s && j < g->n; j++) r->t_s[j] = g->point[j].t_s - g->point[0].t_s;
  return r->t_s != NULL;
}

done_t resimulate(const set_t *held, const model_t *before, const by_turns_t *after,
                  const closed_loop_t *loop, resimulation_t *r, why_t *why) {
  static const by_turns_t none = {.n = 1};
  bool old_flew, new_flew;
  *r = (resimulation_t){.why_not = obstacle(held)};
  if (r->why_not) return DONE;
  if (!take_room(r, &held->grid[0])) return error_failed(why, "out of memory");
  TRY(fly_all(held, &none, before, loop, &r->before, &old_flew, why));
  TRY(fly_all(held, after, before, loop, &r->after, &new_flew, why));
  r->flew = old_flew && new_flew;
  r->why_not = "the vehicle does not fly";
  return DONE;
}

void resimulation_free(resimulation_t *r) {
  free(r->t_s);
  *r = (resimulation_t){.flew = false};
}
