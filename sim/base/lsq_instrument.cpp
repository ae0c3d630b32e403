// lsq_instrument.cpp - two-stage least squares from sums of products.
#include "base/lsq_instrument.h"

#include "base/dense.hpp"
#include <cmath>

using view_t = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using out_t = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

#define F_MAX 1e6

namespace {

struct stage_t {
  const lsq_instrument_t *p;
  int size;
  VectorXd scale;                            // scales the columns to a unit diagonal
  MatrixXd P;                                // xhat = P' z: size x n, in scaled columns
  Eigen::Array<bool, Eigen::Dynamic, 1> own; // x_k stands for itself
};

MatrixXd products(const stage_t &s, const double *G) {
  return dense_scaled(view_t(G, s.size, s.size), s.scale);
}

int first_of(const stage_t &s, int k) {
  return s.p->n + k * s.p->sets * s.p->lags;
}

VectorXd fitted(const MatrixXd &G, int at, int n, int k) {
  MatrixXd Z = G.block(at, at, n, n);
  Z.diagonal().array() += 1e-9;
  return dense_solve_symmetric(Z, G.col(k).segment(at, n));
}

void project(stage_t &s, const MatrixXd &G) {
  const int n = s.p->sets * s.p->lags;
  s.P = MatrixXd::Zero(s.size, s.p->n);
  for (int k = 0; k < s.p->n; k++)
    if (s.own(k))
      s.P(k, k) = 1.0;
    else
      s.P.block(first_of(s, k), k, n, 1) = fitted(G, first_of(s, k), n, k);
}

// F of x_k's first stage: its slope on w = Z a over the standard error, squared, over the number of fitted
// instruments. blocks: the effective number of blocks.
double strength(const stage_t &s, int k, const VectorXd &w, double instruments, double *blocks) {
  double ww = 0.0, wx = 0.0, sum = 0.0;
  VectorXd ww_b(s.p->n_block), wx_b(s.p->n_block);
  for (int b = 0; b < s.p->n_block; b++) {
    const VectorXd Gw = dense_apply(products(s, s.p->block + (ptrdiff_t)b * s.size * s.size), w);
    ww += ww_b(b) = w.dot(Gw);
    wx += wx_b(b) = Gw(k);
  }
  const double slope = wx / ww;
  for (int b = 0; b < s.p->n_block; b++) sum += std::pow(wx_b(b) - slope * ww_b(b), 2);
  const double f = wx * wx / std::fmax(sum, 1e-300) / instruments;
  *blocks = wx * wx / std::fmax(wx_b.squaredNorm(), 1e-300);
  return std::isfinite(f) ? std::fmin(f, F_MAX) : 0.0;
}

double instruments_of(const stage_t &s, int k) {
  return (double)(s.scale.segment(first_of(s, k), s.p->sets * s.p->lags).array() > 0.0).count();
}

// Leaves out sets that are too weak; x_k stands for itself where none remains. F: that of the best set.
void choose(stage_t &s, double *F) {
  const int lags = s.p->lags;
  const MatrixXd G = products(s, s.p->total);
  for (int k = 0; k < s.p->n; k++) {
    F[k] = 0.0;
    for (int i = 0; i < s.p->sets; i++) {
      const int at = first_of(s, k) + i * lags;
      VectorXd w = VectorXd::Zero(s.size);
      w.segment(at, lags) = fitted(G, at, lags, k);
      const bool there = G.diagonal().segment(at, lags).maxCoeff() > 0.0;
      double blocks;
      const double f = there ? strength(s, k, w, lags, &blocks) : 0.0;
      F[k] = std::fmax(F[k], f);
      if (f < s.p->least) s.scale.segment(at, lags).setZero();
    }
    s.own(k) = instruments_of(s, k) == 0.0;
  }
}

struct fit_t {
  MatrixXd inverse; // (Xhat' X)^-1
  VectorXd b;
};

bool fit(const stage_t &s, const MatrixXd &G, fit_t &f) {
  const int n = s.p->n;
  const MatrixXd Pt = s.P.transpose();
  if (!dense_invert(dense_product(Pt, G.leftCols(n)), f.inverse)) return false;
  f.b = dense_apply(f.inverse, dense_apply(Pt, G.col(s.size - 1)));
  return f.b.allFinite();
}

// The coefficients without one block.
VectorXd without(const stage_t &s, const MatrixXd &G, const fit_t &f, const MatrixXd &block) {
  const MatrixXd Pt = s.P.transpose(), left = G - block;
  MatrixXd inverse;
  if (dense_invert(dense_product(Pt, left.leftCols(s.p->n)), inverse))
    return dense_apply(inverse, dense_apply(Pt, left.col(s.size - 1)));
  const VectorXd own = block.col(s.size - 1) - dense_apply(block.leftCols(s.p->n), f.b);
  return f.b - dense_apply(f.inverse, dense_apply(Pt, own));
}

// Drops the instruments of regressors whose F is too small, the weakest first: without them the others may be
// strong.
bool settle(stage_t &s, const MatrixXd &G, double *F, double *blocks, fit_t &f) {
  for (;;) {
    project(s, G);
    int weakest = -1;
    if (!fit(s, G, f)) {
      if (s.own.all()) return false;
      s.own.setConstant(true);
      continue;
    }
    for (int k = 0; k < s.p->n; k++) {
      if (s.own(k)) continue;
      F[k] = strength(s, k, dense_apply(s.P, f.inverse.row(k)), instruments_of(s, k), &blocks[k]);
      if (F[k] < s.p->least && (weakest < 0 || F[k] < F[weakest])) weakest = k;
    }
    if (weakest < 0) return true;
    s.own(weakest) = true;
  }
}

VectorXd scale_of(const double *total, int size) {
  VectorXd scale = VectorXd::Zero(size);
  for (int i = 0; i < size; i++) {
    const double square = total[i * (size + 1)];
    scale(i) = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
  }
  return scale;
}

// Converts the regressors' coefficients to their own units.
VectorXd unit_of(const stage_t &s) {
  return s.scale.head(s.p->n) / s.scale(s.size - 1);
}

// Jackknife covariances over the blocks, in the regressors' units: of the coefficients of `two`, and of their
// difference from those of `one`.
void spreads(const stage_t &two, const fit_t &iv, const stage_t &one, const fit_t &ls, MatrixXd &spread,
             MatrixXd &apart) {
  const int n = two.p->n;
  const MatrixXd G = products(two, two.p->total), H = products(one, one.p->total);
  const VectorXd own = unit_of(two), other = unit_of(one);
  double used = 0.0;
  spread = apart = MatrixXd::Zero(n, n);
  for (int i = 0; i < two.p->n_block; i++) {
    const MatrixXd g = products(two, two.p->block + (ptrdiff_t)i * two.size * two.size),
                   h = products(one, one.p->block + (ptrdiff_t)i * one.size * one.size);
    if (!(g(two.size - 1, two.size - 1) > 0.0)) continue;
    const VectorXd u = (without(two, G, iv, g) - iv.b).cwiseProduct(own),
                   d = u - (without(one, H, ls, h) - ls.b).cwiseProduct(other);
    spread += dense_product(u, u.transpose());
    apart += dense_product(d, d.transpose());
    used += 1.0;
  }
  spread *= (used - 1.0) / std::fmax(used, 1.0);
  apart *= (used - 1.0) / std::fmax(used, 1.0);
}

bool moves(const stage_t &s) {
  return s.scale.head(s.p->n).minCoeff() > 0.0 && s.scale(s.size - 1) > 0.0;
}

} // namespace

