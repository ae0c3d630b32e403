// instrument.c - the instruments of the confirming step: columns of a quiet flight along the
// reference.
#include "gap/5_infer/instrument.h"

#include "gap/2_predict/grid.h"
#include <math.h>
#include <stdlib.h>

// --- the flight along the reference -----------------------------------------------------------------------

static manner_t quiet(const manner_t *w) {
  manner_t q = {.tilt_gain = w->tilt_gain,
                .climb_gain = w->climb_gain,
                .height_gain = w->height_gain,
                .flown_by = w->flown_by};
  for (int i = 0; i < 3; i++) q.rate_gain[i] = w->rate_gain[i];
  q.force_tau_s = q.turn_tau_s = 1.0;
  return q;
}

// first: the point of the track at which it begins.
static done_t fly(const confirming_t *t, int flight, gap_flight_t *flown, int *first, bool *flew,
                  why_t *why) {
  const grid_t *g = &t->s->grid[flight];
  const manner_t manner = quiet(t->manner);
  model_t room = t->now;
  room.ceiling_m =
      HUGE_VAL; // who follows it without a disturbance does not touch what the log's vehicle did not
  grid_t track;
  TRY(set_points_track(g, &track, why));
  for (*first = 0; *first < g->n && !g->point[*first].ok;) ++*first;
  why_t lost;
  *flew = nominal_fly(&track, &room, &manner, 1, flown, NULL, &lost) == DONE;
  free(track.point);
  return DONE;
}

// --- columns ----------------------------------------------------------------------------------------------

typedef struct {
  double *base[CHANNELS], *with[CHANNELS], *series[CHANNELS], *scratch, *room;
} room_t;

static bool room_make(room_t *r, size_t n) {
  r->room = calloc((3 * CHANNELS + CH_SMOOTH) * (n + 1), sizeof(double));
  for (size_t ch = 0; r->room && ch < CHANNELS; ch++) {
    r->base[ch] = r->room + ch * (n + 1);
    r->with[ch] = r->room + (CHANNELS + ch) * (n + 1);
    r->series[ch] = r->room + (2 * CHANNELS + ch) * (n + 1);
  }
  r->scratch = r->room ? r->room + 3 * CHANNELS * (n + 1) : NULL;
  return r->room != NULL;
}

// What the quiet flight has at a point of the log's, so many points later; before and after it the nearest.
static void shift(const grid_t *log, const grid_t *quiet, int first, int lag, const double *from,
                  double *to) {
  for (int j = 0; j < log->n; j++) {
    const int k = j - first - lag;
    to[j] = quiet->n ? from[k < 0 ? 0 : k < quiet->n ? k : quiet->n - 1] : 0.0;
  }
}

static double **instrument(confirming_t *t, int channel, int column, int lag) {
  const int group = channel < CH_FORCES ? 0 : channel < CH_SMOOTH ? 1 : 2;
  return &t->table.x[channel][t->names.columns + INSTRUMENTS * column + CONFIRM_LAGS * group + lag];
}

static done_t put_instruments(confirming_t *t, int flight, grid_t *quiet, int first, room_t *r, int column,
                              why_t *why) {
  const grid_t *g = &t->s->grid[flight];
  const int step = (int)fmax(1.0, round(CONFIRM_LAG_S / g->period_s));
  for (int l = 0; l < CONFIRM_LAGS; l++) {
    double *row[CHANNELS] = {NULL};
    for (int ch = 0; ch < CHANNELS; ch++) {
      if (!t->table.x[ch][column]) continue; // the name does not show there
      double **const to = instrument(t, ch, column, l);
      if (!*to) *to = calloc((size_t)set_rows(t->s, ch)->n + 1, sizeof(double));
      if (!*to) return error_failed(why, "out of memory");
      row[ch] = *to;
      shift(g, quiet, first, (l - CONFIRM_LAGS / 2) * step, r->with[ch], r->series[ch]);
    }
    residual_rows(t->s, flight, SERIES_PREDICTED, (const double *const *)r->series, r->scratch, row);
  }
  return DONE;
}

static done_t put_flight(confirming_t *t, int flight, grid_t *quiet, int first, why_t *why) {
  const grid_t *g = &t->s->grid[flight];
  room_t r;
  path_t path;
  if (!room_make(&r, (size_t)(g->n > quiet->n ? g->n : quiet->n))) return error_failed(why, "out of memory");
  done_t status = replay_keep(quiet, &t->now, &path, r.base, why);
  for (int i = 0; i < t->names.n; i++)
    for (int k = 0; k < t->names.candidate[i].n && status == DONE; k++) {
      const candidate_t *c = &t->names.candidate[i];
      status = candidate_differentiate(quiet, &path, c, k, r.base, r.with, why);
      if (status == DONE) status = put_instruments(t, flight, quiet, first, &r, c->first + k, why);
    }
  path_free(&path);
  free(r.room);
  return status;
}

done_t confirm_instruments(confirming_t *t, bool *flew, why_t *why) {
  *flew = true;
  for (int f = 0; f < t->s->n_grid && *flew; f++) {
    gap_flight_t flown;
    grid_t quiet = {.n = 0};
    int first;
    TRY(fly(t, f, &flown, &first, flew, why));
    if (!*flew) break;
    done_t status = grid_make(&quiet, &flown, 0, flown.n, t->base, why);
    if (status == DONE) status = put_flight(t, f, &quiet, first, why);
    grid_free(&quiet);
    gap_flight_free(&flown);
    TRY(status);
  }
  return DONE;
}

done_t confirm_table(confirming_t *t, why_t *why) {
  table_t names;
  TRY(table_make(&names, t->s, t->base, &t->names, why));
  const int n = names.columns;
  t->table = (table_t){.columns = n * (1 + INSTRUMENTS)};
  bool good = true;
  for (int ch = 0; ch < CHANNELS; ch++) {
    double **const x = t->table.x[ch] = calloc((size_t)t->table.columns + 1, sizeof *x);
    good = good && x;
    for (int i = 0; x && i <= n; i++) {
      x[i < n ? i : t->table.columns] = names.x[ch][i];
      names.x[ch][i] = NULL;
    }
  }
  table_free(&names);
  return good ? DONE : error_failed(why, "out of memory");
}
