// bound.cpp - the least height error that any linear controller could have.
#include "flight/bound.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr double STEP_S = 1e-3;
constexpr int CYCLE = BOUND_CYCLE_MS;
constexpr double SPREAD = 3.0; // this many sd of the command fit into what the motors have left
constexpr int STATES = 4;      // z, v, a, d

using Eigen::MatrixXd;
using square = Eigen::Matrix<double, STATES, STATES>;
using column = Eigen::Matrix<double, STATES, 1>;

// exp(A) of a small A.
MatrixXd exponential(const MatrixXd &A) {
  MatrixXd sum = MatrixXd::Identity(A.rows(), A.cols()), term = sum;
  for (int i = 1; i < 20; i++) sum += term = term * A / i;
  return sum;
}

// One step: x' = F x + G u + noise of covariance W.
struct plant {
  square F, W;
  column G;
};

plant discrete(const bound_plant_t &p) {
  const bound_force_t &f = p.force;
  const bool gusts = f.gust_mps2 > 0.0;
  square A = square::Zero();
  A(0, 1) = 1.0;
  A.row(1) << p.stiffness_per_s2, 0.0, 1.0, 1.0;
  A(2, 2) = -1.0 / p.tau_s;
  A(3, 3) = gusts ? -1.0 / f.gust_tau_s : 0.0;
  const double density = gusts ? 2.0 * f.gust_mps2 * f.gust_mps2 / f.gust_tau_s : f.walk_mps2 * f.walk_mps2;
  // Van Loan 1978: noise and input over a step by one exponential each.
  MatrixXd noise = MatrixXd::Zero(2 * STATES, 2 * STATES), input = MatrixXd::Zero(STATES + 1, STATES + 1);
  noise.topLeftCorner(STATES, STATES) = -A;
  noise(3, STATES + 3) = density;
  noise.bottomRightCorner(STATES, STATES) = A.transpose();
  input.topLeftCorner(STATES, STATES) = A;
  input(2, STATES) = 1.0 / p.tau_s;
  const MatrixXd over = exponential(STEP_S * noise), of = exponential(STEP_S * input);
  plant d;
  d.F = of.topLeftCorner(STATES, STATES);
  d.W = d.F * over.topRightCorner(STATES, STATES);
  d.G = of.topRightCorner(STATES, 1);
  return d;
}

// --- the filter -------------------------------------------------------------------------------------------

// Updates P by a measurement of h x with this sd.
void take(square &P, const Eigen::Matrix<double, 1, STATES> &h, double sd) {
  if (!std::isfinite(sd)) return;
  const column Ph = P * h.transpose();
  const double spread = (h * Ph).value() + sd * sd;
  if (!(spread > 0.0)) return; // known, and measured without error
  P -= Ph * Ph.transpose() / spread;
  P = 0.5 * (P + P.transpose()).eval();
}

class knowledge {
public:
  knowledge(const bound_plant_t &plant_, const plant &d_) : p(plant_), d(d_) {
    force << p.stiffness_per_s2, 0.0, 1.0, 1.0;
    height << 1.0, 0.0, 0.0, 0.0;
  }

  // Returns the covariance of the state at each ms of the cycle, given all samples that have arrived by then.
  std::array<square, CYCLE + 1> over_cycle() const {
    const std::array<square, CYCLE> settled = at_once();
    std::array<square, CYCLE + 1> known;
    for (int t = 0; t <= CYCLE; t++) {
      const int from = t + CYCLE - std::max(p.down.age_ms, p.up.age_ms); // up to it all samples are known
      square P = settled[static_cast<size_t>(from % CYCLE)];
      for (int s = from + 1; s <= t + CYCLE; s++) {
        P = d.F * P * d.F.transpose() + d.W;
        measure(P, s, t + CYCLE);
      }
      known[static_cast<size_t>(t)] = P;
    }
    return known;
  }

private:
  const bound_plant_t &p;
  const plant &d;
  Eigen::Matrix<double, 1, STATES> force, height;

  // Takes what was measured in millisecond s and has arrived by the millisecond `now`.
  void measure(square &P, int s, int now) const {
    take(P, force, p.acc_mps2);
    for (const bound_range_t &r : {p.down, p.up})
      if (s % r.period_ms == 0 && s + r.age_ms <= now) take(P, height, r.sd_m);
  }

  // Returns the same if every sample arrived at once, when the cycle has settled.
  std::array<square, CYCLE> at_once() const {
    const double d_mps2 = p.force.gust_mps2 > 0.0 ? p.force.gust_mps2 : p.force.walk_mps2;
    square P = square::Zero();
    P.diagonal() << 1e-2, 1e-2, 0.0, d_mps2 * d_mps2; // thrust follows from the commands
    std::array<square, CYCLE> settled;
    for (int cycle = 0; cycle < 1000; cycle++)
      for (int t = 0; t < CYCLE; t++) {
        measure(P, t, t + CYCLE);
        settled[static_cast<size_t>(t)] = P;
        P = d.F * P * d.F.transpose() + d.W;
      }
    return settled;
  }
};

