// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/expression_watch.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "math/arrays.h"

namespace codesign {
namespace {

/// The weights of the quadrature on [0, 1] that is exact for polynomials through all nodes.
Eigen::VectorXd quadrature(const std::vector<double>& nodes) {
  const auto count = to_signed(nodes.size());
  Eigen::MatrixXd powers(count, count);
  Eigen::VectorXd integrals(count);
  for (Eigen::Index power = 0; power < count; ++power) {
    integrals[power] = 1.0 / static_cast<double>(power + 1);
    for (Eigen::Index k = 0; k < count; ++k)
      powers(power, k) = std::pow(nodes[to_index(k)], static_cast<double>(power));
  }
  return powers.partialPivLu().solve(integrals);
}

}  // namespace

void ExpressionWatch::start(const State<double>& initial, Equations<double>* equations) {
  equations->compiled().expressions(initial, &values_);
  // Expressions that are constant in this mode may vary in another one.
  is_active_ = values_.size() > 1 || system_.has_switches();
}

void ExpressionWatch::use(const RosenbrockTableau& tableau) {
  if (tableau_ == &tableau) return;
  tableau_ = &tableau;
  nodes_.assign(tableau.alpha.begin(), tableau.alpha.begin() + tableau.stages);
  std::sort(nodes_.begin(), nodes_.end());
  const auto same = [](double a, double b) { return b - a < 1e-3; };
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end(), same), nodes_.end());
  weights_ = quadrature(nodes_);
}

bool ExpressionWatch::evaluate(OneStep<double>* step) {
  const auto at = [&](double theta) {
    step->interpolate_attempt(theta, &point_);
    step->equations().compiled().expressions(point_, &values_);
    return values_.size() == count_;
  };
  at(0.0);
  count_ = values_.size();
  if (count_ <= 1) return false;
  const double share = step->step_size() / system_.study().duration;
  intervals_ = 2 * std::clamp(static_cast<int>(0.5 * kPerStudy * share) + 1, kLeast / 2, kPerStudy);
  if (samples_.rows() != count_ || samples_.cols() <= intervals_)
    samples_.resize(count_, std::max<Eigen::Index>(samples_.cols(), intervals_ + 1));
  at_nodes_.resize(count_, to_signed(nodes_.size()));
  for (int k = 0; k <= intervals_; ++k) {
    if (!at(static_cast<double>(k) / intervals_)) return false;
    samples_.col(k) = values_;
  }
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (!at(nodes_[k])) return false;
    at_nodes_.col(to_signed(k)) = values_;
  }
  return true;
}

double ExpressionWatch::simpson(Eigen::Index expression) const {
  double sum = samples_(expression, 0) + samples_(expression, intervals_);
  for (int k = 1; k < intervals_; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * samples_(expression, k);
  return sum / (3.0 * intervals_);
}

// How much a unit of the expression changes the rates follows from the point at which it is
// farthest from what the step knows: there the rates are solved for and compared with the dense
// output.
double ExpressionWatch::largest_effect(Eigen::Index expression, double missed,
                                       const SolverOptions& options, OneStep<double>* step,
                                       Assembly* assembly) {
  int farthest = 0;
  double deviation = 0.0;
  for (int k = 1; k < intervals_; ++k) {
    const double place = static_cast<double>(k) / intervals_;
    const auto next = std::upper_bound(nodes_.begin(), nodes_.end() - 1, place);
    const auto right = next - nodes_.begin();
    const double a = nodes_[to_index(right - 1)], b = nodes_[to_index(right)],
                 share = (place - a) / (b - a);
    const double known =
        (1.0 - share) * at_nodes_(expression, right - 1) + share * at_nodes_(expression, right);
    const double here = std::abs(samples_(expression, k) - known);
    if (here > deviation) farthest = k, deviation = here;
  }
  if (!(deviation > 0.0)) return 0.0;
  step->interpolate_attempt(static_cast<double>(farthest) / intervals_, &point_);
  solved_ = point_;
  if (!assembly->rates().solve(&step->equations(), &solved_).ok()) return 0.0;
  const Layout& layout = system_.layout();
  double largest = 0.0;
  const auto look = [&](Eigen::Index rate, double size) {
    const double response = std::abs(solved_.z[rate] - point_.z[rate]) / deviation;
    largest =
        std::max(largest, response * missed /
                              (options.absolute_tolerance + options.relative_tolerance * size));
  };
  for (int k = 0; k < layout.n; ++k)
    look(k, std::max(std::abs(step->state().v[k]), std::abs(step->unprojected().v[k])));
  for (int k = 0; k < layout.states; ++k)
    look(layout.state_column(k),
         std::max(std::abs(step->state().s[k]), std::abs(step->unprojected().s[k])));
  return largest;
}

// Relative to each entry of z at both ends and in the middle, and to a millionth of the largest.
double ExpressionWatch::rates_error(OneStep<double>* step, Assembly* assembly) {
  // Near a singular position z grows without bound: there the steps become no shorter for it.
  constexpr double kAllowed = 1e-3, kLeastShare = 1e-6, kShortest = 1e-4;
  if (step->step_size() < kShortest * system_.study().duration) return 0.0;
  step->interpolate_attempt(0.5, &point_);
  solved_ = point_;
  if (!assembly->rates().solve(&step->equations(), &solved_).ok()) return 0.0;
  const Eigen::ArrayXd sizes =
      solved_.z.array().abs() + step->state().z.array().abs() + step->unprojected().z.array().abs();
  if (sizes.size() == 0 || !(sizes.maxCoeff() > 0.0)) return 0.0;
  const Eigen::ArrayXd errors = (solved_.z - point_.z).array().abs();
  return (errors / sizes.max(kLeastShare * sizes.maxCoeff())).maxCoeff() / kAllowed;
}

double ExpressionWatch::error(const SolverOptions& options, OneStep<double>* step,
                              Assembly* assembly) {
  // Differences that the error of the step itself can have are not what was passed over.
  constexpr double kOwnError = 10.0, kRounding = 1e-12;
  double largest = system_.study().motion.empty() ? 0.0 : rates_error(step, assembly);
  if (!is_active_ || largest > 1.0) return largest;
  use(step->tableau());
  if (!evaluate(step)) return largest;
  const double h = step->step_size();
  double missed_most = 0.0;
  for (Eigen::Index e = 0; e < count_; ++e) {
    const double missed = h * std::abs(simpson(e) - at_nodes_.row(e).dot(weights_));
    if (!std::isfinite(missed) ||
        missed <= kRounding * h * samples_.row(e).head(intervals_ + 1).cwiseAbs().maxCoeff())
      continue;
    const bool is_integrand = e + 1 == count_;
    missed_most = std::max(
        missed_most, is_integrand ? missed / (options.absolute_tolerance +
                                              options.relative_tolerance * std::abs(step->psi()))
                                  : largest_effect(e, missed, options, step, assembly));
  }
  return std::max(largest, missed_most / kOwnError);
}

}  // namespace codesign
