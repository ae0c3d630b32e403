// excluded.c - channels in which these logs cannot be compared with any model.
#include "gap/2_predict/excluded.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double MORE_TAU_S[] = {0.0, 0.03, 0.06, 0.1};
#define LAGS (sizeof MORE_TAU_S / sizeof *MORE_TAU_S)

#define ORDERS        24   // of four motors
#define EXPLAINS_MORE 0.25 // least gain of another order, as a share of one axis's turning

typedef struct {
  double slope, most, correlation; // most: the slope that it has at most, by two standard errors
} likeness_t;

#define ROUNDING 1e-9 // share of a sum of squares below which a difference of sums is rounding

// Takes out of both increments what goes with `thrust`. A centre of mass, or a weak rotor, that the vehicle
// file does not know turns a calm hover's predictions by its thrust, more than attitude control does: that is
// to be named, and no command is missed.
static increments_t but_for_thrust(const rows_t *r, const double *measured, const double *residual,
                                   const double *thrust) {
  increments_t s = increments_of(r, measured, residual);
  double tt = 0.0, yt = 0.0, pt = 0.0;
  for (int i = 1; i < r->n; i++) {
    if (!r->follows[i]) continue;
    const double t = thrust[i] - thrust[i - 1], y = measured[i] - measured[i - 1];
    tt += t * t;
    yt += y * t;
    pt += (y - (residual[i] - residual[i - 1])) * t;
  }
  if (!(tt > 0.0) || s.pp - pt * pt / tt < ROUNDING * s.pp) return s;
  s.yy -= yt * yt / tt;
  s.pp -= pt * pt / tt;
  s.yp -= yt * pt / tt;
  s.n--;
  return s;
}

// Compares measured with predicted increments; slope and correlation are 1 if either is 0. thrust: null, or
// what is taken out.
static likeness_t likeness(const rows_t *r, const double *measured, const double *residual,
                           const double *thrust) {
  const increments_t s =
      thrust ? but_for_thrust(r, measured, residual, thrust) : increments_of(r, measured, residual);
  if (!(s.pp > 0.0 && s.yy > 0.0)) return (likeness_t){1.0, 1.0, 1.0};
  const double slope = s.yp / s.pp, error = sqrt(fmax(s.yy / s.pp - slope * slope, 0.0) / s.n);
  return (likeness_t){slope, slope + 2.0 * error, s.yp / sqrt(s.yy * s.pp)};
}

#define SHIFT_M 1e-3 // any length does: what goes with the thrust is taken out at its own slope

// Sets r, and rows that go with the thrust: what turning about x leaves less with the rotors shifted to the
// left.
static done_t thrust_rows(set_t *s, const model_t *m, double *const r[CHANNELS], double *thrust, why_t *why) {
  model_t left = *m;
  const int n = s->smooth.n;
  for (int k = 0; k < ROTORS; k++) left.frame.rotor_y_m[k] += SHIFT_M;
  TRY(residual_of(s, &left, r, why));
  memcpy(thrust, r[CH_WX], (size_t)n * sizeof *thrust);
  TRY(residual_of(s, m, r, why));
  for (int i = 0; i < n; i++) thrust[i] -= r[CH_WX][i];
  return DONE;
}

// Finds, by channel, how well turning follows the commands at the best of the first `lags` of MORE_TAU_S.
// but_thrust: but for what goes with the thrust.
static done_t best_of(set_t *s, const model_t *m, unsigned lags, bool but_thrust, double *room,
                      likeness_t best[CHANNELS], why_t *why) {
  double *r[CHANNELS], *measured[CHANNELS] = {NULL};
  const size_t n = set_most_rows(s);
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    best[ch] = (likeness_t){1.0, 1.0, -2.0};
    r[ch] = room + ch * n;
  }
  for (size_t ch = CH_WX; ch <= CH_WZ; ch++) measured[ch] = room + (CHANNELS + ch - CH_WX) * n;
  double *const thrust = but_thrust ? room + (CHANNELS + 3) * n : NULL;
  TRY(residual_measured(s, measured, why));
  for (unsigned i = 0; i < lags; i++) {
    model_t slower = *m;
    slower.motor_tau_s += MORE_TAU_S[i];
    TRY(thrust ? thrust_rows(s, &slower, r, thrust, why) : residual_of(s, &slower, r, why));
    for (int ch = CH_WX; ch <= CH_WZ; ch++) {
      const likeness_t now = likeness(&s->smooth, measured[ch], r[ch], thrust);
      if (now.correlation > best[ch].correlation) best[ch] = now;
    }
  }
  return DONE;
}

// --- the order of the motors ------------------------------------------------------------------------------

static void reorder(set_t *s, const int order[ROTORS]) {
  for (int f = 0; f < s->n_grid; f++) {
    grid_t *const g = &s->grid[f];
    double *was[ROTORS];
    memcpy(was, g->command_N, sizeof was);
    for (int k = 0; k < ROTORS; k++) g->command_N[order[k]] = was[k];
    for (int i = 0; i < GRID_MOTORS; i++) g->motors[i].delay_s = (double)NAN; // of other commands
  }
}

// Computes order number i of 24; order[k]: the motor that column k belongs to.
static void order_of(int i, int order[ROTORS]) {
  int left[ROTORS] = {0, 1, 2, 3};
  for (int k = 0, n = ROTORS; k < ROTORS; k++, n--) {
    order[k] = left[i % n];
    for (int at = i % n; at < n - 1; at++) left[at] = left[at + 1];
    i /= n;
  }
}

