// plan.c - see plan.h.
#include "exam/plan.h"

#include "exam/flights.h"
#include <math.h>

plan_t6 plan_make(random_t *r, bool hover_only) {
  plan_t6 plan;
  for (int i = 0; i < EXAM_PIECES; i++) {
    plan.order[i] = hover_only ? 6 : i;
    for (int k = 0; k < 4; k++) plan.number[i][k] = random_uniform(r, 0.0, 1.0);
  }
  for (int i = EXAM_PIECES - 1; i > 0; i--) {
    const int k = (int)random_uniform(r, 0.0, i + 0.999), swap = plan.order[i];
    plan.order[i] = plan.order[k];
    plan.order[k] = swap;
  }
  return plan;
}

static wish_t circle(double t, double span, const double *n) {
  const double speed = 0.5 + 1.0 * n[0], radius = 0.35 + 0.4 * n[1], side = n[2] > 0.5 ? 1.0 : -1.0;
  const double in = fmin(1.0, fmin(t, span - t) / 0.4), angle = side * speed / radius * t;
  return (wish_t){{in * radius * sin(angle), in * radius * (cos(angle) - 1.0), 0.4},
                  {in * speed * side * cos(angle), -in * speed * side * sin(angle), 0.0},
                  0.0};
}

// A line out and back at up to 1.5 m/s.
static wish_t line(double t, double span, const double *n) {
  const double w = 2.0 * 3.14159265 / span, far = (0.35 + 0.3 * n[0]), angle = 2.0 * 3.14159265 * n[1];
  const double s = far * sin(w * t), v = far * w * cos(w * t);
  return (wish_t){{s * cos(angle), s * sin(angle), 0.4}, {v * cos(angle), v * sin(angle), 0.0}, 0.0};
}

static wish_t wish_in(int kind, double t, double span, const double *n) {
  const double top_m = EXAM_CEILING_M - 0.013, share = t / span;
  wish_t w = {.pos = {0.0, 0.0, 0.4}};
  switch (kind) {
  case 0: w.pos.z = top_m - (0.02 + 0.03 * n[0] + 0.06 * pow(sin(3.14159265 * share + n[1]), 2.0)); break;
  case 1: w.pos.z = 0.017 + 0.012 + 0.03 * n[0] + 0.08 * pow(sin(3.14159265 * share + n[1]), 2.0); break;
  case 2: return line(t, span, n);
  case 3: return circle(t, span, n);
  case 4: w.pos.z = 0.4 + (fmod(3.0 * share + n[0], 1.0) > 0.5 ? 0.18 : -0.18); break;
  case 5: w.yaw = 2.0 * 3.14159265 * share; break;
  default:
    w.pos.x = fmod(3.0 * share, 1.0) > 0.5 ? 0.05 : 0.0;
    w.pos.y = fmod(2.0 * share, 1.0) > 0.5 ? 0.05 : 0.0;
  }
  return w;
}

wish_t plan_wish(const plan_t6 *plan, double t_s) {
  const double span = EXAM_SPAN_S / EXAM_PIECES;
  const int i = (int)fmin(t_s / span, EXAM_PIECES - 1.0);
  return wish_in(plan->order[i], t_s - i * span, span, plan->number[i]);
}
