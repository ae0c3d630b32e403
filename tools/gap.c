// gap.c - thin slice
#include "gap/diagnose.h"
#include "io/model_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>
int main(int argc, char **argv) {
  why_t why; model_t m; columns_t col;
  if (model_read(argv[1], &m, &why) != ST_OK || columns_read(argv[2], &col, &why) != ST_OK) { puts(why.text); return 2; }
  gap_flight_t *f = calloc((size_t)argc, sizeof *f);
  gap_flights_t fit = {f, 0}, held = {f, 0};
  bool h = false;
  int n = 0;
  for (int i = 3; i < argc; i++) {
    if (!strcmp(argv[i], "--")) { h = true; held.flight = f + n; continue; }
    if (gap_read(&f[n++], argv[i], &col, &m, &why) != ST_OK) { puts(why.text); return 2; }
    if (h) held.n++; else fit.n++;
  }
  diagnosis_t d;
  const diagnose_job_t job = {&fit, &held, &m, 1};
  if (diagnose(&job, &d, &why) != ST_OK) { puts(why.text); return 2; }
  const manner_t *w = &d.manner;
  printf("manner rate %g %g tilt %g climb %g height %g acc %g gyro %g vel %g pos %g ang %g F %g %g %g tau %g W %g %g %g tau %g\n", w->rate_gain[0], w->rate_gain[1], w->tilt_gain, w->climb_gain, w->height_gain, w->acc_mps2, w->gyro_radps, w->vel_mps, w->pos_m, w->angle_rad, w->force_mps2[0], w->force_mps2[1], w->force_mps2[2], w->force_tau_s, w->turn_radps2[0], w->turn_radps2[1], w->turn_radps2[2], w->turn_tau_s);
  printf("nominal %d %s\n", d.nominal_flew, d.nominal_flew ? "" : why.text);
  printf("rows %d range %d blocks %d candidates %d left %g -> %g\n", d.fit.smooth.n, d.fit.range.n, d.fit.n_block, d.candidates.n, d.found.left_before, d.found.left);
  for (int i = 0; i < d.found.n; i++) {
    const candidate_t *k = &d.candidates.candidate[d.found.named[i].candidate];
    printf("%s p %g share %g:", k->use.fx->name, d.found.named[i].p, d.found.named[i].share);
    if (k->use.fx->n_shape) printf(" shape %g", k->use.p[k->use.fx->shape_param]);
    for (int q = 0; q < k->n; q++) printf(" %g+-%g", d.found.named[i].value[q], d.found.named[i].stderr_[q]);
    printf(" rivals:"); for (int q = 0; q < d.found.named[i].n_rival; q++) printf(" %s", d.found.named[i].rival[q]->name);
    puts("");
  }
  printf("unknown %d: %s over %s %g..%g size %g stat %g bound %g\n", d.unknown, gap_channel[d.cell.channel], d.cell.coordinate, d.cell.from, d.cell.to, d.cell.size, d.cell.statistic, d.cell_bound);
  for (int c = 0; c < CHANNELS; c++) if (d.held_out.channel[c].used) printf("%s rms %g -> %g sd %g -> %g floor %g\n", gap_channel[c], d.held_out.channel[c].before, d.held_out.channel[c].after, d.held_out.channel[c].before_sd, d.held_out.channel[c].after_sd, d.held_out.channel[c].floor);
  diagnosis_free(&d);
  return 0;
}
