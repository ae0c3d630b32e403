// group_senses.c - the sensors and estimators of eight flights.
#include "flight/group.h"

#include "flight/lanes_blocks.h"

bool group_parts(apart_t *a, uint32_t ms) {
  const bool soon = ms - a->parted_ms <= APART_SOON_MS + a->rest_ms;
  a->parted_ms = ms;
  a->rest_ms = !soon ? 0 : a->rest_ms == 0 ? APART_REST_MS : 2 * a->rest_ms;
  if (a->rest_ms > APART_REST_MAX_MS) a->rest_ms = APART_REST_MAX_MS;
  a->back_ms = ms + a->rest_ms;
  return soon;
}

bool group_rested(const apart_t *a, uint32_t ms) {
  return (int32_t)(ms - a->back_ms) >= 0;
}

// --- in and out --------------------------------------------------------------------------------------------

static void come_back(group_t *g) {
  if (g->sensed == g->fly || !lanes_senses_due(g->woven.state, g->sensed == 0)) return;
  EACH(k, g->fly & ~g->sensed) {
    if (!group_rested(&g->apart_sensed[k], g->ms)) continue;
    woven_senses_back(&g->woven, k, g->job[k]->f);
    g->sensed |= 1u << k;
  }
}

static void part(group_t *g, int k) {
  flight_loop_t *const f = g->job[k]->f;
  woven_sense_alone(&g->woven, k, f);
  if (!group_parts(&g->apart_sensed[k], g->ms)) {
    woven_senses_back(&g->woven, k, f);
    return;
  }
  g->sensed &= ~(1u << k);
  woven_get(&g->woven, LANES_truth, k, &f->truth); // the tick's other millisecond needs it, too
}

// --- a millisecond -----------------------------------------------------------------------------------------

// Draws the inertial sensors' noise of all in lanes, and the other sensors' where they are due.
static void draw(group_t *g, senses_drawn_t drawn[LANES]) {
  lanes_draw(g->woven.state);
  random_triangles_of_all(g->random, IMU_DRAWN, woven_noise_of_imu(&g->woven));
  const unsigned draws = g->ms % RANGE_ANY_PERIOD_MS == 0 ? g->fly : g->mocap & g->fly;
  EACH(k, g->fly & ~draws) drawn[k].by_mocap = false;
  if (!draws) return;
  EACH(k, draws) {
    flight_loop_t *const f = g->job[k]->f;
    f->senses.range.tick = g->ms; // lags behind while in lanes
    loop_draw_more(f, &f->truth, &drawn[k]);
  }
  // Also for flights by themselves: what is not drawn in each millisecond must be theirs when they return.
  OF_EACH(drawn_of, g->fly, &drawn[k]);
  woven_put_all(&g->woven, &g->woven.drawn_more, drawn_of);
}

static void sense_alone(group_t *g, int k, senses_drawn_t *drawn) {
  flight_loop_t *const f = g->job[k]->f;
  woven_get_part(&g->woven, &g->woven.noise_of_imu, k, drawn);
  senses_take(&f->senses, &f->noise.imu, &f->noise.range, drawn, &f->truth, &f->in);
  woven_tell_sensed(&g->woven, k, f);
}

void group_sense(group_t *g) {
  senses_drawn_t drawn[LANES];
  come_back(g);
  draw(g, drawn);
  const unsigned in = g->sensed, passed = in ? lanes_senses_ms(g->woven.state, in) : 0;
  EACH(k, in & ~passed) part(g, k);
  EACH(k, g->fly & ~in) sense_alone(g, k, &drawn[k]);
  EACH(k, lanes_range_new(g->woven.state) & g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    woven_get(&g->woven, LANES_in, k, &f->in);
    loop_note_range(f);
  }
}
