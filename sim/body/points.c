// points.c - a vehicle at instants, eight of them side by side.
#include "body/points.h"

#include "body/lanes_of.h"
#include <stdlib.h>

struct points {
  const lanes_door_t *door;
  lanes_t *lanes;
  lanes_effect_t more;
};

points_t *points_open(int bits) {
  if (bits == 0) return NULL;
  points_t *const p = malloc(sizeof *p);
  if (!p) return NULL;
  p->door = lanes_door(bits);
  p->lanes = lanes_open(p->door);
  if (p->lanes) return p;
  free(p);
  return NULL;
}

void points_close(points_t *p) {
  if (!p) return;
  p->door->close(p->lanes);
  free(p);
}

static void take(const lanes_at_t *to, int lane, const body_t *b) {
  const double inertia_kgm2[] = {b->model->frame.inertia_kgm2[0], b->model->frame.inertia_kgm2[1],
                                 b->model->frame.inertia_kgm2[2]};
  lanes_put(to->rigid, (const double *)&b->rigid, RIGID_NUMBERS, lane);
  lanes_put(to->touch, (const double *)&b->touch, TOUCH_NUMBERS, lane);
  lanes_put(to->plant, (const double *)&b->plant, PLANT_NUMBERS, lane);
  lanes_put(to->untouched, (const double *)&b->untouched, PLANT_NUMBERS, lane);
  lanes_put(to->inertia, inertia_kgm2, 3, lane);
  lanes_take_effects(to, lane, b);
  for (int k = 0; k < b->n_tick; k++) lanes_put(to->tick[k], b->tick[k]->p, EFFECT_NUMBERS, lane);
  const fx_use_t *sense[FX_MAX];
  const int n = lanes_senses(b->model, sense);
  for (int k = 0; k < n; k++) lanes_put(to->sense[k], sense[k]->p, EFFECT_NUMBERS, lane);
}

bool points_of(points_t *p, const body_t *b, double span_s) {
  if (!lanes_know(b) || b->rigid.vertical_only || b->rigid.held) return false;
  lanes_alike_t alike = lanes_alike(b);
  alike.plain_lag = true;
  alike.looked = alike.loaded = false;
  alike.span_s = span_s;
  alike.n_tick = b->n_tick;
  for (int k = 0; k < b->n_tick; k++) {
    if (!lanes_know_effect(b->tick[k])) return false;
    alike.tick[k] = lanes_effect(b->tick[k]).fx;
  }
  p->door->set(p->lanes, &alike);
  for (int lane = 0; lane < LANES; lane++) take(p->door->at(p->lanes), lane, b);
  return true;
}

bool points_more(points_t *p, const fx_use_t *more) {
  p->more = lanes_effect(more);
  return lanes_know_effect(more);
}

size_t points_kept_bytes(const points_t *p) {
  return (p->door->kept_bytes() + POINTS_ALIGN - 1) / POINTS_ALIGN * POINTS_ALIGN;
}

static void begin(const points_t *p, int n) {
  p->door->begin((1u << n) - 1);
}

unsigned points_look(points_t *p, const lanes_instants_t *at, int n, double up[LANES]) {
  begin(p, n);
  p->door->look(p->lanes, at, up);
  return p->door->left();
}

unsigned points_read(points_t *p, const lanes_sight_t *sight, lanes_readings_t *to) {
  p->door->read(p->lanes, sight, to);
  return p->door->left();
}

void points_keep(const points_t *p, void *kept) {
  p->door->keep(p->lanes, kept);
}

unsigned points_read_again(points_t *p, const void *kept, bool moved, int n, lanes_readings_t *to) {
  begin(p, n);
  p->door->read_again(p->lanes, kept, moved, to);
  return p->door->left();
}

unsigned points_read_more(points_t *p, const void *kept, int n, lanes_readings_t *to) {
  begin(p, n);
  p->door->read_more(p->lanes, &p->more, kept, to);
  return p->door->left();
}
