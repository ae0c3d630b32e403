// page.c - report.html: one self-contained page without scripts, fonts or addresses. Its style: page.css.
#include "gap/8_report/page.h"

#include <math.h>

extern const char style_text[];

static const char FOOT[] = "</main></body></html>\n";

static void head(FILE *out) {
  fprintf(out,
          "<!doctype html>\n<html lang=en><head><meta charset=utf-8>"
          "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
          "<title>gap: what is missing</title>\n<style>\n%s</style></head><body><main>\n",
          style_text);
}

void page_bar(FILE *out, const char *style, double share) {
  fprintf(out, "<span class=\"bar %s\" style=\"width:%.1f%%\"></span>", style, 100.0 * share);
}

// --- the verdict ------------------------------------------------------------------------------------------

static void headline(const report_t *r, FILE *out) {
  const study_t *const s = r->study;
  fputs("<h1>", out);
  for (int i = 0; i < r->n_finding; i++) html_text(out, i ? "; " : "Missing: ", r->finding[i].family, "");
  if (r->n_finding && s->diagnosis.unknown) fputs("; and something without a name", out);
  if (!r->n_finding) report_headline(r, NULL, out);
  html_text(out, "</h1><p class=quiet>", study_vehicle(s), " against ");
  fprintf(out, "%d flight%s; held out: ", s->fit.n + s->held.n, s->fit.n + s->held.n > 1 ? "s" : "");
  if (s->by_time)
    fprintf(out, "stretches of 2 s of %s, by turns", s->fit.n > 1 ? "each flight" : "the flight");
  for (int i = 0; i < s->held.n; i++) html_text(out, i ? ", " : "", s->held.flight[i].name, "");
  fputs("</p>\n", out);
}

static void list(const char *title, const notes_t *notes, FILE *out) {
  html_text(out, "<section><h2>", title, "</h2><ul>\n");
  for (int i = 0; i < notes->n; i++) html_text(out, "<li>", notes->line[i], "</li>\n");
  fputs("</ul></section>\n", out);
}

static void share_row(const char *name, double share, double most, const char *style, const char *channel,
                      FILE *out) {
  fprintf(out, "<tr><td>%s<td class=n>%.3g %%<td style=\"width:45%%\">", name, 100.0 * share);
  page_bar(out, style, fmax(share, 0.0) / most);
  fprintf(out, "<td>%s</tr>\n", channel);
}

// Writes a table of the share of the gap that each name explains, and of the share that is left.
static void overview(const report_t *r, FILE *out) {
  double most = fmax(report_left(r), 1e-9);
  for (int i = 0; i < r->n_finding; i++) most = fmax(most, r->finding[i].named->share);
  if (r->n_finding == 0) return;
  fputs("<section><h2>What is missing, and what is left</h2>\n<table><tr><th>name<th class=n>of the "
        "gap<th><th>shows in</tr>\n",
        out);
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    share_row(f->name, f->named->share, most, "after", gap_channel[f->profile.channel], out);
  }
  share_row("left, with noise", report_left(r), most, "before", "", out);
  html_text(out, "</table><p class=quiet>In the formulas below: ", fx_law_symbols, ".</p></section>\n");
}

// --- held-out flights -------------------------------------------------------------------------------------

static void bars(const gap_part_t *p, bool floor, FILE *out) {
  const double most = fmax(fmax(p->before, p->after), fmax(p->floor, 1e-12));
  fputs("<td style=\"width:45%\">", out);
  page_bar(out, "before", p->before / most);
  page_bar(out, "after", p->after / most);
  if (floor) page_bar(out, "floor", p->floor / most);
}

static int widest(const report_t *r) {
  int best = r->n_finding ? r->finding[0].profile.channel : -1;
  for (int ch = 0; ch < CHANNELS && best < 0; ch++)
    if (r->study->diagnosis.held_out.channel[ch].used &&
        (ch == CH_FZ || !r->study->diagnosis.held_out.channel[CH_FZ].used))
      best = ch;
  return best;
}

