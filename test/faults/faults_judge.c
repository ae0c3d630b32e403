// faults_judge.c - judges a flight, and prints what it was like.
#include "faults/faults.h"

#include <stdio.h>
#include <string.h>

// Index of the first error that is judged: 2 s, or what the row says, after the end of the fault, or after
// the onset of a fault that lasts.
static int first(const case_t *c) {
  const double over_s = c->length_s < FAULTS_END_S ? c->length_s : 0.0;
  return (int)(100.0 * (over_s + (c->row->recover_s > 0.0 ? c->row->recover_s : 2.0)) + 0.5);
}

double faults_mean_m(const case_t *c, const flown_fault_t *f) {
  const int from = first(c);
  double sum_m = 0.0;
  for (int i = from; i < f->n; i++) sum_m += (double)f->error_m[i];
  return sum_m / fmax(1.0, f->n - from);
}

double faults_rms_m(const case_t *c, const flown_fault_t *f) {
  const int from = first(c);
  double sum_m2 = 0.0;
  for (int i = from; i < f->n; i++) sum_m2 += (double)(f->error_m[i] * f->error_m[i]);
  return sqrt(sum_m2 / fmax(1.0, f->n - from));
}

double faults_added_N(const flown_fault_t *f, const flown_fault_t *usual) {
  double most_N = 0.0;
  for (int ms = 0; ms < FAULTS_FIRST_MS; ms++)
    most_N = fmax(most_N, fabs((double)f->first_N[ms] - (double)usual->first_N[ms]));
  return most_N;
}

const char *faults_judge(const case_t *c, const flown_fault_t *usual) {
  const row_t *row = c->row;
  const flown_fault_t *s = &c->seen;
  if (s->bad) return "finite, in the box";
  if (s->touched_s >= 0.0) return "contact";
  if (row->cls != 'W' && s->gap_min_m < 0.01) return "gap";
  if (row->cls != 'W' && s->up_max_mps > 0.1) return "climb";
  if (row->reasons && !(s->seen_s >= 0.0 && s->seen_s <= row->within_s)) return "reason in time";
  const bool flies_on = row->cls == 'A', ends = c->length_s < FAULTS_END_S;
  if (flies_on && ends && faults_rms_m(c, s) > 1.5 * faults_rms_m(c, usual)) return "recovery";
  if (flies_on && (c->pilot.flight->guard.action != GUARD_FLY || fabs(faults_mean_m(c, s)) > 0.02))
    return "flies on";
  if (strchr("BCW", row->cls) && s->end_gap_m < 0.15) return "down";
  if (row->cls == 'C' && s->over_N > 0.01 * s->hover_N) return "thrust";
  if (row->same_bits && s->bits != usual->bits) return "same bits";
  return row->also ? row->also(c, usual) : NULL;
}

void faults_tell(const case_t *c, uint64_t seed, const char *failed, const flown_fault_t *usual) {
  const flown_fault_t *s = &c->seen;
  printf("   %s, seed %d: %s; size %.3g, pick %u\n", c->row->name, (int)seed, failed, c->size, c->pick);
  printf("      gap mm: nearest %.1f, at the end %.1f, error %.1f, rms %.1f (usually %.1f), rise %.1f; climb "
         "%.2f m/s\n",
         1e3 * s->gap_min_m, 1e3 * s->end_gap_m, 1e3 * faults_mean_m(c, s), 1e3 * faults_rms_m(c, s),
         1e3 * faults_rms_m(c, usual), 1e3 * s->rise_max_m, s->up_max_mps);
  printf("      latched %x after %.3f s, action %d; tilt %.1f, later %.1f deg; yaw %.1f deg\n",
         c->pilot.flight->guard.latched, s->seen_s, (int)c->pilot.flight->guard.action, s->tilt_max_deg,
         s->tilt_late_deg, s->yaw_late_deg);
  printf("      step %.3f N (usually %.3f), at once %.3f N, pulse %.3f N, distance wrong by %.1f mm, weights "
         "by %.3f\n",
         s->step_max_N, usual->step_max_N, faults_added_N(s, usual), s->pulse_N, 1e3 * s->zc_error_m,
         s->weight_change);
}
