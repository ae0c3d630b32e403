// information.c - the rows' information on each candidate, given feedback, slow noise and misfit.
#include "gap/5_infer/evidence.h"

#include "base/cholesky.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// As CANDIDATES_MISFIT, where rows miss commands, for effects that these look like (fx->control_makes): an
// inertia of a quarter of the typical one has been named where nothing was hidden, and a torque beside a
// thrust scale (users' set 24533).
#define MISFIT_BESIDE 0.25

// Lateness of instruments, over the least lag or delay that is named: an error of either. Without it a wrong
// drag beside a lag is as sure as a right one.
#define LATE 0.15

typedef struct {
  const round_t *r;
  int n;
  double *typical, *A, *g; // A, g: products of the log, in typical sizes
  double *low;             // L, n x nominal flights: what feedback makes of each number
  double *wide;            // n: D
} parts_t;

static void scaled(const parts_t *p, const double *G, double *A, double *g) {
  const int n = p->n, size = n + 1;
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < n; k++) A[i * n + k] = G[i * size + k] * p->typical[i] * p->typical[k];
    g[i] = G[i * size + n] * p->typical[i];
  }
}

// Sets L from b_i = (A_i + I)^-1 g_i of each nominal flight i: bias, spread and correlations. excess: mean
// square of each column's own score there, in the log's units.
static void feedback(parts_t *p, double *excess, double *A, double *g) {
  const nominal_t *const nominal = p->r->nominal;
  const int n = p->n, flights = nominal ? nominal->n : 0;
  for (int f = 0; f < flights; f++) {
    scaled(p, nominal->total + (size_t)f * (size_t)(nominal->size * nominal->size), A, g);
    for (int k = 0; k < n; k++) {
      const double own = A[k * (n + 1)], here = p->A[k * (n + 1)];
      const double b = own > 1e-9 * here && own > 0.0 ? g[k] / own : 0.0;
      excess[k] += b * b * here * here / flights;
      A[k * (n + 1)] += 1.0;
    }
    if (!cholesky(A, n)) continue;
    cholesky_forward(A, n, g);
    cholesky_backward(A, n, g);
    for (int k = 0; k < n; k++) p->low[k * flights + f] = g[k] / sqrt(flights);
  }
}

// Returns column k's score in a block: its product with what the choice leaves of the residual.
static double score_in(const double *G, int size, int k, int m, const int *column, const double *b) {
  double score = G[k * size + size - 1];
  for (int i = 0; i < m; i++) score -= b[i] * G[k * size + column[i]];
  return score;
}

// Returns the variance of a column's total score that the flights' contradictions imply: from the squares of
// what each flight has beyond its part of the total.
static double contradiction(int flights, const double *score, const double *holds) {
  double all = 0.0, held = 0.0, sum = 0.0;
  for (int f = 0; f < flights; f++) all += score[f], held += holds[f];
  for (int f = 0; f < flights && held > 0.0; f++) {
    const double beyond = score[f] - holds[f] / held * all;
    sum += beyond * beyond * flights / (flights - 1.0);
  }
  return sum;
}

// Adds to squares[k] column k's squared score, summed over blocks (white rows give A_kk), or what flights
// contradict each other by if that is more. False: no memory.
static bool block_scores(const parts_t *p, double *squares) {
  const gram_t *const gram = &p->r->gram;
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = p->n, size = n + 1, m = choice_columns(p->r->c, &p->r->choice, column);
  const size_t flights = (size_t)gram->n_half / 2 + 1;
  double *const score = malloc(2 * flights * sizeof(double));
  if (!score) return false;
  double *const holds = score + flights;
  score_estimate(&p->r->score, &p->r->choice, b, NULL);
  for (int k = 0; k < n; k++) {
    double of_blocks = 0.0;
    memset(score, 0, 2 * flights * sizeof(double));
    for (int block = 0; block < gram->n_block; block++) {
      const double *const G = gram->block + (size_t)block * (size_t)(size * size);
      const double one = score_in(G, size, k, m, column, b);
      of_blocks += one * one;
      score[gram_flight(gram, block)] += one;
      holds[gram_flight(gram, block)] += G[k * (size + 1)];
    }
    if (gram->n_flight > 1) of_blocks = fmax(of_blocks, contradiction(gram->n_flight, score, holds));
    squares[k] += of_blocks * p->typical[k] * p->typical[k];
  }
  free(score);
  return true;
}

// What the sweeps of spread() need, of n numbers and n x n. Sums go along lines, all their numbers at once.
typedef struct {
  int n;
  const double *D;
  double *square, *relative; // A_ki^2 at [i][k]; A_ki^2 / A_kk^2 at [k][i]
  double *up, *come, *down;  // by D, weighted sum of `wanted`; diagonal of A D A; by D, its weighted sum
} sweeps_t;

