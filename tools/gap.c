// gap.c - where simulation and flight disagree: gap VEHICLE.toml COLUMNS.toml LOG... -- HELD_OUT_LOG...
#include "gap/diagnose.h"
#include "io/model_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_named(const diagnosis_t *d) {
  for (int i = 0; i < d->found.n; i++) {
    const candidate_t *k = &d->candidates.candidate[d->found.named[i].candidate];
    printf("%s: p %.2g, share %.3g, size", k->use.fx->name, d->found.named[i].p, d->found.named[i].share);
    for (int q = 0; q < k->n; q++)
      printf(" %.4g +- %.2g", d->found.named[i].value[q], d->found.named[i].stderr_[q]);
    puts("");
  }
  if (d->found.n == 0 && !d->unknown) puts("none");
  if (d->unknown)
    printf("unknown: %s over %s %.3g..%.3g, size %.3g\n", gap_channel[d->cell.channel], d->cell.coordinate,
           d->cell.from, d->cell.to, d->cell.size);
}

static void print_held_out(const diagnosis_t *d) {
  for (int c = 0; c < CHANNELS; c++) {
    if (!d->held_out.channel[c].used) continue;
    printf("%s: held-out rms %.3g -> %.3g, floor %.3g\n", gap_channel[c], d->held_out.channel[c].before,
           d->held_out.channel[c].after, d->held_out.channel[c].floor);
  }
}

static status_t run(int argc, char **argv, gap_flight_t *f, why_t *why) {
  model_t m;
  columns_t col;
  TRY(model_read(argv[1], &m, why));
  TRY(columns_read(argv[2], &col, why));
  gap_flights_t fit = {f, 0}, held = {f, 0};
  bool after = false;
  for (int i = 3, n = 0; i < argc; i++) {
    if (strcmp(argv[i], "--") == 0) {
      after = true;
      held.flight = f + n;
      continue;
    }
    TRY(gap_read(&f[n++], argv[i], &col, &m, why));
    *(after ? &held.n : &fit.n) += 1;
  }
  diagnosis_t d;
  const diagnose_job_t job = {&fit, &held, &m, 1};
  TRY(diagnose(&job, &d, why));
  print_named(&d);
  print_held_out(&d);
  diagnosis_free(&d);
  return ST_OK;
}

int main(int argc, char **argv) {
  if (argc < 4) {
    fputs("gap: usage: gap VEHICLE.toml COLUMNS.toml LOG... [-- HELD_OUT_LOG...]\n", stderr);
    return 2;
  }
  why_t why = {""};
  gap_flight_t *f = calloc((size_t)argc, sizeof *f);
  if (!f) return 1;
  const status_t status = run(argc, argv, f, &why);
  for (int i = 0; i < argc; i++) gap_flight_free(&f[i]);
  free(f);
  return status == ST_OK ? 0 : error_exit("gap", status, &why);
}
