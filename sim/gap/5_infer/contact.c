// contact.c - instants at which the vehicle touches something.
#include "gap/5_infer/contact.h"

#include "base/lsq_blocks.h"
#include "base/nth.h"
#include "gap/5_infer/score.h"
#include <math.h>
#include <stdlib.h>

#define PASSES      4
#define SPREAD      3    // rows before and after: the filter reaches so far
#define TOUCH_FORCE 0.15 // of gravity, at least: a curve of another shape than the candidates' misses less
#define TOUCH_TURN  0.02 // the same, at a rotor's arm

static double robust_sd(const double *e, int n, double *room) {
  int used = 0;
  for (int i = 0; i < n; i++)
    if (e[i] != 0.0) room[used++] = fabs(e[i]);
  if (!used) return HUGE_VAL;
  return nth_smallest(room, used, used / 2) / 0.6745;
}

// Rows `from` to `to` have no part in any sequence any more.
static void leave_out(const rows_t *r, int from, int to) {
  for (int i = from; i <= to + 1; i++)
    if (i >= 0 && i < r->n) r->follows[i] = false;
}

// What a touch makes at least, in the unit of a channel.
static double least_touch(const model_t *m, int ch) {
  const double arm_m = fabs(m->frame.rotor_y_m[0]);
  if (ch < CH_FORCES) return TOUCH_FORCE * G_MPS2;
  return TOUCH_TURN * G_MPS2 * m->mass_kg * arm_m / m->frame.inertia_kgm2[ch - CH_WX];
}

static int mark_channel(const set_t *s, const double *e, double limit) {
  const rows_t *r = &s->smooth;
  int found = 0;
  for (int i = 0; i < r->n; i++) {
    const grid_point_t *p = &s->grid[r->flight[i]].point[r->point[i]];
    if (!(fabs(e[i]) > limit) || !(p->clear_m < CONTACT_NEAR_M)) continue;
    leave_out(r, i - SPREAD, i + SPREAD);
    found++;
  }
  return found;
}

typedef struct {
  int *column;
  double *b, *left, *white;
} contact_room_t;

static bool contact_room(contact_room_t *room, const set_t *s, int columns) {
  const size_t rows = (size_t)s->smooth.n + 1, n = (size_t)columns + 1;
  *room = (contact_room_t){malloc(n * sizeof(int)), malloc(n * sizeof(double)), malloc(rows * sizeof(double)),
                           malloc(rows * sizeof(double))};
  return room->column && room->b && room->left && room->white;
}

static void room_free(contact_room_t *room) {
  free(room->column);
  free(room->b);
  free(room->left);
  free(room->white);
}

static int mark_all(const set_t *s, const model_t *m, const design_t *t, const gram_t *g,
                    const contact_room_t *room) {
  int found = 0;
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    if (!g->color[ch].used) continue;
    const int n = s->smooth.n;
    for (int i = 0; i < n; i++) room->left[i] = t->x[ch][t->columns][i];
    for (int k = 0; k < t->columns; k++) {
      const double *x = t->x[ch][k];
      for (int i = 0; x && i < n; i++) room->left[i] -= room->b[k] * x[i];
    }
    color_whiten(&g->color[ch], &s->smooth, room->left, room->white);
    const double limit = CONTACT_SD * robust_sd(room->white, n, room->left);
    found += mark_channel(s, room->white, fmax(limit, least_touch(m, ch) / g->color[ch].sd));
  }
  return found;
}

static done_t pass(set_t *s, const candidates_t *c, const model_t *m, const design_t *t,
                   const contact_room_t *room, int *found, why_t *why) {
  gram_t g = {0};
  score_t j;
  TRY(score_make(&j, c, &g, NULL, why));
  const done_t status = gram_make(&g, s, t, NULL, j.color_ridge, why);
  if (status == DONE) {
    for (int i = 0; i < t->columns; i++) room->column[i] = i;
    lsq_solve_products(g.total, g.size, room->column, t->columns, j.color_ridge, room->b, NULL);
    *found = mark_all(s, m, t, &g, room);
    gram_free(&g);
  }
  score_free(&j);
  return status;
}

static bool comes_near(const set_t *s) {
  for (int i = 0; i < s->smooth.n; i++)
    if (s->grid[s->smooth.flight[i]].point[s->smooth.point[i]].clear_m < CONTACT_NEAR_M) return true;
  return false;
}

done_t contact_drop(set_t *s, const candidates_t *c, const model_t *m, why_t *why) {
  design_t t;
  contact_room_t room;
  if (!comes_near(s)) return DONE;
  TRY(design_make(&t, s, m, c, &(chosen_t){.n = 0}, why));
  done_t status = contact_room(&room, s, t.columns) ? DONE : error_failed(why, "out of memory");
  int found = 1;
  for (int i = 0; i < PASSES && found && status == DONE; i++) status = pass(s, c, m, &t, &room, &found, why);
  room_free(&room);
  design_free(&t);
  return status;
}
