// set_points.c - the controller's set points.
#include "gap/2_predict/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STILL_M    1e-3 // sd below which a position stands still
#define MOVES_MPS  0.02 // sd above which a velocity moves
#define FOLLOWED_M 1.0  // largest mean distance at which it is followed

static double mean_or_nan(const gap_flight_t *f, int signal, int from, int n) {
  double sum = f->v[signal] ? 0.0 : (double)NAN;
  for (int i = from; f->v[signal] && i < from + n; i++) sum += f->v[signal][i];
  return sum / n;
}

void set_point_read(const grid_t *g, const model_t *m, int from, grid_point_t *p) {
  const gap_flight_t *f = g->flight;
  const int n = g->every;
  p->set_w_m = d3(mean_or_nan(f, SIG_SET_X, from, n), mean_or_nan(f, SIG_SET_Y, from, n),
                  mean_or_nan(f, SIG_SET_Z, from, n) + body_rest_z_m(m));
  p->set_w_mps = d3(mean_or_nan(f, SIG_SET_VX, from, n), mean_or_nan(f, SIG_SET_VY, from, n),
                    mean_or_nan(f, SIG_SET_VZ, from, n));
  p->set_yaw_rad = f->v[SIG_SET_YAW] ? f->v[SIG_SET_YAW][from + n / 2] : (double)NAN;
}

// --- which of them are followed ---------------------------------------------------------------------------

static double *axis(d3_t *v, int k) {
  return k == 0 ? &v->x : k == 1 ? &v->y : &v->z;
}

typedef struct {
  double n, sum, squares;
} moments_t;

static void count(moments_t *m, double v) {
  if (!isfinite(v)) return;
  m->n += 1.0;
  m->sum += v;
  m->squares += v * v;
}

static double sd(const moments_t *m) {
  return m->n > 0.0 ? sqrt(fmax(m->squares / m->n - m->sum * m->sum / m->n / m->n, 0.0)) : 0.0;
}

void set_points_judge(grid_t *g) {
  for (int k = 0; k < 3; k++) {
    moments_t place = {0}, speed = {0}, off = {0};
    for (int j = 0; j < g->n; j++) {
      grid_point_t *p = &g->point[j];
      if (!p->ok) continue;
      count(&place, *axis(&p->set_w_m, k));
      count(&speed, *axis(&p->set_w_mps, k));
      count(&off, fabs(*axis(&p->set_w_m, k) - *axis(&p->pos_w_m, k)));
    }
    const bool stale = sd(&place) < STILL_M && sd(&speed) > MOVES_MPS;
    const bool away = g->has_position && off.n > 0.0 && off.sum / off.n > FOLLOWED_M;
    for (int j = 0; (stale || away) && j < g->n; j++) *axis(&g->point[j].set_w_m, k) = (double)NAN;
  }
}

bool set_points_there(const grid_t *g) {
  for (int j = 0; j < g->n; j++) {
    const grid_point_t *p = &g->point[j];
    const d3_t place = p->set_w_m, speed = p->set_w_mps;
    if (!p->ok) continue;
    if (isfinite(place.x) || isfinite(place.y) || isfinite(place.z)) return true;
    if (isfinite(speed.x) || isfinite(speed.y) || isfinite(speed.z)) return true;
  }
  return false;
}

// --- the track that they make -----------------------------------------------------------------------------

// Fills the track along axis k; a gap keeps the last position.
static void lead(grid_t *to, const grid_t *g, int k) {
  double mean_m = 0.0, at_m = (double)NAN;
  int n = 0;
  for (int j = 0; j < g->n; j++) {
    if (!g->point[j].ok) continue;
    mean_m += *axis(&g->point[j].pos_w_m, k);
    n++;
  }
  mean_m /= fmax(n, 1);
  for (int j = 0; j < g->n; j++) {
    const double place_m = *axis(&g->point[j].set_w_m, k), speed_mps = *axis(&g->point[j].set_w_mps, k);
    const bool speed = isfinite(speed_mps);
    if (isfinite(place_m))
      at_m = place_m;
    else if (speed)
      at_m = (isfinite(at_m) ? at_m : mean_m) + speed_mps * g->period_s;
    *axis(&to->point[j].pos_w_m, k) = isfinite(at_m) ? at_m : mean_m;
    *axis(&to->point[j].vel_w_mps, k) = speed ? speed_mps : 0.0;
  }
}

static void head(grid_t *to, const grid_t *g) {
  int first = 0;
  while (first + 1 < g->n && !g->point[first].ok) first++;
  const dq_t q = g->point[first].q_wb;
  double yaw_rad = atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
  for (int j = 0; j < g->n; j++) {
    if (isfinite(g->point[j].set_yaw_rad)) yaw_rad = g->point[j].set_yaw_rad;
    to->point[j].q_wb = (dq_t){cos(0.5 * yaw_rad), 0.0, 0.0, sin(0.5 * yaw_rad)};
  }
}

static void line_of_voltage(grid_t *to, const grid_t *g) {
  double n = 0.0, t = 0.0, tt = 0.0, v = 0.0, tv = 0.0;
  for (int j = 0; j < g->n; j++) {
    if (!g->point[j].ok) continue;
    n += 1.0;
    t += j;
    tt += (double)j * j;
    v += g->point[j].vbat_V;
    tv += j * g->point[j].vbat_V;
  }
  const double det = n * tt - t * t, slope = det > 0.0 ? (n * tv - t * v) / det : 0.0;
  for (int j = 0; j < g->n; j++) to->point[j].vbat_V = (v - slope * t) / fmax(n, 1.0) + slope * j;
}

done_t set_points_track(const grid_t *g, grid_t *track, why_t *why) {
  *track = *g;
  track->point = malloc(((size_t)g->n + 1) * sizeof(grid_point_t));
  if (!track->point) return error_failed(why, "out of memory");
  memcpy(track->point, g->point, (size_t)g->n * sizeof(grid_point_t));
  for (int k = 0; k < 3; k++) lead(track, g, k);
  for (int j = 0; j < g->n; j++) { // pilots follow these
    track->point[j].seen_w_m = track->point[j].pos_w_m;
    track->point[j].seen_w_mps = track->point[j].vel_w_mps;
  }
  head(track, g);
  line_of_voltage(track, g);
  for (int j = 0; j < g->n; j++) {
    track->point[j].rate_b_radps = d3(0.0, 0.0, 0.0);
    track->point[j].range_m = (double)NAN;
  }
  return DONE;
}