static bool sweeps_make(sweeps_t *s, const parts_t *p, const double *wanted) {
  const int n = p->n;
  double *const room = calloc(2 * (size_t)(n * n) + 3 * (size_t)n + 1, sizeof(double));
  if (!room) return false;
  *s = (sweeps_t){
      n, p->wide, room, room + n * n, room + 2 * n * n, room + 2 * n * n + n, room + 2 * n * n + 2 * n};
  for (int k = 0; k < n; k++) {
    const double weight = p->A[k * (n + 1)] > 0.0 ? 1.0 / p->A[k * (n + 1)] : 0.0;
    for (int i = 0; i < n; i++) {
      const double square = p->A[k * n + i] * p->A[k * n + i];
      s->square[i * n + k] = square;
      s->relative[k * n + i] = square * weight * weight;
      s->up[i] += s->relative[k * n + i] * wanted[k];
    }
  }
  return true;
}

static void sweeps_add(sweeps_t *s) {
  const int n = s->n;
  for (int i = 0; i < n; i++) s->come[i] = s->down[i] = 0.0;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) s->come[k] += s->square[i * n + k] * s->D[i];
  for (int k = 0; k < n; k++)
    for (int i = 0; i < n; i++) s->down[i] += s->relative[k * n + i] * s->come[k];
}

// Finds D >= 0 such that the diagonal of A D A is nearest to `wanted`, by least squares relative to A_kk, the
// diagonal of white noise. The sweeps keep every sign and always come nearer (De Pierro 1987). They end when
// none moves by more than a hundredth of itself plus what a misfit adds. False: no memory.
static bool spread(parts_t *p, const double *wanted) {
  const int n = p->n;
  double *const D = p->wide;
  for (int k = 0; k < n; k++)
    D[k] = wanted[k] > 0.0 ? wanted[k] / (p->A[k * (n + 1)] * p->A[k * (n + 1)]) : 0.0;
  sweeps_t s;
  if (!sweeps_make(&s, p, wanted)) return false;
  for (double moved = HUGE_VAL; moved > 0.01;) {
    sweeps_add(&s);
    moved = 0.0;
    for (int i = 0; i < n; i++) {
      if (!(s.down[i] > 0.0)) continue;
      const double now = D[i] * s.up[i] / s.down[i];
      moved = fmax(moved, fabs(now - D[i]) / (D[i] + CANDIDATES_MISFIT * CANDIDATES_MISFIT));
      D[i] = now;
    }
  }
  free(s.square);
  return true;
}

// Returns the variance by which another pilot's control may differ from the nominal one in a column. Its
// filters turn what control makes of noise by other angles: what looks like inertia on nominal flights may
// look like torque in the log. So each such column may be off by as much once more, independently. square:
// mean square of its own score on nominal flights.
static double other_pilots(const parts_t *p, int column, double square) {
  const double own = p->A[column * (p->n + 1)];
  return own > 0.0 ? square / (own * own) : 0.0;
}

// Builds D. An effect has one misfit, which its forms, much alike, share: with one each, a dozen forms of a
// ground effect would hide what one of them does. False: no memory.
static bool widen(parts_t *p, const double *nominal, const double *blocks) {
  const candidates_t *const c = p->r->c;
  const bool slow = candidates_slow(p->r->s);
  double *const wanted = calloc((size_t)p->n + 1, sizeof(double));
  if (!wanted) return false;
  for (int k = 0; k < p->n; k++) wanted[k] = fmax(fmax(nominal[k], blocks[k]) - p->A[k * (p->n + 1)], 0.0);
  const bool spread_out = spread(p, wanted);
  free(wanted);
  if (!spread_out) return false;
  for (int i = 0; i < c->n; i++) {
    const fx_t *const fx = c->candidate[i].use.fx;
    const double misfit = fx->control_makes && slow ? MISFIT_BESIDE : CANDIDATES_MISFIT;
    for (int k = 0; k < c->candidate[i].n; k++) {
      const int column = c->candidate[i].first + k;
      const double late = LATE * candidates_least(fx, p->r->s) / p->typical[column];
      p->wide[column] += misfit * misfit / candidates_of(c, i) + late * late;
      if (fx->control_makes) p->wide[column] += other_pilots(p, column, nominal[column]);
    }
  }
  return true;
}

