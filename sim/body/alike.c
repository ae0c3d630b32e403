// alike.c - which bodies may be moved together.
#include "body/alike.h"

#include "body/lanes_of.h"

static bool knows(has_t *has, const body_t *b) {
  if (has->asked != b) has->knows = lanes_know(b);
  has->asked = b;
  return has->knows;
}

bool alike_fits(has_t *has, const body_t *b) {
  return !b->broken && b->kind != INTEGRATE_REFERENCE && !b->rigid.vertical_only && !b->rigid.held &&
         !(b->span_s > BODY_CHUNK_S) && knows(has, b);
}

static bool same_effects(const fx_use_t *const *a, const fx_use_t *const *b, int n) {
  for (int k = 0; k < n; k++)
    if (a[k]->fx != b[k]->fx || a[k]->form != b[k]->form) return false;
  return true;
}

static bool same_senses(const model_t *a, const model_t *b) {
  const fx_use_t *of_a[FX_MAX], *of_b[FX_MAX];
  const int n = lanes_senses(a, of_a);
  return n == lanes_senses(b, of_b) && same_effects(of_a, of_b, n);
}

// True if a and b agree in what does not change from tick to tick.
static bool made_alike(const body_t *a, const body_t *b) {
  return a->kind == b->kind && a->step_s == b->step_s && a->model->battery.n == b->model->battery.n &&
         (a->n_tick > 0) == (b->n_tick > 0) && same_senses(a->model, b->model) &&
         a->n_excess == b->n_excess && a->n_load == b->n_load &&
         same_effects(a->excess, b->excess, a->n_excess) && same_effects(a->load, b->load, a->n_load);
}

// Calls made_alike() only if one of them was changed, or has effects that change it at every tick.
bool alike(has_t *has, const body_t *a, const body_t *b) {
  if (has->like != a || has->like_changed != a->changed || has->body != b || has->changed != b->changed ||
      a->n_tick > 0) {
    has->is_like = made_alike(a, b);
    has->like = a;
    has->like_changed = a->changed;
  }
  return has->is_like && a->span_s == b->span_s && a->rigid.lag_in_speed == b->rigid.lag_in_speed &&
         a->rigid.plain_lag == b->rigid.plain_lag && a->look_is_y == b->look_is_y &&
         a->look.loaded == b->look.loaded && a->pushed == b->pushed;
}
