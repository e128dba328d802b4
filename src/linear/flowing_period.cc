// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/flowing_period.h"

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "linear/frequency_search.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

const Complex kJ(0.0, 1.0);

MatrixXcd identity(Index size) { return MatrixXcd::Identity(size, size); }

/// A matrix and its derivative along a direction; without rows: none.
struct MovedMatrix {
  MatrixXcd value, change{};
};

/// What follows `first`, with the rule of products.
MovedMatrix after(const MovedMatrix& next, const MovedMatrix& first) {
  MovedMatrix both{product(next.value, first.value)};
  if (next.change.rows() > 0)
    both.change = product(next.change, first.value) + product(next.value, first.change);
  return both;
}

/// exp(flow time); the derivative is a block of the exponential of [flow, change; 0, flow].
MovedMatrix flown(const MovedMatrix& flow, double time) {
  const Index n = flow.value.rows();
  if (flow.change.rows() == 0) return {complex_exponential(flow.value * time)};
  MatrixXcd both = MatrixXcd::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = flow.value * time;
  both.topRightCorner(n, n) = flow.change * time;
  const MatrixXcd power = complex_exponential(both);
  return {power.topLeftCorner(n, n), power.topRightCorner(n, n)};
}

MovedMatrix over_period(const MovedMatrix& flow, std::vector<MovedMatrix> jumps,
                        const std::vector<double>& times, const std::vector<int>& order) {
  std::map<double, MovedMatrix> flows;
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    if (!(times[k] > 0.0)) continue;
    if (flows.count(times[k]) == 0) flows[times[k]] = flown(flow, times[k]);
    jumps[k] = after(flows[times[k]], jumps[k]);
  }
  return in_order(std::move(jumps), order, [](const MovedMatrix& first, const MovedMatrix& next) {
    return after(next, first);
  });
}

template <class Part>
FlowingSpace part_of_space(const ComplexSpace& space, const Part& part) {
  FlowingSpace result{
      part(space.A),     part(space.B), part(space.C), part(space.D)(0, 0), {}, {}, {},
      space.pieces.order};
  for (const PeriodPiece& piece : space.pieces.different) {
    const MatrixXcd jump = part(piece.jump);
    result.J.push_back(jump.leftCols(space.A.rows()));
    result.G.push_back(jump.rightCols(1));
    result.times.push_back(piece.time);
  }
  return result;
}

}  // namespace

FlowingSpace values_of(const ComplexSpace& space) {
  return part_of_space(
      space, [](const MatrixXcd& all) -> MatrixXcd { return all.real().cast<Complex>(); });
}

FlowingSpace changes_of(const ComplexSpace& space) {
  return part_of_space(space, [](const MatrixXcd& all) -> MatrixXcd {
    return (all.imag() / ComplexSpace::kStep).cast<Complex>();
  });
}

double FlowingSpace::period() const {
  return std::accumulate(order.begin(), order.end(), 0.0, [this](double sum, int k) {
    return sum + times[static_cast<std::size_t>(k)];
  });
}

// w = (u - C x)/(1 + D).
FlowingSpace FlowingSpace::opened() const {
  const Complex per = 1.0 / (1.0 + D);
  FlowingSpace open{A - per * product(B, C), per * B, per * C, per * D, {}, {}, times, order};
  for (std::size_t k = 0; k < J.size(); ++k) {
    open.J.emplace_back(J[k] - per * product(G[k], C));
    open.G.emplace_back(per * G[k]);
  }
  return open;
}

namespace {

/// w = K C x with K = (factor - 1)/(1 - (factor - 1) D).
struct Closing {
  Closing(const FlowingSpace& space, Complex factor)
      : per(1.0 / (1.0 - (factor - 1.0) * space.D)), K((factor - 1.0) * per) {}
  Complex per, K;
};

/// A flow and jumps, each X + K Y C with (X, Y) = (A, B) or (J, G), over a period. @param change of
/// the k-th jump, of the flow with k = -1.
template <class Change>
MovedMatrix closed_period(const FlowingSpace& space, Complex K, const Change& change) {
  std::vector<MovedMatrix> jumps;
  for (std::size_t k = 0; k < space.J.size(); ++k)
    jumps.push_back(
        {space.J[k] + K * product(space.G[k], space.C), change(static_cast<int>(k), space.G[k])});
  return over_period({space.A + K * product(space.B, space.C), change(-1, space.B)},
                     std::move(jumps), space.times, space.order);
}

}  // namespace

MatrixXcd map_with(const FlowingSpace& space, Complex factor) {
  return closed_period(space, Closing(space, factor).K,
                       [](int, const MatrixXcd&) { return MatrixXcd(); })
      .value;
}

MatrixXcd map_by_factor(const FlowingSpace& space, Complex factor) {
  const Closing by(space, factor);
  return closed_period(space, by.K,
                       [&](int, const MatrixXcd& Y) -> MatrixXcd {
                         return by.per * by.per * product(Y, space.C);
                       })
      .change;
}

