// page.c - report.html: one page that needs nothing else, no script, no font, no address.
#include "gap/8_report/report.h"

#include "gap/8_report/page.h"
#include "gap/8_report/svg.h"
#include <math.h>
#include <string.h>

static const char HEAD[] =
    "<!doctype html>\n<html lang=en><head><meta charset=utf-8>"
    "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n<title>gap: what is "
    "missing</title>\n<style>\n"
    "body{font:16px/1.5 system-ui,sans-serif;color:#1e293b;background:#f8fafc;margin:0}\n"
    "main{max-width:900px;margin:0 auto;padding:32px 20px 64px}\n"
    "h1{font-size:30px;line-height:1.2;margin:0 0 6px}h2{font-size:20px;margin:0 0 4px}p{margin:6px 0}\n"
    "section{background:#fff;border:1px solid #e2e8f0;border-radius:10px;padding:20px 24px;margin:18px 0}\n"
    ".quiet,figcaption{color:#64748b;font-size:14px}figure{margin:16px 0 4px}svg{display:block;width:100%}\n"
    "table{border-collapse:collapse;width:100%;font-size:15px;margin:8px 0}"
    "th{text-align:left;font-weight:600;color:#64748b;font-size:13px}"
    "td,th{padding:5px 10px 5px 0;border-bottom:1px solid #eef2f7;vertical-align:top}"
    "td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}\n"
    ".bar{display:block;height:9px;border-radius:2px;margin:2px 0}"
    ".bar.before{background:#ea7a3a}.bar.after{background:#0f8a7e}.bar.floor{background:#cbd5e1}\n"
    "svg text{font:11px system-ui,sans-serif;fill:#475569}svg .axis{fill:#1e293b}"
    ".grid{stroke:#eef2f7}.zero{stroke:#94a3b8}\n"
    "svg path{fill:none;stroke-width:1.8;stroke-linejoin:round}svg path.thin{stroke-width:1}"
    "path.before{stroke:#ea7a3a}path.after{stroke:#0f8a7e}path.track{stroke:#1e293b;stroke-width:2.6}\n"
    ".before-dot{fill:#ea7a3a}.after-dot{fill:#0f8a7e}.seen{fill:#1e293b}"
    "path.band,rect.band{fill:#0f8a7e;fill-opacity:.18;stroke:none}rect.mark{fill:#fde68a;fill-opacity:.45}\n"
    "code{font-size:14px;overflow-wrap:anywhere}li,td{overflow-wrap:break-word}td.n{white-space:nowrap}td.n."
    "quiet{white-space:normal}ul{padding-left:20px;margin:6px 0}\n"
    "@media(max-width:600px){main{padding:16px 10px 40px}section{padding:14px 12px;margin:12px "
    "0}h1{font-size:23px}"
    "figure{margin:12px 0 "
    "4px;overflow-x:auto}svg text{font-size:15px}td,th{padding-right:7px}table{font-size:14px}"
    ".wide td:last-child,.wide th:last-child,.wide th:nth-child(2),.wide td:nth-child(2),.wide "
    ".bars{display:none}}\n"
    "@media print{body{background:#fff}section{break-inside:avoid}}\n"
    "</style></head><body><main>\n";
static const char FOOT[] = "</main></body></html>\n";

void page_text(FILE *out, const char *before, const char *plain, const char *after) {
  fputs(before, out);
  html_text(out, plain);
  fputs(after, out);
}

// --- the verdict ------------------------------------------------------------------------------------------

static void headline(const report_t *r, FILE *out) {
  const study_t *const s = r->study;
  fputs("<h1>", out);
  for (int i = 0; i < r->n_finding; i++) {
    char family[REPORT_TEXT];
    report_family(&r->finding[i], " or ", family);
    page_text(out, i ? "; " : "Missing: ", family, "");
  }
  if (r->n_finding && s->diagnosis.unknown) fputs(", and something without a name", out);
  if (!r->n_finding) fputs(report_headline(r), out);
  page_text(out, "</h1><p class=quiet>", study_vehicle(s), " against ");
  fprintf(out, "%d flight%s; held out: ", s->fit.n + s->held.n, s->fit.n + s->held.n > 1 ? "s" : "");
  if (s->by_time) fprintf(out, "the last third of %s", s->fit.n > 1 ? "each flight" : "the flight");
  for (int i = 0; i < s->held.n; i++) page_text(out, i ? ", " : "", s->held.flight[i].name, "");
  fputs("</p>\n", out);
}

static void list(const char *title, const char *line, size_t bytes, int n, FILE *out) {
  page_text(out, "<section><h2>", title, "</h2><ul>\n");
  for (int i = 0; i < n; i++) page_text(out, "<li>", line + (size_t)i * bytes, "</li>\n");
  fputs("</ul></section>\n", out);
}