bool lsq_instrument(const lsq_instrument_t *p, const lsq_instrumented_t *out) {
  using marks_t = Eigen::Array<bool, Eigen::Dynamic, 1>;
  const int n = p->n, size = n + n * p->sets * p->lags + 1;
  lsq_instrument_t plain = *p;
  if (p->plain_total)
    plain = {p->plain_total, p->plain_block, p->n_block, n, 0, 0, p->least, nullptr, nullptr};
  stage_t two = {p, size, scale_of(p->total, size), {}, marks_t::Constant(n, false)};
  stage_t one = {&plain, 0, {}, {}, marks_t::Constant(n, true)};
  one.size = n + n * plain.sets * plain.lags + 1;
  one.scale = scale_of(plain.total, one.size);
  if (n == 0 || !moves(two) || !moves(one)) return false;
  choose(two, out->F);
  fit_t ls, iv;
  const MatrixXd G = products(one, plain.total);
  project(one, G);
  if (!fit(one, G, ls) || !settle(two, products(two, p->total), out->F, out->blocks, iv)) return false;
  MatrixXd spread, differ;
  spreads(two, iv, one, ls, spread, differ);
  Eigen::Map<VectorXd>(out->b, n) = iv.b.cwiseProduct(unit_of(two));
  Eigen::Map<VectorXd>(out->plain, n) = ls.b.cwiseProduct(unit_of(one));
  out_t(out->V, n, n) = spread;
  out_t(out->apart, n, n) = differ;
  return true;
}
