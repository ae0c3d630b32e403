// model.c - the effects of a model.
#include "model.h"

#include <string.h>

status_t model_add_fx(model_t *m, const fx_use_t *use, why_t *why) {
  for (int i = 0; i < m->n_fx; i++) {
    if (m->fx[i].fx != use->fx) continue;
    m->fx[i] = *use;
    return ST_OK;
  }
  if (m->n_fx == FX_MAX)
    return error_set(why, "effect %s: at most %d effects at once", use->fx->name, FX_MAX);
  m->fx[m->n_fx++] = *use;
  return ST_OK;
}

double model_thrust_ratio(const model_t *m, const fx_place_t *place) {
  double ratio = 1.0;
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx->excess) ratio += m->fx[i].fx->excess(&m->fx[i], place);
  return ratio;
}
