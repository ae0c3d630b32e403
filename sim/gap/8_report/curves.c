// curves.c - curves.csv: what each named effect adds over its coordinate on held-out flights.
#include "gap/8_report/report.h"

#include "gap/5_infer/unknown.h"

void report_curves(const report_t *r, FILE *out) {
  fputs(
      "effect,channel,channel_unit,coordinate,coordinate_unit,at,rows,adds,low,high,measured,before,after\n",
      out);
  for (int i = 0; i < r->n_finding; i++) {
    const finding_t *const f = &r->finding[i];
    const profile_t *const p = &f->profile;
    for (int k = 0; k < p->n; k++)
      fprintf(out, "%s,%s,%s,%s,%s,%.6g,%.0f,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", f->fx->name,
              gap_channel[p->channel], gap_unit[p->channel], coordinate_name(p->coordinate),
              coordinate_unit(p->coordinate), p->x[k], p->rows[k], p->effect[k], p->low[k], p->high[k],
              p->effect[k] + p->after[k], p->before[k], p->after[k]);
  }
}
