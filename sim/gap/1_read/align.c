// align.c - stage 1: the delay of a stream against another one that drives it.
//
// Over a window, attitude, velocity or position moves by the integral of gyro, force or velocity, tau late:
//   moved(t) = driven(t - tau) = driven(t) - tau (last value of the driving signal minus its first) + ...
// Each of eight parts of the flight gives a tau by least squares, with a scale and an offset beside it; their
// scatter gives the standard error.
#include "gap/1_read/read.h"

#include "base/constants.h"
#include <math.h>

#define PARTS       8
#define IMPACT_MPS2 8.0  // a larger acceleration is an impact, too short for the log's rate
#define SMOOTH_S    0.02 // the force's end values are means over this: propellers shake the accelerometer

// Integrates three columns over a window, by the trapezoidal rule.
static void drive(const gap_flight_t *f, signal_id_t first, int i, int j, window_t *w) {
  for (int k = 0; k < 3; k++) {
    const double *const rate = f->v[(int)first + k];
    w->driven[k] = -0.5 * (rate[i] + rate[j]);
    for (int s = i; s <= j; s++) w->driven[k] += rate[s];
    w->driven[k] /= f->rate_Hz;
    w->ends[k] = rate[j] - rate[i];
  }
}

static bool turn(const gap_flight_t *f, int i, int j, window_t *w) {
  const dq_t turned = dq_mul(dq_inverse(attitude_at(f->v, i)), attitude_at(f->v, j));
  const d3_t axis = d3(turned.x, turned.y, turned.z);
  const double sine = d3_norm(axis), angle = 2.0 * atan2(sine, fabs(turned.w));
  d3_put(w->moved, d3_scale((sine > 1e-9 ? angle / sine : 2.0) * copysign(1.0, turned.w), axis));
  drive(f, SIG_GX, i, j, w);
  return true;
}

static bool push(const gap_flight_t *f, int i, int j, window_t *w) {
  const int side = (int)(0.5 * SMOOTH_S * f->rate_Hz);
  *w = (window_t){0};
  if (i < side || j + side >= f->n || f->segment[i - side] != f->segment[j + side]) return false;
  for (int s = i - side; s <= j + side; s++) {
    double a_w[3];
    d3_put(a_w, dq_to_world(attitude_at(f->v, s), vector_at(f->v, SIG_AX, s)));
    a_w[2] -= G_MPS2;
    for (int k = 0; k < 3; k++) {
      if (!(fabs(a_w[k]) < IMPACT_MPS2)) return false;
      if (s >= i && s <= j) w->driven[k] += (s == i || s == j ? 0.5 : 1.0) * a_w[k] / f->rate_Hz;
      if (s >= j - side) w->ends[k] += a_w[k] / (2 * side + 1);
      if (s <= i + side) w->ends[k] -= a_w[k] / (2 * side + 1);
    }
  }
  d3_put(w->moved, d3_sub(vector_at(f->v, SIG_VX, j), vector_at(f->v, SIG_VX, i)));
  return true;
}

static bool go(const gap_flight_t *f, int i, int j, window_t *w) {
  d3_put(w->moved, d3_sub(vector_at(f->v, SIG_X, j), vector_at(f->v, SIG_X, i)));
  drive(f, SIG_VX, i, j, w);
  return true;
}

const drive_t GAP_TURN = {"attitude", "turns", "gyro", ATTITUDE | GYRO, ATTITUDE, SIG_ROLL, SIG_GX, 0,
                          0.1,        0.01,    turn};
const drive_t GAP_PUSH = {"velocity",
                          "changes",
                          "accelerometer",
                          VELOCITY | FORCE | ATTITUDE,
                          PLACE | VELOCITY,
                          SIG_VX,
                          SIG_AX,
                          2,
                          0.2,
                          0.1,
                          push};
const drive_t GAP_GO = {"position", "moves", "velocity", PLACE | VELOCITY, PLACE, SIG_X, SIG_VX, 0,
                        0.3,        0.02,    go};

int gap_drive_samples(const gap_flight_t *f, const drive_t *drive) {
  const int m = (int)(drive->span_s * f->rate_Hz + 0.5);
  return m < 2 ? 2 : m;
}

bool gap_drive_window(const gap_flight_t *f, const drive_t *drive, int i, window_t *w) {
  const int j = i + gap_drive_samples(f, drive);
  double all = 0.0;
  if (f->segment[i] != f->segment[j] || !drive->at(f, i, j, w)) return false;
  for (int k = 0; k < 3; k++) all += w->moved[k] + w->driven[k] + w->ends[k];
  return isfinite(all);
}

// --- how late ---------------------------------------------------------------------------------------------

typedef struct {
  double n, e, g, d, ed, eg, gg, gd, dd;
} products_of_turns_t;

// Returns tau of one part, axes `from` to 2 together. *weight: its information, the sum of squares of the
// ends that scale and offset do not explain; 0: this part cannot tell.
static double late_of(const products_of_turns_t s[3], int from, double *weight) {
  double ed = 0.0, eg = 0.0, gg = 0.0, gd = 0.0, dd = 0.0;
  *weight = 0.0;
  for (int k = from; k < 3; k++) {
    if (s[k].n < 8.0) return 0.0;
    ed += s[k].ed - s[k].e * s[k].d / s[k].n;
    eg += s[k].eg - s[k].e * s[k].g / s[k].n;
    gg += s[k].gg - s[k].g * s[k].g / s[k].n;
    gd += s[k].gd - s[k].g * s[k].d / s[k].n;
    dd += s[k].dd - s[k].d * s[k].d / s[k].n;
  }
  const double det = gg * dd - gd * gd;
  if (!(det > 1e-6 * gg * dd) || !(gg > 0.0)) return 0.0;
  *weight = det / gg;
  return -(ed * gg - eg * gd) / det;
}

skew_t gap_skew(const gap_flight_t *f, const drive_t *drive) {
  const int m = gap_drive_samples(f, drive), step = m / 4 > 0 ? m / 4 : 1;
  products_of_turns_t sums[PARTS][3] = {0};
  for (int i = 0; i + m < f->n; i += step) {
    window_t w;
    if (!gap_drive_window(f, drive, i, &w)) continue;
    for (int k = 0; k < 3; k++) {
      products_of_turns_t *const s = &sums[(long)PARTS * i / f->n][k];
      const double e = w.moved[k] - w.driven[k], g = w.driven[k], d = w.ends[k];
      s->n += 1.0;
      s->e += e, s->g += g, s->d += d;
      s->ed += e * d, s->eg += e * g, s->gg += g * g, s->gd += g * d, s->dd += d * d;
    }
  }
  double late[PARTS], weight[PARTS], sum = 0.0, mean = 0.0, scatter = 0.0;
  int parts = 0;
  for (int p = 0; p < PARTS; p++) {
    late[p] = late_of(sums[p], drive->axis, &weight[p]);
    sum += weight[p];
    mean += weight[p] * late[p];
    parts += weight[p] > 0.0;
  }
  if (parts < PARTS / 2) return (skew_t){0.0, HUGE_VAL};
  mean /= sum;
  for (int p = 0; p < PARTS; p++) scatter += pow(weight[p] / sum * (late[p] - mean), 2);
  return (skew_t){mean, sqrt(scatter * parts / (parts - 1))};
}
