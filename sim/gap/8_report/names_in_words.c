// names_in_words.c - the page's sections on each named effect, and on the residual that no name explains.
#include "gap/8_report/page.h"

#include <math.h>

static void numbers(const finding_t *f, FILE *out) {
  fputs("<table><tr><th>parameter<th class=n>value<th class=n>standard error<th>unit</tr>\n", out);
  for (int k = 0; k < f->n_number; k++) {
    const number_t *const n = &f->number[k];
    if (isnan(n->value)) {
      fprintf(out, "<tr><td>%s<td colspan=3>not shown by what can be compared of these flights</tr>\n",
              n->param->name);
      continue;
    }
    fprintf(out, "<tr><td>%s<td class=n>%.4g<td class=n>", n->param->name, n->value);
    if (n->no_stderr)
      fputs(n->no_stderr, out);
    else
      fprintf(out, "%.2g", n->stderr_);
    fprintf(out, "<td>%s</tr>\n", report_unit(n));
  }
  fputs("</table>\n", out);
}

static void share_row(const char *name, double share, double most, const char *style, FILE *out) {
  fprintf(out, "<tr><td>%s<td class=n>%.3g %%<td style=\"width:60%%\">", name, 100.0 * share);
  page_bar(out, style, fmin(fmax(share / most, 0.0), 1.0));
  fputs("</tr>\n", out);
}

static void rivals(const finding_t *f, FILE *out) {
  const named_t *const k = f->named;
  if (!k->n_rival) {
    fputs("<p>No other name does as well within two standard errors.</p>\n", out);
    return;
  }
  double most = fmax(k->share, 1e-9);
  for (int i = 0; i < k->n_rival; i++) most = fmax(most, k->rival_share[i]);
  fputs("<figure><figcaption>Rivals: what each name would explain of the gap in this "
        "place</figcaption><table>\n",
        out);
  share_row(f->name, k->share, most, "after", out);
  for (int i = 0; i < k->n_rival; i++) share_row(k->rival[i]->name, k->rival_share[i], most, "floor", out);
  fputs("</table></figure>\n", out);
  for (int i = 0; i < k->n_rival; i++) {
    char fly[REPORT_TEXT];
    report_apart(f->fx, k->rival[i], fly);
    html_text(out, "<p>To tell it from ", k->rival[i]->name, ", fly: ");
    html_text(out, "", fly, ".</p>\n");
  }
}

void page_finding(const finding_t *f, FILE *out) {
  const int coordinate = f->profile.coordinate;
  char p[P_TEXT];
  html_text(out, "<section><h2>", f->family, "</h2>");
  html_text(out, "<p class=quiet>", f->fx->brief, ": ");
  html_text(out, "<code>", f->fx->law, "</code>");
  if (f->use->form) html_text(out, ", which is <code>", f->use->form->brief, "</code>");
  fputs("</p>\n", out);
  html_text(out, "<p><b>", standing_name[f->standing], "</b>: ");
  html_text(out, "", f->says, ". ");
  fprintf(out, "It explains %.3g %% of the gap", 100.0 * f->named->share);
  if (f->standing != STANDS_AMBIGUOUS) html_text(out, " (", p_words(f->named->p, p), ")");
  fputs(". ", out);
  if (isfinite(f->named->probability))
    fprintf(out, "That it%s is there has a probability of %s%.3g, if the library has what is missing. ",
            f->named->n_rival ? ", or one that would do as well," : "",
            f->named->probability > REPORT_SURE ? "more than " : "", report_probability(f));
  fprintf(out, "It shows most in %s, at %s %.3g to %.3g %s.", gap_channel[f->profile.channel],
          coordinate_name(coordinate), f->where.from, f->where.to, coordinate_unit(coordinate));
  if (f->before > 0.0)
    fprintf(
        out,
        " On the held-out flights, at %.3g to %.3g %s, the residual's rms is %.3g before and %.3g %s after.",
        f->matters.from, f->matters.to, coordinate_unit(coordinate), f->before, f->after,
        gap_unit[f->profile.channel]);
  fputs("</p>\n", out);
  numbers(f, out);
  if (f->instrument[0]) html_text(out, "<p>", f->instrument, ".</p>\n");
  fputs("<figure>", out);
  picture_curve(f, out);
  fputs("<figcaption>What the effect adds, on flights that were not used to find "
        "it</figcaption></figure>\n<figure>",
        out);
  picture_place(&f->profile, 0.0, 0.0, NULL, out);
  fputs("<figcaption>Where the gap was: measured less predicted, before and after</figcaption></figure>\n",
        out);
  rivals(f, out);
  fputs("</section>\n", out);
}

void page_unknown(const report_t *r, FILE *out) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const cell_t *const c = &d->left.cell;
  if (!(c->statistic > 0.0) || !d->nominal_flew || (!d->unknown && r->n_finding)) return;
  fputs(d->unknown ? "<section><h2>Something without a name</h2>\n<p>"
                   : "<section><h2>The largest remainder</h2>\n<p>",
        out);
  char where[REPORT_PLACE], cell[REPORT_CELL];
  fprintf(out, "%s", report_cell(r, c, cell));
  if (d->left.also.statistic > 0.0) fprintf(out, ", or %s as well", report_place(r, &d->left.also, where));
  fprintf(out, "; its statistic is %.3g, where %.3g is the bound%s.</p>", c->statistic, d->left.cell_bound,
          d->unknown ? "" : ": chance, or a right form with other numbers");
  char acts[REPORT_FOR_A_TIME];
  if (d->for_a_time.as.n)
    fprintf(out, "\n<p>It is not named, for effects are looked for as acting all the time; but %s.</p>",
            report_for_a_time(&d->for_a_time, acts));
  char differ[REPORT_DIFFER];
  for (int i = 0; i < GROUPS; i++)
    if (d->differ[i].n) html_text(out, "\n<p>", report_differ(r, &d->differ[i], differ), ".</p>");
  if (c->along != NOWHERE && c->along != BY_FLIGHT) {
    fputs("\n<figure>", out);
    picture_place(&r->left, c->from, c->to, "the largest cell", out);
    fputs("<figcaption>The held-out flights over that coordinate</figcaption></figure>", out);
  }
  fputs("</section>\n", out);
}
