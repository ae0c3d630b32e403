// eight.c - replays eight points at a time.
#include "gap/2_predict/eight.h"

#include "base/lane.h"
#include "body/points.h"
#include <stdlib.h>

// --- one point --------------------------------------------------------------------------------------------

void predict_place(body_t *b, const grid_point_t *p) {
  d3_put(b->y + RIGID_POS_M, p->pos_w_m);
  d3_put(b->y + RIGID_VEL_MPS, p->vel_w_mps);
  b->y[RIGID_Q_WB] = p->q_wb.w;
  d3_put(b->y + RIGID_Q_WB + 1, d3(p->q_wb.x, p->q_wb.y, p->q_wb.z));
  d3_put(b->y + RIGID_RATE_RADPS, p->rate_b_radps);
  b->vbat_V = p->vbat_V;
}

// A range is measured along the sensor's axis. The upward sensor is taken to sit in the rotors' plane, the
// downward one at the feet. The height is taken at the time of the range sample, because a point is a mean
// over samples: 10 ms between the two would be estimated as latency.
void predict_sight(const grid_t *g, const model_t *m, const grid_point_t *p, double up, double *range_m,
                   double *rate_mps) {
  const double least = fmax(up, 0.1);
  const double z_m = p->pos_w_m.z - p->vel_w_mps.z * p->range_before_s;
  const double above_m = m->ceiling_m - z_m - body_rotor_z_m(m);
  const double below_m = z_m - body_rest_z_m(m);
  const double side = g->range_up ? -1.0 : 1.0;
  *range_m = (g->range_up ? above_m : below_m) / least;
  *rate_mps = side * p->vel_w_mps.z / least;
}

// --- eight ------------------------------------------------------------------------------------------------

static bool open_eight(grid_t *g, const body_t *b) {
  if (!g->eight) g->eight = points_open(lane_bits());
  return g->eight && points_of(g->eight, b, g->period_s);
}

static int in_group(const grid_t *g, int from) {
  return g->n - from < LANES ? g->n - from : LANES;
}

// After the last point of a flight, that point fills the other lanes.
static void take_group(const grid_t *g, body_t *b, const lagged_t *motors, int from, lanes_instants_t *at) {
  const int n = in_group(g, from);
  for (int k = 0; k < LANES; k++) {
    const int j = from + (k < n ? k : n - 1);
    predict_place(b, &g->point[j]);
    for (int i = 0; i < RIGID_THRUST_N; i++) at->y[i][k] = b->y[i];
    for (int i = 0; i < ROTORS; i++) {
      at->y[RIGID_THRUST_N + i][k] = motors->thrust_N[i][j];
      at->command_N[i][k] = motors->thrust_N[i][j] + motors->rise_Nps[i][j] * b->rigid.motor_tau_s;
    }
    at->vbat_V[k] = b->vbat_V;
    at->t_s[k] = g->point[j].t_s - g->point[0].t_s;
  }
}

static void see_group(const grid_t *g, const model_t *m, int from, const double up[LANES],
                      lanes_sight_t *sight) {
  const int n = in_group(g, from);
  for (int k = 0; k < LANES; k++)
    predict_sight(g, m, &g->point[from + (k < n ? k : n - 1)], up[k], &sight->range_m[k],
                  &sight->range_rate_mps[k]);
}

// Readings by channel: force, turning, range.
static void put_group(const grid_t *g, int from, const lanes_readings_t *read, double *const out[CHANNELS]) {
  _Static_assert(LANES_READINGS == (int)CHANNELS, "a reading of every channel");
  const int n = in_group(g, from);
  for (int c = 0; c < CHANNELS; c++)
    for (int k = 0; k < n; k++) out[c][from + k] = read->of[c][k];
}

static unsigned all_in(const grid_t *g, int from) {
  return (1u << in_group(g, from)) - 1;
}

static unsigned read_group(grid_t *g, body_t *b, const lagged_t *motors, int from,
                           double *const out[CHANNELS]) {
  lanes_instants_t at;
  lanes_sight_t sight;
  lanes_readings_t read;
  double up[LANES];
  take_group(g, b, motors, from, &at);
  if (!points_look(g->eight, &at, in_group(g, from), up)) return 0;
  see_group(g, b->model, from, up, &sight);
  const unsigned in = points_read(g->eight, &sight, &read);
  put_group(g, from, &read, out);
  return in;
}

bool eight_replay(grid_t *g, body_t *b, const lagged_t *motors, eight_alone_t alone,
                  double *const out[CHANNELS]) {
  if (!open_eight(g, b)) return false;
  for (int from = 0; from < g->n; from += LANES) {
    const unsigned in = read_group(g, b, motors, from, out);
    if (!in && from == 0) return false;
    for (int k = 0; k < in_group(g, from); k++)
      if (!(in >> k & 1)) alone(b, g, motors, from + k, out);
  }
  return true;
}

bool eight_keep(grid_t *g, body_t *b, const lagged_t *motors, path_t *path, double *const out[CHANNELS]) {
  if (!open_eight(g, b)) return false;
  path->kept_bytes = points_kept_bytes(g->eight);
  path->kept = aligned_alloc(POINTS_ALIGN, (size_t)(g->n / LANES + 1) * path->kept_bytes);
  bool good = path->kept;
  for (int from = 0; from < g->n && good; from += LANES) {
    good = read_group(g, b, motors, from, out) == all_in(g, from);
    points_keep(g->eight, path->kept + (size_t)(from / LANES) * path->kept_bytes);
  }
  path->rigid[0] = b->rigid;
  if (good) return true;
  free(path->kept);
  path->kept = NULL;
  return false;
}

static bool same_places(const rigid_t *a, const rigid_t *b) {
  bool same = true;
  for (int i = 0; i < ROTORS; i++)
    same = same && a->rotor_x_m[i] == b->rotor_x_m[i] && a->rotor_y_m[i] == b->rotor_y_m[i] &&
           a->rotor_z_m[i] == b->rotor_z_m[i];
  return same;
}

bool eight_again(grid_t *g, body_t *b, const path_t *path, double *const out[CHANNELS]) {
  if (!path->kept || !open_eight(g, b)) return false;
  const bool moved = !same_places(&b->rigid, &path->rigid[0]);
  for (int from = 0; from < g->n; from += LANES) {
    lanes_readings_t read;
    const char *const kept = path->kept + (size_t)(from / LANES) * path->kept_bytes;
    if (points_read_again(g->eight, kept, moved, in_group(g, from), &read) != all_in(g, from)) return false;
    put_group(g, from, &read, out);
  }
  return true;
}

bool eight_more(grid_t *g, body_t *b, const path_t *path, const fx_use_t *more, double *const out[CHANNELS]) {
  if (!path->kept || !open_eight(g, b) || !points_more(g->eight, more)) return false;
  for (int from = 0; from < g->n; from += LANES) {
    lanes_readings_t read;
    const char *const kept = path->kept + (size_t)(from / LANES) * path->kept_bytes;
    if (points_read_more(g->eight, kept, in_group(g, from), &read) != all_in(g, from)) return false;
    put_group(g, from, &read, out);
  }
  return true;
}
