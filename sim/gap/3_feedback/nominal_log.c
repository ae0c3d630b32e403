// nominal_log.c - the log of a nominal flight.
#include "gap/3_feedback/nominal_pilot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { LINE = 64 / sizeof(double), AHEAD = 2 * LINE }; // numbers of a cache line; how far ahead

static double *column(size_t n) {
  return malloc((n + AHEAD) * sizeof(double)); // ask_ahead() goes so far
}

bool nominal_log_room(gap_flight_t *log, const grid_t *g, size_t n) {
  const gap_flight_t *like = g->flight;
  *log = (gap_flight_t){.motors_N = true};
  bool good = (log->t_s = column(n)) != NULL;
  good = (log->saturated = calloc(n, sizeof(bool))) && good; // also where it touches floor or ceiling
  good = (log->segment = calloc(n, sizeof(int))) && good;
  for (int i = SIG_X; i <= SIG_VBAT; i++)
    if (like->v[i] || (i >= SIG_M1 && i <= SIG_M4 && g->has_moments)) good = (log->v[i] = column(n)) && good;
  if (g->range_up)
    good = (log->v[SIG_RANGE] = column(n)) && good;
  else if (like->v[SIG_RANGE_DOWN])
    good = (log->v[SIG_RANGE_DOWN] = column(n)) && good;
  snprintf(log->name, sizeof log->name, "nominal flight");
  return good;
}

static void put3(const gap_flight_t *log, int signal, int i, d3_t v) {
  const double x[3] = {v.x, v.y, v.z};
  for (int k = 0; k < 3; k++)
    if (log->v[signal + k]) log->v[signal + k][i] = x[k];
}

// Fetches the columns two cache lines ahead. Flights that are flown side by side write into more columns than
// a processor follows: each line would come late and hold up the flight. Saves a tenth of the flights' time.
static void ask_ahead(const gap_flight_t *log, int i) {
  if (i % LINE) return;
  __builtin_prefetch(&log->t_s[i + AHEAD], 1);
  for (int k = 0; k < SIG_COUNT; k++)
    if (log->v[k]) __builtin_prefetch(&log->v[k][i + AHEAD], 1);
}

void nominal_log_write(const nominal_flight_t *f, gap_flight_t *log, const grid_point_t *p,
                       const double motor_N[ROTORS], double t_s) {
  const int i = log->n++;
  ask_ahead(log, i);
  log->t_s[i] = t_s;
  log->segment[i] = f->g->point[f->at].segment;
  log->saturated[i] = f->body.on_floor || f->body.on_ceiling || t_s < f->masked_to_s;
  put3(log, SIG_X, i, d3_add(p->pos_w_m, d3(0.0, 0.0, -body_rest_z_m(f->m))));
  put3(log, SIG_VX, i, p->vel_w_mps);
  put3(log, SIG_AX, i, p->acc_b_mps2);
  put3(log, SIG_GX, i, p->rate_b_radps);
  put3(log, SIG_QX, i, d3(p->q_wb.x, p->q_wb.y, p->q_wb.z));
  if (log->v[SIG_QW]) log->v[SIG_QW][i] = p->q_wb.w;
  if (log->v[SIG_VBAT]) log->v[SIG_VBAT][i] = p->vbat_V;
  double sum_N = 0.0;
  for (int k = 0; k < ROTORS; k++) {
    if (log->v[SIG_M1 + k]) log->v[SIG_M1 + k][i] = motor_N[k];
    sum_N += motor_N[k];
  }
  if (log->v[SIG_THRUST]) log->v[SIG_THRUST][i] = sum_N;
  double *const range = log->v[SIG_RANGE] ? log->v[SIG_RANGE] : log->v[SIG_RANGE_DOWN];
  if (range) range[i] = isfinite(f->g->point[f->at].range_m) ? p->range_m : (double)NAN;
}
