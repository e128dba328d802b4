// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/singularity_watch.h"

#include <algorithm>
#include <cmath>

#include "assembly/determined_motion.h"
#include "equations/compiled_system.h"
#include "math/dense.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kPeak = 8.0;  // a peak must exceed this multiple of the mean drift
// A position is singular below this fraction of the typical stiffness. The compliance of redundant
// constraints leaves 2e-4 there.
constexpr double kSingular = 2e-3;
// The same for a run that restarts often, whose steps do not reach over the position.
constexpr double kBeside = 0.05;
// Upper limit of the mean drift in the test for a peak, since idas restarts before larger drifts.
constexpr double kLarge = 4.0;
constexpr double kRank = 3e-4;  // smaller singular values, relative to the largest, count as zero
constexpr double kLeastDrift = 1e-12;  // smaller drifts count as this in the geometric mean
constexpr int kIterations = 40;        // of the golden-section search, a factor 0.618 each
constexpr int kLargestRanked = 400;    // the rank is computed up to this number of coordinates

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

// k of (17b): 1/|delta q| of the projection (17) for a fixed right-hand side without any pattern.
double SingularityWatch::stiffness(Equations<double>* equations) {
  const Layout& layout = system_.layout();
  if (!matrix_) matrix_ = std::make_unique<IterationMatrix>(system_);
  equations->linearize_rates(between_, &derivatives_);
  if (!matrix_->factor(derivatives_, 0.0, 0.0, 0.0)) return 0.0;
  response_.setZero(layout.columns());
  for (int row = 0; row < layout.m; ++row) response_[layout.n + row] = std::sin(1.0 + 7.0 * row);
  matrix_->lu().solve(response_);
  return 1.0 / response_.head(layout.n).norm();
}

bool SingularityWatch::is_peak() const {
  const double mean = std::exp(sum_of_logarithms_ / count_);
  return points_[1].drift > points_[0].drift && points_[1].drift >= points_[2].drift &&
         points_[1].drift > threshold_ * std::min(mean, kLarge);
}

void SingularityWatch::look(const State<double>& state, double drift,
                            Equations<double>* equations) {
  if (!enabled_) return;
  std::rotate(points_.begin(), points_.begin() + 1, points_.end());
  points_[2].drift = drift;
  points_[2].state = state;
  sum_of_logarithms_ += std::log(std::max(drift, kLeastDrift));
  if (++count_ > 3 && is_peak()) search(equations);
}

/// Sets between_ to the Hermite cubic, through positions and velocities at the ends of the step
/// around `time`.
void SingularityWatch::place(double time) {
  const bool second = time > points_[1].state.t;
  const State<double>&from = points_[second ? 1 : 0].state, &to = points_[second ? 2 : 1].state;
  const double h = to.t - from.t, x = (time - from.t) / h, y = 1.0 - x;
  between_.t = time;
  between_.turns = from.turns;
  between_.q = y * y * (1.0 + 2.0 * x) * from.q + x * x * (1.0 + 2.0 * y) * to.q +
               h * x * y * (y * from.v - x * to.v);
  between_.v = y * from.v + x * to.v;
  between_.s = y * from.s + x * to.s;
  between_.z = y * from.z + x * to.z;
}

int SingularityWatch::rank(Equations<double>* equations, const State<double>& state) const {
  return static_cast<int>(
      pivot_columns(constraint_jacobian(system_, equations, state), kRank).rank);
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
  double left = b - kGolden * (b - a), right = a + kGolden * (b - a), at_left = at(left),
         at_right = at(right);
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
  // A run that restarts often has steps too short to bracket the position, so a weaker limit
  // applies.
  const bool restarts = points_[1].drift <= threshold_ * std::exp(sum_of_logarithms_ / count_);
  if (std::min(at_left, at_right) > (restarts ? kBeside : kSingular) * typical_stiffness_) {
    threshold_ *= restarts ? 1.2 : 2.0;  // so that fruitless searches become rare
    return;
  }
  place(0.5 * (a + b));
  std::string how = ", where its constraints come close to losing rank";
  if (system_.layout().n <= kLargestRanked) {
    // Beside the position, rather than on it, the smallest singular value may be above the
    // tolerance of the rank.
    const int here = rank(equations, between_), usual = rank(equations, initial_);
    if (here < usual)
      how = ", where its constraints have rank " + std::to_string(here) + " instead of " +
            std::to_string(usual);
  }
  warnings_.push_back({"singular_position_passed",
                       "the mechanism passes a singular position at t = " +
                           to_decimal(std::round(1e6 * between_.t) / 1e6) + " s" + how +
                           ": sensitivities lose digits there, whatever the tolerance. Compare the "
                           "gradient with differences (codesign gradient "
                           "--verify=ridders), or end the study before that time",
                       {}});
  enabled_ = false;
}

}  // namespace codesign
