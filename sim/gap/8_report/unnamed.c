// unnamed.c - what the report says of a residual that no name explains.
#include "gap/8_report/report.h"

#include <math.h>

const char *report_place(const report_t *r, const cell_t *c, char text[REPORT_PLACE]) {
  text[0] = '\0';
  if (c->along == BY_FLIGHT) {
    text_add(text, REPORT_PLACE, "from flight to flight");
    return text;
  }
  if (c->is_pulse) {
    text_add(text, REPORT_PLACE, "at time %.2f to %.2f s of %s", c->from, c->to, report_log_name(r, c->log));
    return text;
  }
  text_add(text, REPORT_PLACE, "at %s %.3g to %.3g %s", c->coordinate, c->from, c->to, c->unit);
  if (c->is_patch) text_add(text, REPORT_PLACE, ", y %.3g to %.3g m", c->y_from_m, c->y_to_m);
  return text;
}

const char *report_cell(const report_t *r, const cell_t *c, char text[REPORT_CELL]) {
  char where[REPORT_PLACE];
  const bool differs = c->along == BY_FLIGHT; // its size is a spread, and has no sign
  snprintf(text, REPORT_CELL, "%s%.3g +- %.1g %s%s in %s%s, %s", differs || c->size < 0.0 ? "" : "+", c->size,
           cell_error(c), gap_unit[c->channel], differs ? " rms" : "", gap_channel[c->channel],
           c->world ? " (the world's)" : "", report_place(r, c, where));
  return text;
}

// --- as which effect it acts ------------------------------------------------------------------------------

static void add_shape(char *text, size_t room, const fx_use_t *use) {
  int n;
  const fx_param_t *const param = fx_use_params(use, &n);
  if (use->form) text_add(text, room, "form %s, ", use->form->name);
  if (fx_use_has_shape(use))
    text_add(text, room, "%s %.3g, ", param[use->fx->shape_param].name, use->p[use->fx->shape_param]);
}

static const fx_param_t *size_of(const fx_use_t *use, int k) {
  int n;
  return &fx_use_params(use, &n)[use->fx->size[k].param];
}

static void add_use(char text[REPORT_FOR_A_TIME], const fx_use_t *use) {
  add_shape(text, REPORT_FOR_A_TIME, use);
  for (int k = 0; k < use->fx->n_size; k++) {
    const fx_param_t *const p = size_of(use, k);
    text_add(text, REPORT_FOR_A_TIME, "%s%s %.3g%s%s", k ? ", " : "", p->name, fx_use_size(use, k),
             text_gap(p->unit), p->unit);
  }
}

const char *report_for_a_time(const for_a_time_t *f, char text[REPORT_FOR_A_TIME]) {
  text[0] = '\0';
  text_add(text, REPORT_FOR_A_TIME, "at %s%.1f to %.1f s it acts as ", f->outside ? "all times but " : "",
           f->from_s, f->to_s);
  for (int i = 0; i < f->as.n; i++) {
    const would_do_t *const would = &f->as.would[i];
    text_add(text, REPORT_FOR_A_TIME, "%s%s would (", i ? ", or " : "", would->use.fx->name);
    add_use(text, &would->use);
    text_add(text, REPORT_FOR_A_TIME, ": %.0f %% of what is there more)", 100.0 * would->share);
  }
  return text;
}

// --- what flights differ by -------------------------------------------------------------------------------

static void add_sizes(char text[REPORT_DIFFER], const flights_differ_t *d, const fx_use_t *use) {
  const int told = d->n < FLIGHTS_TOLD ? d->n : FLIGHTS_TOLD;
  bool first = true;
  add_shape(text, REPORT_DIFFER, use);
  for (int k = 0; k < use->fx->n_size; k++) {
    const fx_param_t *const p = size_of(use, k);
    double largest = 0.0;
    for (int f = 0; f < d->n; f++) largest = fmax(largest, fabs(fx_use_size(&use[f], k)));
    if (!(largest > 0.0)) continue; // the candidate is about the other sizes
    text_add(text, REPORT_DIFFER, "%s%s ", first ? "" : "; ", p->name);
    first = false;
    for (int f = 0; f < told; f++)
      text_add(text, REPORT_DIFFER, "%s%.3g", f ? ", " : "", fx_use_size(&use[f], k));
    text_add(text, REPORT_DIFFER, "%s%s%s", d->n > told ? ", .." : "", text_gap(p->unit), p->unit);
  }
}

const char *report_differ(const report_t *r, const flights_differ_t *d, char text[REPORT_DIFFER]) {
  text[0] = '\0';
  const int told = d->n < FLIGHTS_TOLD ? d->n : FLIGHTS_TOLD;
  text_add(text, REPORT_DIFFER,
           "%s is another in each flight, about the mean of all: ", gap_channel[d->cell.channel]);
  for (int f = 0; f < told; f++)
    if (d->error[f] > 0.0)
      text_add(text, REPORT_DIFFER, "%+.3g in %s, ", d->mean[f],
               report_log_name(r, &r->study->fit.flight[f]));
  double error = 0.0;
  for (int f = 0; f < d->n; f++) error = fmax(error, d->error[f]);
  text_add(text, REPORT_DIFFER, "%s+- %.1g %s", d->n > told ? ".. " : "", error, gap_unit[d->cell.channel]);
  for (int i = 0; i < d->as.n; i++) {
    const would_do_t *const would = &d->as.would[i];
    text_add(text, REPORT_DIFFER,
             i ? ", or as %s would ("
               : "; beyond the file and what is named it acts as %s would, of another size in each (",
             would->use.fx->name);
    add_sizes(text, d, d->use + i * d->n);
    text_add(text, REPORT_DIFFER, ": %.0f %% of the difference)", 100.0 * would->share);
  }
  return text;
}

void report_add_flight(of_flights_t *to, const report_t *r, int channel, int flight, double value) {
  const gap_flight_t *const log = r->study->diagnosis.held.grid[flight].flight;
  if (to->n < FLIGHTS_TOLD)
    text_add(to->text, REPORT_TEXT, "%s%+.2g %s in %s", to->n ? ", " : "", value, gap_unit[channel],
             report_log_name(r, log));
  else if (to->n == FLIGHTS_TOLD)
    text_add(to->text, REPORT_TEXT, ", ..");
  to->n++;
}

void report_warn_of_own(report_t *r) {
  const set_t *const held = &r->study->diagnosis.held;
  for (int ch = 0; ch < CHANNELS && r->own && !r->study->by_time; ch++) {
    const gap_part_t *const p = &r->study->diagnosis.held_out.channel[ch];
    of_flights_t which = {.n = 0};
    for (int f = 0; f < held->n_grid; f++) {
      const double own = r->own[f * CHANNELS + ch];
      if (fabs(own) > LEFT_OVER * p->floor) report_add_flight(&which, r, ch, f, own);
    }
    if (p->used && which.n)
      note(&r->warnings,
           "%s: %s is left out of what is held out: as the fitted flights differ, it is taken for that "
           "flight's own",
           gap_channel[ch], which.text);
  }
}
