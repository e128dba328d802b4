// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Stationary points that are no optima, and flat directions of those that are.
#include <algorithm>
#include <cmath>
#include <vector>

#include "description/tuned_parameters.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "optimization/algorithm.h"
#include "optimization/search_results.h"
#include "optimization/search_trials.h"
#include "sensitivity/gradient_engine.h"

namespace codesign {
namespace {

// Most columns of the root, which is computed for flat directions alone where gradients go
// backward.
constexpr Eigen::Index kMostRootColumns = 40;
// The step to each side of a stationary point, in the extent of the parameter that moves most, and
// the least share of it for which bounds must leave room.
constexpr double kBeside = 1e-2, kLeastBeside = 1e-2;
// A rise counts as curvature of a valley if the other parameters leave less than this share of it.
constexpr double kTakenBack = 1e-2;

}  // namespace

/// The Gauss-Newton model at the best point, by the parameters in units of their extents.
struct SearchTrials::Side {
  Eigen::VectorXd unit;          ///< extents
  Eigen::MatrixXd root, active;  ///< as flat_directions(); empty for one parameter alone
  std::vector<bool> held;
};

bool SearchTrials::finds_lower_point() {
  if (looked_beside_ || !have_best_) return false;
  looked_beside_ = true;
  if (has_lower_along_flat()) return true;
  Side side;
  side.unit = extents();
  for (Eigen::Index k = 0; k < side.unit.size() && !interrupted(); ++k) {
    if (result_.optimality.influences[to_index(k)]) continue;
    const Beside found = look_beside(Eigen::VectorXd::Unit(side.unit.size(), k), side);
    if (found == Beside::kLower) return true;
    if (found == Beside::kChanged) result_.optimality.influences[to_index(k)] = true;
  }
  return false;
}

bool SearchTrials::has_lower_along_flat() {
  result_.optimality.flat_directions.resize(0, 0);
  const auto size = to_signed(study_.tuned.size());
  if (size < 2 || !is_sum_of_squares(study_)) return false;
  Side side;
  side.root = best_.total.jacobian_root;
  if (side.root.size() == 0) {
    // The Jacobian of so many parameters costs too much.
    if (size > kMostRootColumns && prefers_adjoint(*ensemble_.scenarios().front().system))
      return false;
    const EnsembleEvaluation again =
        ensemble_.evaluate(result_.best.rho, Derivatives::kGaussNewton, cancel_);
    result_.cost.statistics += again.total.statistics;
    if (!again.total.status.ok()) return false;
    side.root = again.total.jacobian_root;
  }
  side.unit = extents();
  side.root = side.root * side.unit.asDiagonal();
  side.active = best_optimality().active;
  for (Eigen::Index k = 0; k < size; ++k) {
    side.active.row(k) *= side.unit[k] / judged_.range(to_index(k));
    side.held.push_back(!result_.optimality.influences[to_index(k)] ||
                        std::abs(best_optimality().bounds[k]) > kLeastMultiplier * scale());
  }
  const Eigen::MatrixXd directions = flat_directions(side.root, side.active, side.held);
  std::vector<Eigen::VectorXd> flat;
  for (Eigen::Index d = 0; d < directions.cols() && !interrupted(); ++d) {
    const Beside found = look_beside(directions.col(d), side);
    if (found == Beside::kLower) return true;
    if (found == Beside::kSame) flat.push_back(directions.col(d).cwiseProduct(side.unit));
  }
  result_.optimality.flat_directions.resize(size, to_signed(flat.size()));
  for (std::size_t d = 0; d < flat.size(); ++d)
    result_.optimality.flat_directions.col(to_signed(d)) = flat[d];
  return false;
}

Eigen::VectorXd SearchTrials::extents() const {
  Eigen::VectorXd unit(to_signed(study_.tuned.size()));
  for (Eigen::Index k = 0; k < unit.size(); ++k)
    unit[k] = extent(study_.parameters[to_index(study_.tuned[to_index(k)])], result_.best.rho[k]);
  return unit;
}

/// @param direction in units of the extents, with a largest entry of 1.
SearchTrials::Beside SearchTrials::look_beside(const Eigen::VectorXd& direction, const Side& side) {
  Beside result = Beside::kSame;
  for (const double sign : {1.0, -1.0}) {
    double share = kBeside;
    for (Eigen::Index k = 0; k < direction.size(); ++k) {
      const Parameter& p = study_.parameters[to_index(study_.tuned[to_index(k)])];
      const double by = sign * direction[k] * side.unit[k],
                   room = (by > 0.0 ? p.upper : p.lower) - result_.best.rho[k];
      if (by != 0.0) share = std::min(share, room / by);
    }
    if (!(share > kLeastBeside * kBeside)) continue;
    const Eigen::VectorXd step = sign * share * direction.cwiseProduct(side.unit);
    Side other = side;
    for (std::size_t k = 0; k < other.held.size(); ++k)
      if (direction[to_signed(k)] == 1.0) other.held[k] = true;
    const Beside found = look_at(result_.best.rho + step, other, share);
    if (found == Beside::kLower) return found;
    if (found == Beside::kChanged) result = found;
  }
  return result;
}

SearchTrials::Beside SearchTrials::look_at(const Eigen::VectorXd& rho, const Side& side,
                                           double share) {
  // With the steps of a gradient, so that an objective that stays the same is the same number.
  EnsembleEvaluation there = ensemble_.evaluate(rho, Derivatives::kGradient, cancel_);
  result_.cost.statistics += there.total.statistics;
  if (!there.total.status.ok()) return Beside::kChanged;
  const double psi = result_.best.objective, stiffest = side.root.norm() * share,
               small = options_.relative_tolerance * std::abs(psi),
               of_root = kFlatShare * stiffest * stiffest;
  if (there.total.objective < psi - std::max(small, of_root) &&
      violation(there, rho) <= best_violation_ &&
      result_.cost.evaluations < options_.max_evaluations) {
    evaluate(rho, Derivatives::kGradient);
    return result_.best.rho == rho ? Beside::kLower : Beside::kChanged;
  }
  if (side.root.size() == 0) return there.total.objective == psi ? Beside::kSame : Beside::kChanged;
  // Where residuals are kinks, R is no measure of their changes.
  const double limit = std::max(
      small, std::min(of_root, options_.relative_tolerance * std::abs(result_.initial.objective)));
  const auto mean = [this](const EnsembleEvaluation& at) {
    return at.values.dot(ensemble_.weights());
  };
  const double before = mean(best_), rise = std::abs(mean(there) - before);
  if (rise <= limit) return Beside::kSame;
  // In a curved valley the other parameters take the rise back.
  there = ensemble_.evaluate(rho, Derivatives::kGaussNewton, cancel_);
  result_.cost.statistics += there.total.statistics;
  if (!there.total.status.ok()) return Beside::kChanged;
  const Eigen::VectorXd gradient =
      product(there.gradients, ensemble_.weights()).cwiseProduct(side.unit);
  const double floor =
      valley_floor(mean(there), gradient, there.total.jacobian_root * side.unit.asDiagonal(),
                   side.active, side.held);
  return std::abs(floor - before) <= std::max(limit, kTakenBack * rise) ? Beside::kSame
                                                                        : Beside::kChanged;
}

}  // namespace codesign