// Returns how much of the turning the commands explain, over all axes; what goes against them subtracts.
static double explained(const likeness_t axis[CHANNELS]) {
  double sum = 0.0;
  for (int ch = CH_WX; ch <= CH_WZ; ch++) sum += axis[ch].correlation * fabs(axis[ch].correlation);
  return sum;
}

static bool all_follow(const likeness_t axis[CHANNELS]) {
  for (int ch = CH_WX; ch <= CH_WZ; ch++)
    if (!(axis[ch].correlation > 0.0)) return false;
  return true;
}

// Writes the column of the first motor that is another one, as errors name columns; "": the log has none.
static const char *first_exchanged(const gap_flight_t *f, const int order[ROTORS],
                                   char text[COLUMN_NAME_MAX + 10]) {
  int k = 0;
  while (k < ROTORS - 1 && order[k] == k) k++;
  snprintf(text, COLUMN_NAME_MAX + 10, f->motor_column[k][0] ? "column %s: " : "%s", f->motor_column[k]);
  return text;
}

// Tries every order without more lag; number 0 is the given one. BAD_INPUT: another explains more.
static done_t find_order(set_t *s, const model_t *m, double *room, why_t *why) {
  int best = 0;
  double given = 0.0, most = 0.0;
  for (int i = 0; i < ORDERS; i++) {
    likeness_t axis[CHANNELS];
    int order[ROTORS], back[ROTORS];
    order_of(i, order);
    for (int k = 0; k < ROTORS; k++) back[order[k]] = k;
    reorder(s, order);
    const done_t status = best_of(s, m, 1, false, room, axis, why);
    reorder(s, back);
    TRY(status);
    const double now = explained(axis);
    if (i == 0) given = most = now;
    if (now <= most || !all_follow(axis)) continue;
    most = now;
    best = i;
  }
  if (most <= given + EXPLAINS_MORE) return DONE;
  int order[ROTORS];
  char column[COLUMN_NAME_MAX + 10];
  order_of(best, order);
  return error_set(
      why,
      "%s: %sthe rates contradict the motor commands, and follow them if m1 to m4 are motors %d, %d, %d and "
      "%d; allowed: motors in the vehicle file's order",
      s->grid[0].flight->name, first_exchanged(s->grid[0].flight, order, column), order[0] + 1, order[1] + 1,
      order[2] + 1, order[3] + 1);
}

// Sets s->spins_other if turning follows the commands about x and y, but about z with all spins reversed.
static done_t try_other_spins(set_t *s, const model_t *m, double *room, const likeness_t best[CHANNELS],
                              why_t *why) {
  model_t other = *m;
  likeness_t then[CHANNELS];
  if (!(best[CH_WZ].correlation < 0.0 && best[CH_WZ].most < EXCLUDED_SLOPE &&
        best[CH_WX].slope >= EXCLUDED_SLOPE && best[CH_WY].slope >= EXCLUDED_SLOPE))
    return DONE;
  for (int k = 0; k < ROTORS; k++) other.frame.rotor_spin[k] *= -1.0;
  TRY(best_of(s, &other, LAGS, false, room, then, why));
  s->spins_other = then[CH_WZ].correlation > 0.0 && then[CH_WZ].slope >= EXCLUDED_SLOPE;
  return DONE;
}

static done_t exclude(set_t *s, const model_t *m, double *room, why_t *why) {
  likeness_t best[CHANNELS];
  bool any = false;
  TRY(best_of(s, m, LAGS, false, room, best, why));
  TRY(try_other_spins(s, m, room, best, why));
  for (int ch = CH_WX; ch <= CH_WZ; ch++)
    if (best[ch].correlation > -2.0 && best[ch].correlation < EXCLUDED_AGAINST)
      return error_set(
          why,
          "%s: %s goes against what the motor commands say (correlation %.2f); allowed: rates and "
          "commands of one sign, motors in the vehicle file's order%s",
          s->grid[0].flight->name, gap_channel[ch], best[ch].correlation,
          ch == CH_WZ && s->spins_other ? " (it follows with the other sign of `spin` in the vehicle file)"
                                        : "");
  for (int ch = CH_WX; ch <= CH_WZ; ch++) any = any || best[ch].most < EXCLUDED_SLOPE;
  if (!any) return DONE;
  likeness_t beside[CHANNELS];
  TRY(best_of(s, m, LAGS, true, room, beside, why));
  any = false;
  for (int ch = CH_WX; ch <= CH_WZ; ch++) {
    s->excluded[ch] = best[ch].most < EXCLUDED_SLOPE && beside[ch].most < EXCLUDED_SLOPE;
    any = any || s->excluded[ch];
  }
  return any ? find_order(s, m, room, why) : DONE;
}

done_t excluded_find(set_t *s, const model_t *m, why_t *why) {
  memset(s->excluded, 0, sizeof s->excluded);
  s->spins_other = false;
  if (!residual_has(s, CH_WX)) return DONE;
  const size_t n = set_most_rows(s);
  double *const room = calloc((CHANNELS + 4) * n, sizeof(double));
  const done_t status = room ? exclude(s, m, room, why) : error_failed(why, "out of memory");
  free(room);
  return status;
}
