// screen.c - the verdict in words: one screen of a terminal.
#include "gap/8_report/report.h"

#include <math.h>
#include <string.h>

#define WARNINGS 4   // shown on the screen; the files have all
#define COLUMNS  112 // of wrapped lines

static void print_number(const number_t *k, const char *before, FILE *out) {
  const char *const unit = report_unit(k);
  if (isnan(k->value)) {
    fprintf(out, "%s%s not shown", before, k->param->name);
    return;
  }
  fprintf(out, "%s%s %.3g", before, k->param->name, k->value);
  if (!k->no_stderr) fprintf(out, " +- %.2g", k->stderr_);
  fprintf(out, "%s%s", text_gap(unit), unit);
  if (isfinite(k->in_file)) fprintf(out, " (the file has %.3g)", k->in_file);
}

// Leaves out the p value of an ambiguous name: a small one would suggest that the name is sure.
static void print_numbers(const finding_t *f, FILE *out) {
  char p[P_TEXT];
  for (int k = 0; k < f->n_number; k++) print_number(&f->number[k], k ? ", " : "", out);
  if (f->use->form) fprintf(out, ", form %s", f->use->form->name);
  fprintf(out, "; %.3g %% of the gap; %s", 100.0 * f->named->share, standing_name[f->standing]);
  if (f->standing == STANDS_AMBIGUOUS) return;
  if (isfinite(f->named->probability)) fprintf(out, ", probability %.3g", report_probability(f));
  fprintf(out, ", %s", p_words(f->named->p, p));
}

static void print_effect(const finding_t *f, FILE *out) {
  const int coordinate = f->profile.coordinate;
  const char *const unit = gap_unit[f->profile.channel];
  fprintf(out, "\n%s: %s\n  ", f->name, f->fx->brief);
  print_numbers(f, out);
  fprintf(out, "\n  %s; seen in %s, %s %.3g to %.3g %s", f->says, gap_channel[f->profile.channel],
          coordinate_name(coordinate), f->where.from, f->where.to, coordinate_unit(coordinate));
  if (f->before > 0.0 && f->fx->surface)
    fprintf(out, "; held out, nearer than %.3g m: %.3g -> %.3g %s rms", f->matters.to, f->before, f->after,
            unit);
  else if (f->before > 0.0)
    fprintf(out, "; held out, there: %.3g -> %.3g %s rms", f->before, f->after, unit);
  fputc('\n', out);
  if (f->instrument[0]) fprintf(out, "  %s\n", f->instrument);
  if (!f->named->n_rival) return;
  fputs("  would do as well:", out);
  for (int i = 0; i < f->named->n_rival; i++) fprintf(out, "%s %s", i ? "," : "", f->named->rival[i]->name);
  fprintf(out, "; to tell them apart, fly: %s\n", f->fly);
}

// Prints a text, indented and wrapped between words.
static void print_wrapped(const char *text, FILE *out) {
  int column = 0;
  for (const char *word = text; *word;) {
    const int n = (int)strcspn(word, " ");
    if (column && column + 1 + n > COLUMNS) column = 0, fputs("\n   ", out);
    fprintf(out, "%s%.*s", column ? " " : word == text ? "  " : " ", n, word);
    column += n + 1;
    word += n + (word[n] == ' ');
  }
  fputc('\n', out);
}

static void print_unknown(const report_t *r, FILE *out) {
  const diagnosis_t *const d = &r->study->diagnosis;
  char where[REPORT_PLACE], cell[REPORT_CELL], acts[REPORT_FOR_A_TIME], differ[REPORT_DIFFER];
  fprintf(out, "\nunknown: %s", report_cell(r, &d->left.cell, cell));
  if (d->left.also.statistic > 0.0)
    fprintf(out, "; it could be %s as well", report_place(r, &d->left.also, where));
  fputc('\n', out);
  if (d->for_a_time.as.n) fprintf(out, "  %s\n", report_for_a_time(&d->for_a_time, acts));
  for (int i = 0; i < GROUPS; i++)
    if (d->differ[i].n) print_wrapped(report_differ(r, &d->differ[i], differ), out);
}

