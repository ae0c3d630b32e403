// curve.c - which thrust ratio the controller believes.
#include "flight/curve.h"

#include "flight/expneg.h"
#include "flight/v3.h"

static const rbf_point_t FREE_AIR = {.ratio = 1.0f, .slope_per_m = 0.0f};

static rbf_point_t theory_at(const curve_param_t *p, float zc_m) {
  const float excess = p->ca * expneg(p->cb_per_m * zc_m);
  return (rbf_point_t){.ratio = 1.0f + excess, .slope_per_m = -p->cb_per_m * excess};
}

rbf_point_t curve_at(const curve_param_t *p, const rbf_weights_t *live, bool known, float zc_m) {
  const bool on = known && zc_m < p->on_m;
  if (!ANY(on)) return FREE_AIR;
  rbf_point_t at;
  switch (p->mode) {
  case CURVE_FIXED: at = rbf_at(&p->fixed, zc_m); break;
  case CURVE_LIVE: at = rbf_at(live, zc_m); break;
  case CURVE_THEORY: at = theory_at(p, zc_m); break;
  default: return FREE_AIR;
  }
  const bool within = at.ratio >= p->ratio_min && at.ratio <= p->ratio_max;
  at.ratio = EITHER(within, at.ratio, f_clamp(at.ratio, p->ratio_min, p->ratio_max));
  at.slope_per_m = EITHER(within, at.slope_per_m, 0.0f);
  if (p->clip) {
    at.ratio = f_max(at.ratio, 1.0f);
    at.slope_per_m = EITHER(at.slope_per_m < 0.0f, at.slope_per_m, 0.0f);
  }
  return (rbf_point_t){.ratio = EITHER(on, at.ratio, FREE_AIR.ratio),
                       .slope_per_m = EITHER(on, at.slope_per_m, FREE_AIR.slope_per_m)};
}
