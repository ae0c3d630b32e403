// record.c - a flight in memory, and as a log.
#include "record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define G_MPS2 9.81

status_t record_add(record_t *r, const sample_t *sample) {
  if (r->n == r->room) {
    const int room = r->room ? 2 * r->room : 4096;
    sample_t *more = realloc(r->sample, (size_t)room * sizeof *more);
    if (!more) return ST_FAILED;
    r->sample = more;
    r->room = room;
  }
  r->sample[r->n++] = *sample;
  return ST_OK;
}

void record_free(record_t *r) {
  free(r->sample);
  *r = (record_t){0};
}

static void write_names(FILE *file) {
  fputs("timestamp,ctrltarget.z,stateEstimate.z,stateEstimate.vz,stateEstimate.qw,stateEstimate.qx,"
        "stateEstimate.qy,stateEstimate.qz,acc.x,acc.y,acc.z,range.up,indi.thrust,indi.applied,ceil.zc,ceil."
        "ratio,"
        "ceil.slope,rls.y,",
        file);
  for (int i = 1; i <= CURVE_WEIGHTS; i++) fprintf(file, "rls.w%d,", i);
  for (int i = 1; i <= CURVE_WEIGHTS; i++) fprintf(file, "rls.p%d,", i);
  fputs("sim.z,sim.vz,sim.gap,sim.thrust,sim.ratio,sim.contacts\n", file);
}

static void write_sample(FILE *file, const sample_t *s) {
  fprintf(file, "%.3f,%.4f,%.6f,%.6f,1,0,0,0,0,0,%.6f,%.0f,%.6f,%.6f,%.6f,%.6f,%.5f,%.5f,", 1e3 * s->t_s,
          s->setpoint_m, s->sense.z_m, s->sense.climb_mps, s->sense.acc_mps2 / G_MPS2 + 1.0,
          1e3 * s->sense.range_m, s->command_N, s->sense.applied_N, s->thoughts.zc_m, s->thoughts.ratio,
          s->thoughts.slope_per_m, s->thoughts.y);
  for (int i = 0; i < CURVE_WEIGHTS; i++) fprintf(file, "%.7g,", s->thoughts.weights[i]);
  for (int i = 0; i < CURVE_WEIGHTS; i++) fprintf(file, "%.7g,", s->thoughts.variance[i]);
  fprintf(file, "%.6f,%.6f,%.6f,%.6f,%.6f,%d\n", s->z_m, s->climb_mps, s->gap_m, s->thrust_N, s->ratio,
          s->contacts);
}

void record_write(const record_t *r, FILE *file) {
  write_names(file);
  for (int i = 0; i < r->n; i++) write_sample(file, &r->sample[i]);
}