// dK = K^2 dD.
MatrixXcd map_along(const FlowingSpace& space, Complex factor, const FlowingSpace& change) {
  const Complex K = Closing(space, factor).K;
  return closed_period(space, K,
                       [&](int k, const MatrixXcd& Y) -> MatrixXcd {
                         const auto place = static_cast<std::size_t>(k);
                         const MatrixXcd& dX = k < 0 ? change.A : change.J[place];
                         const MatrixXcd& dY = k < 0 ? change.B : change.G[place];
                         return dX + K * (product(dY, space.C) + product(Y, change.C)) +
                                K * K * change.D * product(Y, space.C);
                       })
      .change;
}

namespace {

/// The motion of (x, w, integral of y) in a frame that turns with w, where w is constant.
MatrixXcd turning(const MatrixXcd& A, const MatrixXcd& B, const MatrixXcd& C, Complex D) {
  const Index n = A.rows();
  MatrixXcd all = MatrixXcd::Zero(n + 2, n + 2);
  all.topLeftCorner(n, n) = A;
  all.block(0, n, n, 1) = B;
  all.block(n + 1, 0, 1, n) = C;
  all(n + 1, n) = D;
  return all;
}

MatrixXcd jumped(const MatrixXcd& J, const MatrixXcd& G, double rest) {
  const Index n = J.rows();
  MatrixXcd all = MatrixXcd::Zero(n + 2, n + 2);
  all.topLeftCorner(n, n) = J;
  all.block(0, n, n, 1) = G;
  all(n, n) = all(n + 1, n + 1) = rest;
  return all;
}

/// The part of y, where x is the same again behind the period. @param flow_change of turning().
MovedMatrix turning_part(const FlowingSpace& space, double frequency, const MatrixXcd& flow_change,
                         const FlowingSpace* change) {
  const Index n = space.A.rows();
  const bool has_change = flow_change.rows() > 0;
  std::vector<MovedMatrix> jumps;
  for (std::size_t k = 0; k < space.J.size(); ++k) {
    jumps.push_back({jumped(space.J[k], space.G[k], 1.0)});
    if (change)
      jumps.back().change = jumped(change->J[k], change->G[k], 0.0);
    else if (has_change)
      jumps.back().change = MatrixXcd::Zero(n + 2, n + 2);
  }
  const MovedMatrix all = over_period(
      {turning(space.A - kJ * frequency * identity(n), space.B, space.C, space.D), flow_change},
      std::move(jumps), space.times, space.order);
  const MatrixXcd per = identity(n) - all.value.topLeftCorner(n, n);
  const MatrixXcd x = complex_solution(per, all.value.block(0, n, n, 1));
  const double period = space.period();
  const MatrixXcd row = all.value.block(n + 1, 0, 1, n);
  MovedMatrix part{(product(row, x) + all.value.block(n + 1, n, 1, 1)) / period};
  if (!has_change) return part;
  const MatrixXcd moved = complex_solution(
      per, product(all.change.topLeftCorner(n, n), x) + all.change.block(0, n, n, 1));
  part.change = (product(all.change.block(n + 1, 0, 1, n), x) + all.change.block(n + 1, n, 1, 1) +
                 product(row, moved)) /
                period;
  return part;
}

}  // namespace

Complex part_at(const FlowingSpace& space, double frequency) {
  return turning_part(space, frequency, {}, nullptr).value(0, 0);
}

Complex part_by_frequency(const FlowingSpace& space, double frequency) {
  const Index n = space.A.rows();
  const MatrixXcd none = MatrixXcd::Zero(n, 1);
  return turning_part(space, frequency, turning(-kJ * identity(n), none, none.transpose(), 0.0),
                      nullptr)
      .change(0, 0);
}

Complex part_along(const FlowingSpace& space, double frequency, const FlowingSpace& change) {
  return turning_part(space, frequency, turning(change.A, change.B, change.C, change.D), &change)
      .change(0, 0);
}

std::vector<double> frequencies_near(const MatrixXcd& flow, double angle, double period) {
  std::vector<double> found;
  for (const Complex& own : complex_eigenvalues(flow)) {
    const double turns = std::round((own.imag() * period - angle) / (2.0 * kHalfTurn));
    for (const double m : {turns - 1.0, turns, turns + 1.0})
      found.push_back((angle + 2.0 * kHalfTurn * m) / period);
  }
  return found;
}

double largest_sinusoid(const FlowingSpace& space, Complex factor, const Eigen::VectorXcd& x,
                        double angle) {
  const Complex K = Closing(space, factor).K;
  FlowingSpace closed = space;
  const Index n = space.A.rows();
  closed.A += K * product(space.B, space.C);
  closed.B.setZero();
  closed.D = 0.0;
  std::vector<MovedMatrix> jumps;
  for (std::size_t k = 0; k < space.J.size(); ++k)
    jumps.push_back({jumped(space.J[k] + K * product(space.G[k], space.C), closed.B, 1.0)});
  double main = angle / space.period(), largest = -1.0;
  for (const double frequency : frequencies_near(closed.A, angle, space.period())) {
    const MatrixXcd flow =
        turning(closed.A - kJ * frequency * identity(n), closed.B, closed.C, 0.0);
    const MovedMatrix all = over_period({flow}, jumps, space.times, space.order);
    const MatrixXcd row = all.value.block(n + 1, 0, 1, n);
    const double part = std::abs(product(row, MatrixXcd(x))(0, 0));
    if (part <= largest * (1.0 + 1e-9)) continue;
    largest = part;
    main = frequency;
  }
  return main;
}

}  // namespace codesign
