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
  *log = (gap_flight_t){.motors_N = true, .rows_are_means = like->rows_are_means};
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

static void write(const nominal_flight_t *f, gap_flight_t *log, const grid_point_t *p,
                  const double motor_N[ROTORS], bool touches, double t_s) {
  const int i = log->n++;
  ask_ahead(log, i);
  log->t_s[i] = t_s;
  log->segment[i] = f->g->point[f->at].segment;
  log->saturated[i] = touches || t_s < f->masked_to_s;
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

static void write_both(const nominal_flight_t *f, const grid_point_t *seen, const grid_point_t *is,
                       const double motor_N[ROTORS], bool touches, double t_s) {
  write(f, f->log, seen, motor_N, touches, t_s);
  if (f->truth) write(f, f->truth, is, motor_N, touches, t_s);
}

static void add_to(grid_point_t *sum, const grid_point_t *p, double share) {
  sum->pos_w_m = d3_add(sum->pos_w_m, d3_scale(share, p->pos_w_m));
  sum->vel_w_mps = d3_add(sum->vel_w_mps, d3_scale(share, p->vel_w_mps));
  sum->acc_b_mps2 = d3_add(sum->acc_b_mps2, d3_scale(share, p->acc_b_mps2));
  sum->rate_b_radps = d3_add(sum->rate_b_radps, d3_scale(share, p->rate_b_radps));
  sum->q_wb.w += share * p->q_wb.w;
  sum->q_wb.x += share * p->q_wb.x;
  sum->q_wb.y += share * p->q_wb.y;
  sum->q_wb.z += share * p->q_wb.z;
  sum->vbat_V += share * p->vbat_V;
}

// Adds a step to the means of its row. A step's sample is of its beginning and a command holds until its end:
// with half of the command before it, both have the same instant.
static void gather(nominal_flight_t *f, const double motor_N[ROTORS], int step, int steps) {
  nominal_row_t *const row = &f->row;
  const double share = 1.0 / steps;
  if (step == 0) *row = (nominal_row_t){.touches = false};
  add_to(&row->seen, &f->seen, share);
  if (f->truth) add_to(&row->is, &f->is, share);
  for (int k = 0; k < ROTORS; k++) row->motor_N[k] += 0.5 * share * (f->body.command_N[k] + motor_N[k]);
  row->touches = row->touches || f->body.on_floor || f->body.on_ceiling;
  if (step != steps / 2) return;
  row->seen.range_m = f->seen.range_m; // a sample, no mean
  row->is.range_m = f->is.range_m;
}

void nominal_log_step(nominal_flight_t *f, const double motor_N[ROTORS], int step, double t_s,
                      double step_s) {
  if (f->steps == 1 || !f->log->rows_are_means) {
    if (step == 0) write_both(f, &f->seen, &f->is, motor_N, f->body.on_floor || f->body.on_ceiling, t_s);
    return;
  }
  gather(f, motor_N, step, f->steps);
  const nominal_row_t *const row = &f->row;
  if (step == f->steps - 1)
    write_both(f, &row->seen, &row->is, row->motor_N, row->touches, t_s + 0.5 * (f->steps - 1) * step_s);
}
