// muted.c - channels in which these logs cannot be compared with any model.
#include "gap/muted.h"

#include "gap/4_candidates.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MORE_TAU_S[] = {0.0, 0.03, 0.06, 0.1};

typedef struct {
  double slope, correlation;
} likeness_t;

// Of the increments of what was measured and what was predicted.
static likeness_t compare(const rows_t *r, const double *measured, const double *residual) {
  double yy = 0.0, pp = 0.0, yp = 0.0;
  for (int i = 1; i < r->n; i++) {
    if (!r->follows[i]) continue;
    const double y = measured[i] - measured[i - 1], p = y - (residual[i] - residual[i - 1]);
    yy += y * y;
    pp += p * p;
    yp += y * p;
  }
  return pp > 0.0 && yy > 0.0 ? (likeness_t){yp / pp, yp / sqrt(yy * pp)} : (likeness_t){1.0, 1.0};
}

static status_t find(set_t *s, const model_t *m, double *room, why_t *why) {
  likeness_t best[CHANNELS];
  double *r[CHANNELS], *measured[CHANNELS] = {NULL};
  const size_t n = (size_t)(s->smooth.n > s->range.n ? s->smooth.n : s->range.n) + 1;
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    best[ch] = (likeness_t){1.0, -2.0};
    r[ch] = room + ch * n;
  }
  for (size_t ch = CH_WX; ch <= CH_WZ; ch++) measured[ch] = room + (CHANNELS + ch - CH_WX) * n;
  TRY(residual_measured(s, measured, why));
  for (unsigned i = 0; i < sizeof MORE_TAU_S / sizeof *MORE_TAU_S; i++) {
    model_t slower = *m;
    slower.motor_tau_s += MORE_TAU_S[i];
    TRY(residual_of(s, &slower, r, why));
    for (int ch = CH_WX; ch <= CH_WZ; ch++) {
      const likeness_t now = compare(&s->smooth, measured[ch], r[ch]);
      if (now.correlation > best[ch].correlation) best[ch] = now;
    }
  }
  for (int ch = CH_WX; ch <= CH_WZ; ch++)
    if (best[ch].correlation > -2.0 && best[ch].correlation < MUTED_AGAINST)
      return error_set(
          why,
          "%s: %s goes against what the motor commands say (correlation %.2f); allowed: rates and "
          "commands of one sign, motors in the vehicle file's order",
          s->grid[0].flight->name, gap_channel[ch], best[ch].correlation);
  for (int ch = CH_WX; ch <= CH_WZ; ch++) s->muted[ch] = best[ch].slope < MUTED_SLOPE;
  return ST_OK;
}

status_t muted_find(set_t *s, const model_t *m, why_t *why) {
  memset(s->muted, 0, sizeof s->muted);
  if (!residual_has(s, CH_WX)) return ST_OK;
  const size_t n = (size_t)(s->smooth.n > s->range.n ? s->smooth.n : s->range.n) + 1;
  double *const room = calloc((CHANNELS + 3) * n, sizeof(double));
  const status_t status = room ? find(s, m, room, why) : error_failed(why, "out of memory");
  free(room);
  return status;
}