// Sets F and h from N = [L, sqrt(D)]; D gives as many columns as candidates have. FAILED: no memory, or no
// solution.
static done_t inform(const parts_t *p, information_t *f, why_t *why) {
  const int n = p->n, flights = p->r->nominal ? p->r->nominal->n : 0, m = n + flights;
  double *const N = calloc((size_t)(n * m + m * m + n * m + m), sizeof(double));
  if (!N) return error_failed(why, "out of memory");
  double *const C = N + n * m, *const M = C + m * m, *const z = M + n * m;
  for (int i = 0; i < n; i++) {
    N[i * m + i] = sqrt(p->wide[i]);
    for (int k = 0; k < flights; k++) N[i * m + n + k] = p->low[i * flights + k];
  }
  for (int i = 0; i < n; i++) // A N
    for (int j = 0; j < n; j++)
      for (int k = 0; k < m; k++) M[i * m + k] += p->A[i * n + j] * N[j * m + k];
  for (int i = 0; i < n; i++)
    for (int k = 0; k < m; k++) {
      z[k] += N[i * m + k] * p->g[i];
      for (int j = 0; j < m && N[i * m + k] != 0.0; j++) C[k * m + j] += N[i * m + k] * M[i * m + j];
    }
  for (int k = 0; k < m; k++) C[k * (m + 1)] += 1.0;
  const bool good = cholesky(C, m);
  if (good) {
    cholesky_forward(C, m, z);
    for (int i = 0; i < n; i++) cholesky_forward(C, m, M + i * m);
    for (int i = 0; i < n; i++) {
      f->h[i] = p->g[i];
      for (int k = 0; k < m; k++) f->h[i] -= M[i * m + k] * z[k];
      for (int j = 0; j < n; j++) {
        f->F[i * n + j] = p->A[i * n + j];
        for (int k = 0; k < m; k++) f->F[i * n + j] -= M[i * m + k] * M[j * m + k];
      }
    }
  }
  free(N);
  return good ? DONE : error_failed(why, "what feedback makes of the effects has no covariance");
}

void information_free(information_t *f) {
  free(f->F);
  *f = (information_t){.n = 0};
}

done_t information_make(information_t *f, const round_t *r, why_t *why) {
  const int n = r->c->columns, flights = r->nominal ? r->nominal->n : 0;
  const size_t square = (size_t)(n * n), line = (size_t)n;
  double *const room = calloc(2 * square + (6 + (size_t)flights) * line + 1, sizeof(double));
  *f = (information_t){.n = n, .F = calloc(square + line + 1, sizeof(double))};
  if (!room || !f->F) {
    free(room);
    return error_failed(why, "out of memory");
  }
  f->h = f->F + square;
  double *const A = room + square, *const at = A + square;
  parts_t p = {r, n, at, room, at + line, at + 6 * line, at + 2 * line};
  double *const nominal = at + 3 * line, *const blocks = at + 4 * line, *const g = at + 5 * line;
  for (int i = 0; i < r->c->n; i++)
    for (int k = 0; k < r->c->candidate[i].n; k++)
      p.typical[r->c->candidate[i].first + k] = r->c->candidate[i].typical[k];
  scaled(&p, r->gram.total, p.A, p.g);
  feedback(&p, nominal, A, g);
  const bool known = block_scores(&p, blocks) && widen(&p, nominal, blocks);
  const done_t status = known ? inform(&p, f, why) : error_failed(why, "out of memory");
  free(room);
  return status;
}

double evidence_log(const information_t *f, int n, const int *column, const double *p, const bool *positive) {
  double Q[COLUMN_MAX * COLUMN_MAX], z[COLUMN_MAX], sum = 0.0;
  if (n == 0) return 0.0;
  for (int i = 0; i < n; i++) {
    z[i] = f->h[column[i]];
    for (int k = 0; k < n; k++) Q[i * n + k] = f->F[column[i] * f->n + column[k]];
    Q[i * (n + 1)] += p[i];
  }
  if (!cholesky(Q, n)) return -HUGE_VAL;
  cholesky_forward(Q, n, z);
  for (int i = 0; i < n; i++) sum += 0.5 * z[i] * z[i] - log(Q[i * (n + 1)]) + 0.5 * log(p[i]);
  cholesky_backward(Q, n, z); // means
  for (int i = 0; i < n; i++) {
    if (!positive[i]) continue;
    double e[COLUMN_MAX] = {0.0}, variance = 0.0;
    e[i] = 1.0;
    cholesky_forward(Q, n, e);
    for (int k = i; k < n; k++) variance += e[k] * e[k];
    // Probability that the number is positive, over that of the prior, which is a half.
    sum += log(fmax(erfc(-z[i] / sqrt(2.0 * variance)), 1e-200));
  }
  return sum;
}
