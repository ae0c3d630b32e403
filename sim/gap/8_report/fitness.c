// fitness.c - whether these flights fit the question: what was flown, what it could show and tell apart, and
// whether the vehicle file lacks a ceiling.
#include "gap/8_report/report.h"

#include "base/constants.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREES (180.0 / PI)
#define OUTSIDE 0.05 // share of the rows left out at each end of a coordinate's range

#define add(text, ...) text_add(text, REPORT_LONG, __VA_ARGS__)

// --- what was flown ---------------------------------------------------------------------------------------

static void tell_logs(const report_t *r, char text[REPORT_LONG]) {
  const set_t *const fit = &r->study->diagnosis.fit;
  double long_s = 0.0, least_Hz = HUGE_VAL, most_Hz = 0.0;
  for (int f = 0; f < fit->n_grid; f++) {
    const grid_t *const g = &fit->grid[f];
    for (int j = 0; j < g->n; j++) long_s += g->point[j].ok ? g->period_s : 0.0;
    least_Hz = fmin(least_Hz, g->flight->rate_Hz);
    most_Hz = fmax(most_Hz, g->flight->rate_Hz);
  }
  add(text, "%d to fit, %.3g s in the air, logged at %.3g", fit->n_grid, long_s, least_Hz);
  if (most_Hz > 1.05 * least_Hz) add(text, " to %.3g", most_Hz);
  add(text, " Hz; residuals:");
  int n = 0, without = 0;
  for (int ch = 0; ch < CHANNELS; ch++)
    if (residual_has(fit, ch)) add(text, "%s %s", n++ ? "," : "", gap_channel[ch]);
  for (int ch = 0; ch < CHANNELS; ch++)
    if (!residual_has(fit, ch))
      add(text, "%s %s", without++ ? "," : n ? "; none of" : " none of", gap_channel[ch]);
}

// Returns the widest range of heading in one flight, degrees, at most 360; -1 without attitude.
static double heading_deg(const set_t *s) {
  double most = -1.0;
  for (int f = 0; f < s->n_grid; f++) {
    const grid_t *const g = &s->grid[f];
    double low = HUGE_VAL, high = -HUGE_VAL, at = 0.0;
    for (int j = 0; g->has_attitude && j < g->n; j++) {
      if (!g->point[j].ok) continue;
      const axes_t axes = axes_of(g->point[j].q_wb);
      const double heading = atan2(axes.x.y, axes.x.x);
      at = low > high ? heading : at + remainder(heading - at, 360.0 / DEGREES);
      low = fmin(low, at);
      high = fmax(high, at);
    }
    if (high >= low) most = fmax(most, DEGREES * (high - low));
  }
  return fmin(most, 360.0);
}

static void tell_motion(const report_t *r, char text[REPORT_LONG]) {
  const set_t *const fit = &r->study->diagnosis.fit;
  for (int i = 0; i < COORDINATES; i++) {
    const interval_t span = report_span(fit, &fit->smooth, &r->study->vehicle, i, OUTSIDE);
    if (i == COORDINATE_TIME || isnan(span.from)) continue;
    add(text, "%s%s %.3g to %.3g %s", text[0] ? ", " : "", coordinate_name(i), span.from, span.to,
        coordinate_unit(i));
  }
  const double turned = heading_deg(fit);
  if (turned >= 0.0) add(text, "%sheading over %.0f degrees", text[0] ? ", " : "", turned);
}

// --- what they could show ---------------------------------------------------------------------------------

static void tell_shown(const report_t *r, char text[REPORT_LONG]) {
  int n = 0;
  for (int i = 0; i < r->n_finding; i++) add(text, "%s%s", n++ ? ", " : "", r->finding[i].name);
  for (int i = 0; i < r->n_shown; i++) add(text, "%s%s", n++ ? ", " : "", r->shown[i].fx->name);
  if (n == 0) add(text, "no effect of typical size");
}

// Adds one member of the group: the effect's name, and the number's name if the effect has several.
static void tell_number(const candidate_t *c, int k, const char *before, char text[REPORT_LONG]) {
  int n;
  const fx_param_t *const param = fx_use_params(&c->use, &n);
  add(text, "%s%s%s%s", before, c->use.fx->name, c->n > 1 ? " " : "",
      c->n > 1 ? param[c->use.fx->size[k].param].name : "");
}

// True if the text has this group already: kinds of the same effects can form two groups.
static bool is_told(const char *group, const char *text) {
  const size_t size = strlen(group);
  for (const char *at = strstr(text, group); at; at = strstr(at + 1, group))
    if ((at == text || (at - text > 1 && at[-2] == ';')) && (at[size] == '\0' || at[size] == ';'))
      return true;
  return false;
}

static void tell_group(const diagnosis_t *d, int first, char text[REPORT_LONG]) {
  char group[REPORT_LONG] = "";
  const fx_t *last = NULL;
  int n = 0;
  for (int i = 0; i < d->candidates.n; i++)
    for (int k = 0; k < d->candidates.candidate[i].n; k++) {
      const candidate_t *const c = &d->candidates.candidate[i];
      if (d->found.alike[c->first + k] != first || c->use.fx == last) continue;
      tell_number(c, k, n ? " = " : "", group);
      last = c->use.fx;
      n++;
    }
  if (n > 1 && !is_told(group, text)) add(text, "%s%s", text[0] ? "; " : "", group);
}