static void print_gap(const report_t *r, FILE *out) {
  const study_t *const s = r->study;
  if (!report_has_residual(r)) return;
  fprintf(out, "\nheld out: ");
  if (s->by_time)
    fprintf(out, "stretches of 2 s of %s, by turns\n", s->fit.n > 1 ? "each flight" : "the flight");
  else
    fprintf(out, "%d of %d flights\n", s->held.n, s->held.n + s->fit.n);
  fprintf(out, "  %-9s %-7s %9s %9s %9s\n", "residual", "rms in", "before", "after", "floor");
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &s->diagnosis.held_out.channel[ch];
    if (!p->used) continue;
    fprintf(out, "  %-9s %-7s %9.3g %9.3g ", gap_channel[ch], gap_unit[ch], p->before, p->after);
    // A floor above what is left would suggest that the model is better than it can be.
    const left_over_t left = report_adequacy(r, ch);
    if ((left == LEFT_NOISE || left == LEFT_MORE) && p->after >= p->floor)
      fprintf(out, "%9.3g\n", p->floor);
    else
      fprintf(out, " %s\n", left_name[left]);
  }
  const resimulation_t *const a = &s->resimulation;
  char before[REPORT_LENGTH], after[REPORT_LENGTH], low[REPORT_LENGTH], high[REPORT_LENGTH];
  if (a->flew)
    fprintf(out, "flown again in closed loop: %s -> %s rms from the measured track; in height %s -> %s\n",
            report_length(a->before.rms_m, before), report_length(a->after.rms_m, after),
            report_length(a->before.height_m, low), report_length(a->after.height_m, high));
}

static void print_untested(const report_t *r, FILE *out) {
  if (!r->n_untested) return;
  fputs("\ncannot be told from these flights (the report of --out says what to fly):\n  ", out);
  for (int i = 0; i < r->n_untested; i++)
    fprintf(out, "%s%s", i == 0 ? "" : i % 7 ? ", " : ",\n  ", r->untested[i].fx->name);
  fputc('\n', out);
}

// Prints each name, or its family and what that does.
static void print_missing(const report_t *r, FILE *out) {
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    fprintf(out, "%s %s", i ? ";" : "", f->family);
    if (f->named->n_rival) fprintf(out, " (%s)", f->says);
  }
  fprintf(out, "%s.\n", r->study->diagnosis.unknown ? "; and something that has no name" : "");
}

// Prints, if nothing is missing, what these flights would have shown.
static void print_shown(const report_t *r, FILE *out) {
  for (int i = 0; i < r->n_shown; i++) {
    const shown_t *const s = &r->shown[i];
    fprintf(out, "%s%s %s %.2g%s%s%s", i ? ", " : "  They would have shown, from this size on: ", s->fx->name,
            s->param->name, s->from, text_gap(s->param->unit), s->param->unit,
            s->in_file ? " more or less" : "");
  }
  if (r->n_shown) fputs(".\n", out);
}

static void print_verdict(const report_t *r, FILE *out) {
  const char *const vehicle = study_vehicle(r->study);
  if (r->n_finding) {
    fprintf(out, "Missing in %s:", vehicle);
    print_missing(r, out);
    return;
  }
  report_headline(r, vehicle, out);
  fputs(".\n", out);
  if (!r->study->diagnosis.unknown && report_can_tell(r) && report_adequacy_of_all(r) != LEFT_MORE)
    print_shown(r, out);
}

void report_words(const report_t *r, FILE *out) {
  for (int i = 0; i < r->fitness.n; i++) print_wrapped(r->fitness.line[i], out);
  if (r->fitness.n) fputc('\n', out);
  print_verdict(r, out);
  for (int i = 0; i < r->n_finding; i++) print_effect(&r->finding[i], out);
  if (r->n_finding) fprintf(out, "\nleft: %.3g %% of the gap, noise among it\n", 100.0 * report_left(r));
  if (r->study->diagnosis.unknown) print_unknown(r, out);
  print_gap(r, out);
  print_untested(r, out);
  for (int i = 0; i < r->warnings.n && i < WARNINGS; i++)
    fprintf(out, "%snote: %s\n", i ? "" : "\n", r->warnings.line[i]);
  if (r->warnings.n > WARNINGS)
    fprintf(out, "note: and %d more in the report of --out\n", r->warnings.n - WARNINGS);
  fputs("\nWhat to do now\n", out);
  for (int i = 0; i < r->to_do.n; i++) fprintf(out, "  %s\n", r->to_do.line[i]);
}