// --- the feedback -----------------------------------------------------------------------------------------

// Returns the matrix of the least sum of x^T Q x + weight u^2 along x[t+1] = A x[t] + B u[t], by doubling.
MatrixXd cost_to_go(MatrixXd A, const MatrixXd &B, const MatrixXd &Q, double weight) {
  const auto one = MatrixXd::Identity(A.rows(), A.cols());
  MatrixXd G = B * B.transpose() / weight, H = Q;
  for (int i = 0; i < 60; i++) {
    const Eigen::PartialPivLU<MatrixXd> solve(one + G * H);
    const MatrixXd left = solve.solve(A), more = A.transpose() * H * left;
    G += A * solve.solve(G * A.transpose());
    H += more;
    A = (A * left).eval();
    H = 0.5 * (H + H.transpose()).eval();
    if (more.cwiseAbs().maxCoeff() < 1e-13 * H.cwiseAbs().maxCoeff()) break;
  }
  return H;
}

// Returns the matrix of the sum of x^T Q x along x[t+1] = C x[t].
MatrixXd sum_along(MatrixXd C, MatrixXd Q) {
  for (int i = 0; i < 40; i++) {
    const MatrixXd more = C.transpose() * Q * C;
    Q += more;
    C = (C * C).eval();
    if (more.cwiseAbs().maxCoeff() < 1e-14 * Q.cwiseAbs().maxCoeff()) break;
  }
  return Q;
}

// The state with the commands still under way. The input is the command without what cancels the force.
struct loop {
  MatrixXd A, B;
};

loop with_delay(const bound_plant_t &p, const plant &d) {
  const int late = static_cast<int>(std::lround(p.delay_s / STEP_S)), n = STATES + late;
  loop l = {MatrixXd::Zero(n, n), MatrixXd::Zero(n, 1)};
  l.A.topLeftCorner(STATES, STATES) = d.F;
  if (late == 0) {
    l.B.topRows(STATES) = d.G;
  } else {
    l.A.block(0, n - 1, STATES, 1) = d.G;
    for (int i = 1; i < late; i++) l.A(STATES + i, STATES + i - 1) = 1.0;
    l.B(STATES, 0) = 1.0;
  }
  l.A.col(3) -= l.B; // u = input - d
  return l;
}

using cycle_t = std::array<square, CYCLE + 1>;

// Returns the mean of x^T M x of the estimated state. sum: sum_along() of M, which each innovation adds.
double mean_of(const MatrixXd &sum, const plant &d, const cycle_t &known) {
  double mean = 0.0;
  for (size_t t = 0; t < CYCLE; t++) {
    const square surprise = d.F * known[t] * d.F.transpose() + d.W - known[t + 1];
    mean += (sum.topLeftCorner(STATES, STATES) * surprise).trace() / CYCLE;
  }
  return mean;
}

bound_t with_weight(const loop &l, const plant &d, const cycle_t &known, double weight) {
  const auto n = l.A.rows();
  MatrixXd Q = MatrixXd::Zero(n, n);
  Q(0, 0) = 1.0;
  const MatrixXd S = cost_to_go(l.A, l.B, Q, weight), BS = l.B.transpose() * S;
  const MatrixXd K = BS * l.A / ((BS * l.B)(0, 0) + weight), C = l.A - l.B * K;
  double known_m2 = 0.0;
  for (size_t t = 0; t < CYCLE; t++) known_m2 += std::fmax(known[t](0, 0), 0.0) / CYCLE;
  const auto mean = [&](const MatrixXd &M) { return std::fmax(mean_of(sum_along(C, M), d, known), 0.0); };
  return {std::sqrt(mean(Q) + known_m2), std::sqrt(known_m2), std::sqrt(mean(K.transpose() * K))};
}

} // namespace

bound_t bound_of(const bound_plant_t *p) {
  const plant d = discrete(*p);
  const loop l = with_delay(*p, d);
  const cycle_t known = knowledge(*p, d).over_cycle();
  double low = std::log(1e-14), high = std::log(1e-2); // log of the weight
  for (int i = 0; i < 30; i++) {
    const double mid = 0.5 * (low + high);
    const bound_t b = with_weight(l, d, known, std::exp(mid));
    (SPREAD * b.command_mps2 > p->room_mps2 ? low : high) = mid;
  }
  return with_weight(l, d, known, std::exp(high));
}