static void held_out(const report_t *r, FILE *out) {
  const diagnosis_t *const d = &r->study->diagnosis;
  fputs("<section class=wide><h2>On flights that were not used</h2>\n"
        "<table><tr><th>residual<th>rms in<th class=n>before<th class=n>after<th class=n>noise "
        "floor<th></tr>\n",
        out);
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (!p->used) continue;
    fprintf(out, "<tr><td>%s<td>%s<td class=n>%.3g<td class=n>%.3g", gap_channel[ch], gap_unit[ch], p->before,
            p->after);
    const left_over_t left = report_adequacy(r, ch);
    const bool floor = (left == LEFT_NOISE || left == LEFT_MORE) && p->after >= p->floor;
    if (floor)
      fprintf(out, "<td class=n>%.3g", p->floor);
    else
      html_text(out, "<td class=\"n quiet\">", left_name[left], "");
    bars(p, floor, out);
    fputs("</tr>\n", out);
  }
  fputs("</table><p class=\"quiet bars\">Orange: before. Green: after. Grey: what noise and feedback alone "
        "leave.</p>\n",
        out);
  const int channel = widest(r);
  if (channel >= 0) {
    fputs("<figure>", out);
    picture_time(r, channel, out);
    fputs("<figcaption>Measured less predicted</figcaption></figure>\n", out);
  }
  fputs("</section>\n", out);
}

static void again(const resimulation_t *a, FILE *out) {
  char before[REPORT_LENGTH], after[REPORT_LENGTH], low[REPORT_LENGTH], high[REPORT_LENGTH];
  if (!a->flew) return;
  fprintf(
      out,
      "<section><h2>Flown again in closed loop</h2>\n<p>The logged commands, and a pilot who corrects what "
      "leaves the measured track: %s rms away with the old model, %s with the new one; in height %s and "
      "%s.</p>\n<figure>",
      report_length(a->before.rms_m, before), report_length(a->after.rms_m, after),
      report_length(a->before.height_m, low), report_length(a->after.height_m, high));
  picture_track(a, out);
  fputs("<figcaption>The first held-out flight</figcaption></figure></section>\n", out);
}

// --- the rest ---------------------------------------------------------------------------------------------

static void untested(const report_t *r, FILE *out) {
  fputs(
      "<section><h2>What these flights cannot tell</h2>\n<table><tr><th>effect<th>why<th>what to fly</tr>\n",
      out);
  for (int i = 0; i < r->n_untested; i++) {
    const untested_t *const u = &r->untested[i];
    html_text(out, "<tr><td>", u->fx->name, "");
    html_text(out, "<td>", u->why, "");
    html_text(out, "<td>", u->fx->fly, "</tr>\n");
  }
  fputs("</table><h2>What they would have shown</h2><table><tr><th>effect<th>smallest size<th></tr>\n", out);
  for (int i = 0; i < r->n_shown; i++) {
    const shown_t *const s = &r->shown[i];
    fprintf(out, "<tr><td>%s<td>%s %.2g %s%s<td></tr>\n", s->fx->name, s->param->name, s->from,
            s->param->unit, s->in_file ? " more or less" : "");
  }
  fputs("</table></section>\n", out);
}

static void made(const study_order_t *o, const char *rows, FILE *out) {
  if (!o->made) return;
  html_text(out, "<footer class=quiet><p>", o->made->by, "");
  html_text(out, ", ", o->made->date, "");
  fprintf(out, ", seed %lu%s</p>\n", o->seed, rows);
  html_text(out, "<p><code>", o->made->command ? o->made->command : "", "</code></p></footer>\n");
}

static void foot(const study_t *s, FILE *out) {
  char text[80];
  long rows = 0;
  for (int i = 0; i < s->fit.n + s->held.n; i++) rows += s->flight[i].rows;
  snprintf(text, sizeof text, ", %ld rows of %d flight%s", rows, s->fit.n + s->held.n,
           s->fit.n + s->held.n > 1 ? "s" : "");
  made(&s->order, text, out);
  fputs("<table class=quiet><tr><th>log<th class=n>rows<th class=n>Hz<th></tr>\n", out);
  for (int i = 0; i < s->fit.n + s->held.n; i++) {
    html_text(out, "<tr><td>", s->flight[i].name, "");
    fprintf(out, "<td class=n>%ld<td class=n>%.4g<td>%s</tr>\n", s->flight[i].rows, s->flight[i].rate_Hz,
            i < s->fit.n ? "" : "held out");
  }
  fputs("</table>\n", out);
}

void report_page(const report_t *r, FILE *out) {
  head(out);
  headline(r, out);
  list("What to do now", &r->to_do, out);
  list("Are these flights fit for the question?", &r->fitness, out);
  overview(r, out);
  for (int i = 0; i < r->n_finding; i++) page_finding(&r->finding[i], out);
  page_unknown(r, out);
  if (report_has_residual(r)) held_out(r, out);
  again(&r->study->resimulation, out);
  untested(r, out);
  if (r->warnings.n) list("Notes", &r->warnings, out);
  foot(r->study, out);
  fputs(FOOT, out);
}

void report_page_refused(const char *line, const study_order_t *order, FILE *out) {
  head(out);
  html_text(out, "<h1>Refused</h1><section><p>", line, "</p></section>\n");
  made(order, "", out);
  fputs(FOOT, out);
}