static void tell_alike(const report_t *r, char text[REPORT_LONG]) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int first = 0; first < d->candidates.columns; first++) tell_group(d, first, text);
}

// --- a ceiling that the vehicle file lacks ----------------------------------------------------------------

// Sums over an upward range sensor's samples from a range on: height of what it sees, and range.
typedef struct {
  double n, at, at_squares, range, range_squares;
} seen_t;

static seen_t seen_from(const report_t *r, double from_m) {
  const set_t *const s = &r->study->diagnosis.fit;
  const double sensor_m = body_rest_z_m(&r->study->vehicle) + body_rotor_z_m(&r->study->vehicle);
  seen_t sum = {.n = 0.0};
  for (int f = 0; f < s->n_grid; f++) {
    const gap_flight_t *const flight = s->grid[f].flight;
    for (int i = 0; flight->v[SIG_RANGE] && flight->v[SIG_Z] && i < flight->n; i++) {
      const double range_m = flight->v[SIG_RANGE][i], at_m = flight->v[SIG_Z][i] + sensor_m + range_m;
      if (!isfinite(at_m) || range_m < from_m) continue;
      sum.n += 1.0;
      sum.at += at_m, sum.at_squares += at_m * at_m;
      sum.range += range_m, sum.range_squares += range_m * range_m;
    }
  }
  return sum;
}

// Returns the height of a ceiling that the upward range sensor sees, m; NaN if it sees none. Uses the samples
// beyond the mean range: near its shortest range a sensor reads too much.
static double seen_ceiling_m(const report_t *r) {
  const seen_t all = seen_from(r, 0.0);
  if (!(all.n > 0.0)) return (double)NAN;
  const seen_t far = seen_from(r, all.range / all.n);
  const double mean = far.at / far.n, spread = far.at_squares / far.n - mean * mean;
  // A ceiling stays where it is while the range changes.
  return spread < far.range_squares / far.n - pow(far.range / far.n, 2.0) ? mean : (double)NAN;
}

// Finds the window of height in which the lift residual differs most. Each flight's own constant is taken out
// first: flights at different heights may differ in weight, which is no ceiling.
static done_t lift_by_height(const diagnosis_t *d, cell_t of[CHANNELS], why_t *why) {
  const int height = COORDINATE_HEIGHT;
  const rows_t *const rows = &d->fit.smooth;
  color_t color[CHANNELS];
  double *left[CHANNELS], *const lift = malloc(((size_t)rows->n + 1) * sizeof(double));
  if (!lift) return error_failed(why, "out of memory");
  memcpy(left, d->residual, sizeof left);
  memcpy(lift, d->residual[CH_FZ], (size_t)rows->n * sizeof(double));
  if (d->fit.n_grid > 1) rows_center(rows, lift);
  left[CH_FZ] = lift;
  done_t status = unknown_colors(&d->fit, &d->extended, left, color, why);
  if (status == DONE)
    status = unknown_along(&d->fit, &d->extended, height, height + 1, left, color, true, of, why);
  free(lift);
  return status;
}

static done_t look_for_ceiling(report_t *r, why_t *why) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const int height = COORDINATE_HEIGHT;
  cell_t of[CHANNELS];
  if (isfinite(r->study->vehicle.ceiling_m) || !d->nominal_flew || !residual_has(&d->fit, CH_FZ)) return DONE;
  TRY(lift_by_height(d, of, why));
  const cell_t cell = of[CH_FZ];
  const bool grows = cell.size > 0.0 ? cell.last : cell.first; // more lift above can show as less below
  if (!(cell.statistic > d->left.chance[unknown_cell(CH_FZ, height, false)] && grows)) return DONE;
  const double at_m = r->ceiling_seen_m = seen_ceiling_m(r);
  char seen[REPORT_TEXT] = "";
  r->ceiling_suspected = true;
  if (isfinite(at_m)) snprintf(seen, sizeof seen, "; the range sensor sees something at %.2f m", at_m);
  note(&r->fitness,
       "ceiling: lift grows by %.2g m/s2 towards the greatest heights, from %.3g m on, and the vehicle file "
       "has no ceiling_m%s",
       fabs(cell.size), cell.size > 0.0 ? cell.from : cell.to, seen);
  return DONE;
}

done_t report_take_fitness(report_t *r, why_t *why) {
  static const struct {
    const char *head;
    void (*tell)(const report_t *r, char text[REPORT_LONG]);
  } part[] = {{"flights: ", tell_logs},
              {"flown: ", tell_motion},
              {"of typical size they would show, by name: ", tell_shown},
              {"not told apart at typical size: ", tell_alike}};
  for (unsigned i = 0; i < sizeof part / sizeof *part; i++) {
    char text[REPORT_LONG] = "";
    part[i].tell(r, text);
    if (text[0]) note(&r->fitness, "%s%s", part[i].head, text);
  }
  return look_for_ceiling(r, why);
}