// The names at a glance, and what they leave.
static void overview(const report_t *r, FILE *out) {
  double most = fmax(report_left(r), 1e-9);
  for (int i = 0; i < r->n_finding; i++) most = fmax(most, r->finding[i].named->share);
  if (r->n_finding == 0) return;
  fputs("<section><h2>What is missing, and what is left</h2>\n<table><tr><th>name<th class=n>of the "
        "gap<th><th>shows in</tr>\n",
        out);
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    page_text(out, "<tr><td>", f->fx->name, "");
    fprintf(out,
            "<td class=n>%.3g %%<td style=\"width:45%%\"><span class=\"bar after\" style=\"width:%.1f%%\">"
            "</span><td>%s</tr>\n",
            100.0 * f->named->share, 100.0 * fmax(f->named->share, 0.0) / most,
            gap_channel[f->profile.channel]);
  }
  fprintf(out,
          "<tr><td>left<td class=n>%.3g %%<td style=\"width:45%%\"><span class=\"bar before\" "
          "style=\"width:%.1f%%\"></span><td></tr>\n</table></section>\n",
          100.0 * report_left(r), 100.0 * report_left(r) / most);
}

// --- held-out flights -------------------------------------------------------------------------------------

static void bars(const gap_part_t *p, bool floor, FILE *out) {
  const double most = fmax(fmax(p->before, p->after), fmax(p->floor, 1e-12));
  fprintf(out,
          "<td style=\"width:45%%\"><span class=\"bar before\" style=\"width:%.1f%%\"></span>"
          "<span class=\"bar after\" style=\"width:%.1f%%\"></span>",
          100.0 * p->before / most, 100.0 * p->after / most);
  if (floor)
    fprintf(out, "<span class=\"bar floor\" style=\"width:%.1f%%\"></span>", 100.0 * p->floor / most);
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
    const bool floor = left == LEFT_NOISE || left == LEFT_MORE;
    if (floor)
      fprintf(out, "<td class=n>%.3g", p->floor);
    else
      page_text(out, "<td class=\"n quiet\">", left_name[left], "");
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
      report_length(a->before_m, before), report_length(a->after_m, after),
      report_length(a->before_height_m, low), report_length(a->after_height_m, high));
  picture_track(a, out);
  fputs("<figcaption>The first held-out flight</figcaption></figure></section>\n", out);
}

// --- the rest ---------------------------------------------------------------------------------------------

static void untested(const report_t *r, FILE *out) {
  fputs(
      "<section><h2>What these flights cannot tell</h2>\n<table><tr><th>effect<th>why<th>what to fly</tr>\n",
      out);
  for (int pass = 0; pass < 2; pass++) {
    if (pass)
      fputs("</table><h2>What they would have shown</h2><table><tr><th>effect<th>smallest size<th></tr>\n",
            out);
    for (int i = 0; i < r->n_untested; i++) {
      const untested_t *const u = &r->untested[i];
      char why[REPORT_TEXT];
      if ((!u->obstacle && u->testable) != (pass == 1)) continue;
      report_why(u, why);
      page_text(out, "<tr><td>", u->fx->name, "");
      if (pass) snprintf(why, sizeof why, "%s %.2g %s", u->param->name, u->seen_from, u->param->unit);
      page_text(out, "<td>", why, "");
      page_text(out, "<td>", pass ? "" : u->fx->fly, "</tr>\n");
    }
  }
  fputs("</table></section>\n", out);
}

static void warnings(const report_t *r, FILE *out) {
  if (!r->n_warning) return;
  fputs("<section><h2>Notes</h2><ul>\n", out);
  for (int i = 0; i < r->n_warning; i++) page_text(out, "<li>", r->warning[i], "</li>\n");
  fputs("</ul></section>\n", out);
}

static void made(const study_order_t *o, const char *rows, FILE *out) {
  if (!o->made) return;
  page_text(out, "<footer class=quiet><p>", o->made->by, "");
  page_text(out, ", ", o->made->date, "");
  fprintf(out, ", seed %lu%s</p>\n", o->seed, rows);
  page_text(out, "<p><code>", o->made->command ? o->made->command : "", "</code></p></footer>\n");
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
    page_text(out, "<tr><td>", s->flight[i].name, "");
    fprintf(out, "<td class=n>%ld<td class=n>%.4g<td>%s</tr>\n", s->flight[i].rows, s->flight[i].rate_Hz,
            i < s->fit.n ? "" : "held out");
  }
  fputs("</table>\n", out);
}

void report_page(const report_t *r, FILE *out) {
  fputs(HEAD, out);
  headline(r, out);
  list("What to do now", &r->advice[0][0], sizeof r->advice[0], REPORT_ADVICE, out);
  list("Are these flights fit for the question?", &r->fitness[0][0], sizeof r->fitness[0], r->n_fitness, out);
  overview(r, out);
  for (int i = 0; i < r->n_finding; i++) page_finding(&r->finding[i], out);
  page_unknown(r, out);
  if (report_has_residual(r)) held_out(r, out);
  again(&r->study->resimulation, out);
  untested(r, out);
  warnings(r, out);
  foot(r->study, out);
  fputs(FOOT, out);
}

void report_page_refused(const char *line, const study_order_t *order, FILE *out) {
  fputs(HEAD, out);
  page_text(out, "<h1>Refused</h1><section><p>", line, "</p></section>\n");
  made(order, "", out);
  fputs(FOOT, out);
}
