// fitness.c - are these flights fit for the question: what was flown, what it could show and tell apart, what
// the vehicle file lacks.
#include "gap/8_report/report.h"

#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define DEGREES (180.0 / 3.14159265358979323846)

static void add(char text[REPORT_LONG], const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add(char text[REPORT_LONG], const char *format, ...) {
  const size_t used = strlen(text);
  va_list args;
  va_start(args, format);
  vsnprintf(text + used, REPORT_LONG - used, format, args);
  va_end(args);
}

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

// The middle 90 % of a coordinate; false: it is not there.
static bool span_of(const report_t *r, int coordinate, double *v, interval_t *span) {
  const set_t *const fit = &r->study->diagnosis.fit;
  const rows_t *const rows = &fit->smooth;
  int n = 0;
  for (int i = 0; i < rows->n; i++) {
    const double x =
        coordinate_of(coordinate, &fit->grid[rows->flight[i]], &r->study->vehicle, rows->point[i]);
    if (!isnan(x)) v[n++] = x;
  }
  if (n == 0) return false;
  qsort(v, (size_t)n, sizeof *v, by_size);
  *span = (interval_t){v[n / 20], v[n - 1 - n / 20]};
  return true;
}

// The widest arc that the nose went over in one flight, at most a full turn.
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

static void tell_motion(const report_t *r, double *room, char text[REPORT_LONG]) {
  interval_t span;
  for (int i = 0; i < COORDINATES; i++) {
    if (i == COORDINATE_TIME || !span_of(r, i, room, &span)) continue;
    add(text, "%s%s %.3g to %.3g %s", text[0] ? ", " : "", coordinate_name(i), span.from, span.to,
        coordinate_unit(i));
  }
  const double turned = heading_deg(&r->study->diagnosis.fit);
  if (turned >= 0.0) add(text, "%sheading over %.0f degrees", text[0] ? ", " : "", turned);
}

// --- what they could show ---------------------------------------------------------------------------------

static void tell_shown(const report_t *r, char text[REPORT_LONG]) {
  int n = 0;
  for (int i = 0; i < r->n_finding; i++) add(text, "%s%s", n++ ? ", " : "", r->finding[i].fx->name);
  for (int i = 0; i < r->n_untested; i++) {
    const untested_t *const u = &r->untested[i];
    if (!u->obstacle && u->testable) add(text, "%s%s", n++ ? ", " : "", u->fx->name);
  }
  if (n == 0) add(text, "no effect of typical size");
}

// One of the group: its name, and which of its numbers where it has several.
static void tell_number(const candidate_t *c, int k, const char *before, char text[REPORT_LONG]) {
  int n;
  const fx_param_t *const param = fx_use_params(&c->use, &n);
  add(text, "%s%s%s%s", before, c->use.fx->name, c->n > 1 ? " " : "",
      c->n > 1 ? param[c->use.fx->size[k].param].name : "");
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
  if (n > 1) add(text, "%s%s", text[0] ? "; " : "", group);
}

static void tell_alike(const report_t *r, char text[REPORT_LONG]) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int first = 0; first < d->candidates.columns; first++) tell_group(d, first, text);
}

// --- a ceiling that the vehicle file lacks ----------------------------------------------------------------

typedef struct {
  double n, sum, squares;
} sums_t;

static void add_sample(sums_t *s, double v) {
  s->n += 1.0;
  s->sum += v;
  s->squares += v * v;
}

// Sums of where an upward range sensor sees something, of the samples from this range on; their ranges.
static void add_ranges(const report_t *r, double from_m, sums_t *at, sums_t *range) {
  const set_t *const s = &r->study->diagnosis.fit;
  const double sensor_m = body_rest_z_m(&r->study->vehicle) + body_rotor_z_m(&r->study->vehicle);
  for (int f = 0; f < s->n_grid; f++) {
    const gap_flight_t *const flight = s->grid[f].flight;
    for (int i = 0; flight->range_up_m && flight->v[SIG_Z] && i < flight->n; i++) {
      const double range_m = flight->range_up_m[i], at_m = flight->v[SIG_Z][i] + sensor_m + range_m;
      if (!isfinite(at_m) || range_m < from_m) continue;
      add_sample(at, at_m);
      add_sample(range, range_m);
    }
  }
}

// By the farther half of the samples: near its floor a sensor reads too much. NaN: nothing, or nothing that
// stays.
static double seen_ceiling_m(const report_t *r) {
  sums_t at = {0.0, 0.0, 0.0}, range = at, far_at = at, far_range = at;
  add_ranges(r, 0.0, &at, &range);
  if (!(at.n > 0.0)) return (double)NAN;
  add_ranges(r, range.sum / range.n, &far_at, &far_range);
  const double mean = far_at.sum / far_at.n, spread = far_at.squares / far_at.n - mean * mean;
  // A ceiling stays where it is while the range changes.
  return spread < far_range.squares / far_range.n - pow(far_range.sum / far_range.n, 2.0) ? mean
                                                                                          : (double)NAN;
}

static done_t look_for_ceiling(report_t *r, why_t *why) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const int height = COORDINATE_HEIGHT;
  color_t color[CHANNELS];
  cell_t cell;
  if (isfinite(r->study->vehicle.ceiling_m) || !d->nominal_flew || !residual_has(&d->fit, CH_FZ)) return DONE;
  TRY(unknown_colors(&d->fit, &d->extended, d->residual, color, why));
  for (int ch = 0; ch < CHANNELS; ch++) color[ch].used = color[ch].used && ch == CH_FZ;
  TRY(unknown_along(&d->fit, &d->extended, height, d->residual, color, &cell, why));
  if (!(cell.statistic > d->left.chance[unknown_cell(CH_FZ, height, false)] && cell.size > 0.0 && cell.last))
    return DONE;
  const double at_m = seen_ceiling_m(r);
  r->ceiling_suspected = true;
  add(r->fitness[r->n_fitness++],
      "ceiling: lift grows by %.2g m/s2 towards the greatest heights, %.3g to %.3g m, and the vehicle file "
      "has no "
      "ceiling_m",
      cell.size, cell.from, cell.to);
  if (isfinite(at_m)) {
    r->ceiling_seen_m = at_m;
    add(r->fitness[r->n_fitness - 1], "; the range sensor sees something at %.2f m", at_m);
  }
  return DONE;
}

done_t report_take_fitness(report_t *r, why_t *why) {
  static const char *const head[] = {"flights: ", "flown: ", "of typical size they would show, by name: ",
                                     "not told apart at typical size: "};
  double *const room = malloc(set_most_rows(&r->study->diagnosis.fit) * sizeof(double));
  if (!room) return error_failed(why, "out of memory");
  r->ceiling_seen_m = (double)NAN;
  for (int i = 0; i < 4; i++) {
    char text[REPORT_LONG] = "";
    if (i == 0) tell_logs(r, text);
    if (i == 1) tell_motion(r, room, text);
    if (i == 2) tell_shown(r, text);
    if (i == 3) tell_alike(r, text);
    if (text[0]) add(r->fitness[r->n_fitness++], "%s%s", head[i], text);
  }
  free(room);
  return look_for_ceiling(r, why);
}
