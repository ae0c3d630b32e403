// screen.c - the verdict in words: one screen of a terminal.
#include "gap/8_report/report.h"

#include "gap/5_infer/unknown.h"
#include <math.h>
#include <string.h>

#define WARNINGS 4 // on the screen; the files have all

static void print_value(const finding_t *f, int k, double wide, FILE *out) {
  int n;
  const fx_param_t *const p = &fx_use_params(f->use, &n)[f->fx->size[k].param];
  fprintf(out, "%s%s %.3g +- %.2g%s%s", k ? ", " : "", p->name, fx_use_size(f->use, k),
          wide * f->named->stderr_[k], p->unit[0] ? " " : "", p->unit);
}

static void print_shape(const finding_t *f, double wide, FILE *out) {
  int n;
  const fx_param_t *const p = &fx_use_params(f->use, &n)[f->fx->shape_param];
  fprintf(out, ", %s %.3g", p->name, f->use->p[f->fx->shape_param]);
  if (f->named->shape_stderr > 0.0) fprintf(out, " +- %.2g", wide * f->named->shape_stderr);
  if (p->unit[0] && !fx_is_number(p)) fprintf(out, " %s", p->unit);
}

static void print_effect(const finding_t *f, double wide, FILE *out) {
  const int coordinate = f->profile.coordinate;
  char p[P_TEXT], words[REPORT_TEXT];
  fprintf(out, "\n%s: %s\n  ", f->fx->name, f->fx->brief);
  for (int k = 0; k < f->fx->n_size; k++) print_value(f, k, wide, out);
  if (f->fx->n_shape) print_shape(f, wide, out);
  if (f->use->form) fprintf(out, ", form %s", f->use->form->name);
  fprintf(out, "; %.3g %% of the gap, %s\n", 100.0 * f->named->share, p_words(f->named->p, p));
  fprintf(out, "  seen in %s, %s %.3g to %.3g %s", gap_channel[f->profile.channel],
          coordinate_name(coordinate), f->where.from, f->where.to, coordinate_unit(coordinate));
  if (f->before > 0.0 && f->fx->surface)
    fprintf(out, "; held out, nearer than %.3g m: %.3g -> %.3g %s rms", f->matters.to, f->before, f->after,
            gap_unit[f->profile.channel]);
  else if (f->before > 0.0)
    fprintf(out, "; held out, there: %.3g -> %.3g %s rms", f->before, f->after, gap_unit[f->profile.channel]);
  fputc('\n', out);
  if (report_confirm(f, words)) fprintf(out, "  %s\n", words);
  if (!f->named->n_rival) return;
  fputs("  would do as well:", out);
  for (int i = 0; i < f->named->n_rival; i++) fprintf(out, "%s %s", i ? "," : "", f->named->rival[i]->name);
  fprintf(out, "; to tell them apart, fly: %s\n", f->fly);
}

static void print_gap(const report_t *r, FILE *out) {
  const study_t *const s = r->study;
  if (!report_has_residual(r)) return;
  fprintf(out, "\nheld out: ");
  if (s->by_time)
    fprintf(out, "the last third of %s\n", s->fit.n > 1 ? "each flight" : "the flight");
  else
    fprintf(out, "%d of %d flights\n", s->held.n, s->held.n + s->fit.n);
  fprintf(out, "  %-9s %-7s %9s %9s %9s\n", "residual", "rms in", "before", "after", "floor");
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &s->diagnosis.held_out.channel[ch];
    if (!p->used) continue;
    fprintf(out, "  %-9s %-7s %9.3g %9.3g ", gap_channel[ch], gap_unit[ch], p->before, p->after);
    if (s->diagnosis.nominal_flew)
      fprintf(out, "%9.3g\n", p->floor);
    else
      fprintf(out, "%9s\n", "not known");
  }
  const resimulation_t *const a = &s->resimulation;
  char before[REPORT_LENGTH], after[REPORT_LENGTH], low[REPORT_LENGTH], high[REPORT_LENGTH];
  if (a->flew)
    fprintf(out, "flown again in closed loop: %s -> %s rms from the measured track; in height %s -> %s\n",
            report_length(a->before_m, before), report_length(a->after_m, after),
            report_length(a->before_height_m, low), report_length(a->after_height_m, high));
}

static void print_untested(const report_t *r, FILE *out) {
  int n = 0;
  for (int i = 0; i < r->n_untested; i++) {
    if (!r->untested[i].obstacle && r->untested[i].testable) continue;
    fprintf(out, "%s%s",
            n ? (n % 7 ? ", " : ",\n  ")
              : "\ncannot be told from these flights (the report of --out says what to fly):\n  ",
            r->untested[i].fx->name);
    n++;
  }
  if (n) fputc('\n', out);
}

void report_words(const report_t *r, FILE *out) {
  const study_t *const s = r->study;
  const cell_t *const c = &s->diagnosis.cell;
  const bool named = r->n_finding > 0, unknown = s->diagnosis.unknown;
  if (named) {
    fprintf(out, "Missing in %s:", study_vehicle(s));
    for (int i = 0; i < r->n_finding; i++) fprintf(out, "%s %s", i ? "," : "", r->finding[i].fx->name);
    fprintf(out, "%s.\n", unknown ? ", and something that has no name" : "");
  } else if (unknown)
    fprintf(out, "Something is missing in %s that cannot be named.\n", study_vehicle(s));
  else if (!report_can_tell(r))
    fprintf(out, "These flights cannot tell what is missing in %s.\n", study_vehicle(s));
  else if (report_leaves_any(r))
    fprintf(out,
            "Nothing can be named that is missing in %s, and more is left than noise and feedback leave (see "
            "the notes).\n",
            study_vehicle(s));
  else
    fprintf(out, "Nothing is missing in %s that these flights could show.\n", study_vehicle(s));
  for (int i = 0; i < r->n_finding; i++) print_effect(&r->finding[i], r->wide, out);
  if (unknown)
    fprintf(out, "\nunknown: %+.3g %s in %s, at %s %.3g to %.3g %s\n", c->size, gap_unit[c->channel],
            gap_channel[c->channel], c->coordinate, c->from, c->to, c->unit);
  print_gap(r, out);
  print_untested(r, out);
  for (int i = 0; i < r->n_warning && i < WARNINGS; i++)
    fprintf(out, "%snote: %s\n", i ? "" : "\n", r->warning[i]);
  if (r->n_warning > WARNINGS)
    fprintf(out, "note: and %d more in the report of --out\n", r->n_warning - WARNINGS);
}
