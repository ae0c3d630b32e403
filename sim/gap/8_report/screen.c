// screen.c - the verdict in words: one screen of a terminal.
#include "gap/8_report/report.h"

#include "gap/5_infer/unknown.h"
#include <math.h>
#include <string.h>

#define WARNINGS 4   // on the screen; the files have all
#define COLUMNS  112 // of the long lines

static void print_value(const finding_t *f, int k, FILE *out) {
  int n;
  const fx_param_t *const p = &fx_use_params(f->use, &n)[f->fx->size[k].param];
  fprintf(out, "%s%s %.3g +- %.2g%s%s", k ? ", " : "", p->name, fx_use_size(f->use, k), f->named->stderr_[k],
          p->unit[0] ? " " : "", p->unit);
  if (f->in_file) fprintf(out, " (the file has %.3g)", fx_use_size(f->in_file, k));
}

static void print_shape(const finding_t *f, FILE *out) {
  int n;
  const fx_param_t *const p = &fx_use_params(f->use, &n)[f->fx->shape_param];
  fprintf(out, ", %s %.3g", p->name, f->use->p[f->fx->shape_param]);
  if (f->named->shape_stderr > 0.0) fprintf(out, " +- %.2g", f->named->shape_stderr);
  if (p->unit[0] && !fx_is_number(p)) fprintf(out, " %s", p->unit);
}

static void print_kind(const finding_t *f, FILE *out) {
  int n;
  fprintf(out, ", %s %g", fx_use_params(f->use, &n)[fx_use_kind(f->use)].name,
          f->use->p[fx_use_kind(f->use)]);
}

// A small p beside a name that others could have would say that the name is sure.
static void print_numbers(const finding_t *f, FILE *out) {
  char p[P_TEXT];
  for (int k = 0; k < f->fx->n_size; k++) print_value(f, k, out);
  if (fx_use_has_shape(f->use)) print_shape(f, out);
  if (f->fx->n_kind) print_kind(f, out);
  if (f->use->form) fprintf(out, ", form %s", f->use->form->name);
  fprintf(out, "; %.3g %% of the gap; %s", 100.0 * f->named->share, standing_name[f->standing]);
  if (f->standing != STANDS_AMBIGUOUS) fprintf(out, ", %s", p_words(f->named->p, p));
}

static void print_effect(const finding_t *f, FILE *out) {
  const int coordinate = f->profile.coordinate;
  char words[REPORT_TEXT];
  fprintf(out, "\n%s: %s\n  ", f->fx->name, f->fx->brief);
  print_numbers(f, out);
  fprintf(out, "\n  %s; seen in %s, %s %.3g to %.3g %s", f->says, gap_channel[f->profile.channel],
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
    // A floor above what is left would say that the model is better than it can be.
    const left_over_t left = report_adequacy(r, ch);
    if (left == LEFT_NOISE || left == LEFT_MORE)
      fprintf(out, "%9.3g\n", p->floor);
    else
      fprintf(out, " %s\n", left_name[left]);
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

// Indented; broken after a word.
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

// A name by itself, or its family and what that does.
static void print_missing(const report_t *r, FILE *out) {
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    char family[REPORT_TEXT];
    report_family(f, " or ", family);
    fprintf(out, "%s %s", i ? "," : "", family);
    if (f->named->n_rival) fprintf(out, " (%s)", f->says);
  }
  fprintf(out, "%s.\n", r->study->diagnosis.unknown ? ", and something that has no name" : "");
}

// What these flights would have shown, and what they would not have.
static void print_none(const report_t *r, FILE *out) {
  fprintf(out, "Nothing is missing in %s that these flights could show.\n", study_vehicle(r->study));
  bool any = false;
  for (int i = 0; i < r->n_untested; i++) {
    const untested_t *const u = &r->untested[i];
    if (u->obstacle || !u->testable) continue;
    fprintf(out, "%s%s %s %.2g%s%s", any ? ", " : "  They would have shown, from this size on: ", u->fx->name,
            u->param->name, u->seen_from, u->param->unit[0] ? " " : "", u->param->unit);
    any = true;
  }
  if (any) fputs(".\n", out);
}

static void print_verdict(const report_t *r, FILE *out) {
  const char *const vehicle = study_vehicle(r->study);
  if (r->n_finding) {
    fprintf(out, "Missing in %s:", vehicle);
    print_missing(r, out);
  } else if (r->study->diagnosis.unknown)
    fprintf(out, "Something is missing in %s that cannot be named.\n", vehicle);
  else if (!report_can_tell(r))
    fprintf(out, "These flights cannot tell what is missing in %s.\n", vehicle);
  else if (report_adequacy_of_all(r) == LEFT_MORE)
    fprintf(out,
            "Nothing can be named that is missing in %s, and more is left than noise and feedback leave (see "
            "the notes).\n",
            vehicle);
  else
    print_none(r, out);
}

void report_words(const report_t *r, FILE *out) {
  const cell_t *const c = &r->study->diagnosis.left.cell;
  for (int i = 0; i < r->n_fitness; i++) print_wrapped(r->fitness[i], out);
  if (r->n_fitness) fputc('\n', out);
  print_verdict(r, out);
  for (int i = 0; i < r->n_finding; i++) print_effect(&r->finding[i], out);
  if (r->n_finding) fprintf(out, "\nleft: %.3g %% of the gap\n", 100.0 * report_left(r));
  char where[REPORT_PLACE];
  if (r->study->diagnosis.unknown) {
    const cell_t *const also = &r->study->diagnosis.left.also;
    fprintf(out, "\nunknown: %+.3g +- %.1g %s in %s%s, at %s", c->size, fabs(c->size) / c->statistic,
            gap_unit[c->channel], gap_channel[c->channel], c->world ? " (the world's)" : "",
            report_place(c, where));
    if (also->statistic > 0.0) fprintf(out, "; it could be at %s as well", report_place(also, where));
    fputc('\n', out);
  }
  print_gap(r, out);
  print_untested(r, out);
  for (int i = 0; i < r->n_warning && i < WARNINGS; i++)
    fprintf(out, "%snote: %s\n", i ? "" : "\n", r->warning[i]);
  if (r->n_warning > WARNINGS)
    fprintf(out, "note: and %d more in the report of --out\n", r->n_warning - WARNINGS);
  fputs("\nWhat to do now\n", out);
  for (int i = 0; i < REPORT_ADVICE; i++) fprintf(out, "  %s\n", r->advice[i]);
}
