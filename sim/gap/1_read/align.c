// align.c - stage 1: how late one stream is against another that drives it.
//
// Over windows of h: what attitude or velocity moved is what gyro or force drive, tau late:
//   moved(t) = driven(t - tau) = driven(t) - tau (ends of the driving signal: last minus first) + ...
// Least squares over each of eight parts of the flight, with a scale and an offset beside tau; their scatter
// is the standard error.
#include "gap/1_read/read.h"

#include "base/constants.h"
#include <math.h>

#define PARTS       8
#define IMPACT_MPS2 8.0  // it touches something: too short for the log's rate
#define SMOOTH_S    0.02 // the force's ends are means over this: propellers shake the accelerometer

typedef struct {
  double n, e, g, d, ed, eg, gg, gd, dd;
} products_of_turns_t;

static bool turn(const gap_flight_t *f, int i, int m, window_t *w) {
  const int j = i + m;
  double *const *v = f->v;
  const double a[4] = {v[SIG_QW][i], -v[SIG_QX][i], -v[SIG_QY][i], -v[SIG_QZ][i]};
  const double b[4] = {v[SIG_QW][j], v[SIG_QX][j], v[SIG_QY][j], v[SIG_QZ][j]};
  const double turned[4] = {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  const double sine = sqrt(turned[1] * turned[1] + turned[2] * turned[2] + turned[3] * turned[3]);
  const double angle = 2.0 * atan2(sine, fabs(turned[0]));
  double all = angle;
  for (int k = 0; k < 3; k++) {
    const double *const rate = v[SIG_GX + k];
    w->moved[k] = (sine > 1e-9 ? angle / sine : 2.0) * copysign(1.0, turned[0]) * turned[1 + k];
    w->driven[k] = -0.5 * (rate[i] + rate[j]);
    for (int s = i; s <= j; s++) w->driven[k] += rate[s];
    w->driven[k] /= f->rate_Hz;
    w->ends[k] = rate[j] - rate[i];
    all += w->driven[k];
  }
  return isfinite(all);
}

// Acceleration in the world.
static void acceleration(const gap_flight_t *f, int i, double a_w[3]) {
  double *const *v = f->v;
  const double w = v[SIG_QW][i], x = v[SIG_QX][i], y = v[SIG_QY][i], z = v[SIG_QZ][i];
  const double a[3] = {v[SIG_AX][i], v[SIG_AY][i], v[SIG_AZ][i]};
  const double t[3] = {y * a[2] - z * a[1] + w * a[0], z * a[0] - x * a[2] + w * a[1],
                       x * a[1] - y * a[0] + w * a[2]};
  a_w[0] = a[0] + 2.0 * (y * t[2] - z * t[1]);
  a_w[1] = a[1] + 2.0 * (z * t[0] - x * t[2]);
  a_w[2] = a[2] + 2.0 * (x * t[1] - y * t[0]) - G_MPS2;
}

static bool push(const gap_flight_t *f, int i, int m, window_t *w) {
  const int j = i + m, side = (int)(0.5 * SMOOTH_S * f->rate_Hz);
  double all = 0.0;
  *w = (window_t){0};
  if (i < side || j + side >= f->n || f->segment[i - side] != f->segment[j + side]) return false;
  for (int s = i - side; s <= j + side; s++) {
    double a_w[3];
    acceleration(f, s, a_w);
    for (int k = 0; k < 3; k++) {
      if (!(fabs(a_w[k]) < IMPACT_MPS2)) return false;
      if (s >= i && s <= j) w->driven[k] += (s == i || s == j ? 0.5 : 1.0) * a_w[k] / f->rate_Hz;
      if (s >= j - side) w->ends[k] += a_w[k] / (2 * side + 1);
      if (s <= i + side) w->ends[k] -= a_w[k] / (2 * side + 1);
    }
  }
  for (int k = 0; k < 3; k++) {
    w->moved[k] = f->v[SIG_VX + k][j] - f->v[SIG_VX + k][i];
    all += w->moved[k] + w->driven[k] + w->ends[k];
  }
  return isfinite(all);
}

static bool go(const gap_flight_t *f, int i, int m, window_t *w) {
  const int j = i + m;
  double all = 0.0;
  for (int k = 0; k < 3; k++) {
    const double *const speed = f->v[SIG_VX + k];
    w->moved[k] = f->v[SIG_X + k][j] - f->v[SIG_X + k][i];
    w->driven[k] = -0.5 * (speed[i] + speed[j]);
    for (int s = i; s <= j; s++) w->driven[k] += speed[s];
    w->driven[k] /= f->rate_Hz;
    w->ends[k] = speed[j] - speed[i];
    all += w->moved[k] + w->driven[k];
  }
  return isfinite(all);
}

const drive_t GAP_TURN = {"the attitude turns", "the gyro", SIG_GX, 0.1, 0.01, turn};
const drive_t GAP_PUSH = {"the velocity changes", "the acceleration", SIG_AX, 0.2, 0.1, push};
const drive_t GAP_GO = {"the position moves", "the velocity", SIG_VX, 0.3, 0.02, go};

int gap_drive_samples(const gap_flight_t *f, const drive_t *drive) {
  const int m = (int)(drive->span_s * f->rate_Hz + 0.5);
  return m < 2 ? 2 : m;
}

// tau of one part, and how much it knows (the sum of squares that tells it).
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

static skew_t skew_of(const gap_flight_t *f, const drive_t *drive, int from) {
  const int m = gap_drive_samples(f, drive), step = m / 4 > 0 ? m / 4 : 1;
  products_of_turns_t sums[PARTS][3] = {0};
  for (int i = 0; i + m < f->n; i += step) {
    window_t w;
    if (f->segment[i] != f->segment[i + m] || !drive->at(f, i, m, &w)) continue;
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
    late[p] = late_of(sums[p], from, &weight[p]);
    sum += weight[p];
    mean += weight[p] * late[p];
    parts += weight[p] > 0.0;
  }
  if (parts < PARTS / 2) return (skew_t){0.0, HUGE_VAL};
  mean /= sum;
  for (int p = 0; p < PARTS; p++) scatter += pow(weight[p] / sum * (late[p] - mean), 2);
  return (skew_t){mean, sqrt(scatter * parts / (parts - 1))};
}

skew_t gap_skew_attitude(const gap_flight_t *f) {
  return skew_of(f, &GAP_TURN, 0);
}

skew_t gap_skew_velocity(const gap_flight_t *f) {
  return skew_of(f, &GAP_PUSH, 2);
}
