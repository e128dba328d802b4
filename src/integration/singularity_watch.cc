// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/singularity_watch.h"

#include <algorithm>
#include <cmath>

#include "assembly/redundancy.h"
#include "math/dense.h"
#include "text/decimal.h"

namespace codesign {
namespace {

constexpr double kPeak = 8.0;          // times the mean drift, that is worth a look
constexpr double kSingular = 2e-3;     // of the typical stiffness; the compliance of redundant constraints leaves 2e-4
constexpr double kLarge = 4.0;         // times threshold_: drift after which idas begins anew, so that it has no higher peaks
constexpr double kBeside = 0.05;       // of the typical stiffness, where a run that begins anew over and over passes
constexpr double kRank = 3e-4;         // of the largest singular value
constexpr double kLeastDrift = 1e-12;  // whose logarithm counts
constexpr int kIterations = 40;        // of the search, by 0.618 each
constexpr int kLargest = 400;          // coordinates, whose rank is still decided

}  // namespace

SingularityWatch::SingularityWatch(const CompiledSystem& system) : system_(system) {
  derivatives_.resize(system.patterns());
  for (Point& point : points_) point.state.resize(system.layout());
  initial_.resize(system.layout());
  between_.resize(system.layout());
}

void SingularityWatch::start(bool enabled, const State<double>& initial) {
  enabled_ = enabled;
  warnings_.clear();
  count_ = 0;
  sum_of_logarithms_ = 0.0;
  threshold_ = kPeak;
  typical_stiffness_ = 0.0;
  if (enabled) initial_ = initial;
}

// The reciprocal of how far a unit error of the constraints, without any pattern, moves the mechanism.
double SingularityWatch::stiffness(Equations<double>* equations) {
  const Layout& layout = system_.layout();
  if (!matrix_) matrix_ = std::make_unique<IterationMatrix>(system_);
  equations->linearize(between_, &derivatives_);
  if (!matrix_->factor(derivatives_, 0.0, 0.0, 0.0)) return 0.0;
  response_.setZero(layout.columns());
  for (int row = 0; row < layout.m; ++row) response_[layout.n + row] = std::sin(1.0 + 7.0 * row);
  matrix_->lu().solve(response_.data());
  return 1.0 / response_.head(layout.n).norm();
}

bool SingularityWatch::is_peak() const {
  const double mean = std::exp(sum_of_logarithms_ / count_);
  return points_[1].drift > points_[0].drift && points_[1].drift >= points_[2].drift &&
         points_[1].drift > threshold_ * std::min(mean, kLarge);
}

void SingularityWatch::look(const State<double>& state, double drift, Equations<double>* equations) {
  if (!enabled_) return;
  std::rotate(points_.begin(), points_.begin() + 1, points_.end());
  points_[2].drift = drift;
  points_[2].state = state;
  sum_of_logarithms_ += std::log(std::max(drift, kLeastDrift));
  if (++count_ > 3 && is_peak()) search(equations);
}

/// Hermite's cubic through positions and velocities at the ends of the step around `time`.
void SingularityWatch::place(double time) {
  const bool second = time > points_[1].state.t;
  const State<double>&from = points_[second ? 1 : 0].state, &to = points_[second ? 2 : 1].state;
  const double h = to.t - from.t, x = (time - from.t) / h, y = 1.0 - x;
  between_.t = time;
  between_.q = y * y * (1.0 + 2.0 * x) * from.q + x * x * (1.0 + 2.0 * y) * to.q + h * x * y * (y * from.v - x * to.v);
  between_.v = y * from.v + x * to.v;
  between_.s = y * from.s + x * to.s;
  between_.z = y * from.z + x * to.z;
}

int SingularityWatch::rank(Equations<double>* equations, const State<double>& state) const {
  const Eigen::VectorXd values = Eigen::BDCSVD<Eigen::MatrixXd>(constraint_jacobian(system_, equations, state)).singularValues();
  return static_cast<int>((values.array() > kRank * values[0]).count());
}

void SingularityWatch::search(Equations<double>* equations) {
  if (typical_stiffness_ == 0.0) {
    between_ = initial_;
    typical_stiffness_ = stiffness(equations);
  }
  double a = points_[0].state.t, b = points_[2].state.t;
  const auto at = [&](double time) {
    place(time);
    return stiffness(equations);
  };
  typical_stiffness_ = std::max({typical_stiffness_, at(a), at(b)});
  constexpr double kGolden = 0.6180339887498949;
  double left = b - kGolden * (b - a), right = a + kGolden * (b - a), at_left = at(left), at_right = at(right);
  for (int k = 0; k < kIterations; ++k) {
    if (at_left < at_right) {
      b = right;
      right = left;
      at_right = at_left;
      at_left = at(left = b - kGolden * (b - a));
    } else {
      a = left;
      left = right;
      at_left = at_right;
      at_right = at(right = a + kGolden * (b - a));
    }
  }
  // Steps that begin anew are too short for the position to lie between two of them.
  const bool restarts = points_[1].drift <= threshold_ * std::exp(sum_of_logarithms_ / count_);
  if (std::min(at_left, at_right) > (restarts ? kBeside : kSingular) * typical_stiffness_) {
    threshold_ *= restarts ? 1.2 : 2.0;  // so that searches without result end
    return;
  }
  place(0.5 * (a + b));
  std::string ranks;
  if (system_.layout().n <= kLargest)
    ranks = ", where its constraints have rank " + std::to_string(rank(equations, between_)) + " instead of " +
            std::to_string(rank(equations, initial_));
  warnings_.push_back(
      {"singular_position_passed",
       "the mechanism passes a singular position at t = " + to_decimal(1e-6 * std::round(1e6 * between_.t)) + " s" + ranks +
           ": sensitivities of what follows lose digits there, whatever the tolerance. Compare the gradient with differences "
           "(codesign gradient --verify=ridders), or end the study before",
       {}});
  enabled_ = false;
}

}  // namespace codesign
