// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Stationary points that are no optima, and flat directions of those that are.
#include <algorithm>
#include <cmath>
#include <utility>
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
// The step to each side of a stationary point, in the size of the parameter that moves most, and
// the least share of it for which bounds must leave room. A parameter without any slope is looked
// at farther away, too.
constexpr double kBeside = 1e-2, kLeastBeside = 1e-2, kFar[] = {kBeside, 0.1, 0.3};
// A rise counts as curvature of a valley if the other parameters leave less than this share of it,
// to second order and, after a few of their steps, in fact.
constexpr double kTakenBack = 1e-2, kLeft = 1e-4;
constexpr int kValleySteps = 4;
// Objectives that differ by the noise of rounding along a direction: its share of the step, and how
// much of it counts as the same.
constexpr double kNoiseStep = 1e-5, kOfNoise = 10.0;

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
  side.unit = sizes();
  for (Eigen::Index k = 0; k < side.unit.size(); ++k)
    for (const double share : kFar) {
      if (result_.optimality.influences[to_index(k)] || interrupted()) break;
      const Eigen::VectorXd along = Eigen::VectorXd::Unit(side.unit.size(), k);
      const Beside found = look_beside(along, side, share, nullptr);
      if (found == Beside::kLower) return true;
      if (found == Beside::kChanged) result_.optimality.influences[to_index(k)] = true;
      if (found == Beside::kChanged && differs_beside_) changes_[to_index(k)] = true;
    }
  return false;
}

bool SearchTrials::has_lower_along_flat() {
  result_.optimality.flat_directions.resize(0, 0);
  result_.optimality.flat_points.resize(0, 0);
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
  side.unit = sizes();
  side.root = side.root * side.unit.asDiagonal();
  side.active = best_optimality().active;
  for (Eigen::Index k = 0; k < size; ++k) {
    side.active.row(k) *= side.unit[k] / judged_.range(to_index(k));
    side.held.push_back(!result_.optimality.influences[to_index(k)] ||
                        std::abs(best_optimality().bounds[k]) > kLeastMultiplier * scale());
  }
  const Eigen::MatrixXd directions = flat_directions(side.root, side.active, side.held);
  std::vector<Flat> flat;
  for (Eigen::Index d = 0; d < directions.cols() && !interrupted(); ++d) {
    Flat one;
    const Beside found = look_beside(directions.col(d), side, kBeside, &one);
    if (found == Beside::kLower) return true;
    if (found == Beside::kSame && one.step.size() > 0) flat.push_back(std::move(one));
  }
  result_.optimality.flat_directions.resize(size, to_signed(flat.size()));
  result_.optimality.flat_points.resize(size, to_signed(flat.size()));
  for (std::size_t d = 0; d < flat.size(); ++d) {
    result_.optimality.flat_directions.col(to_signed(d)) = flat[d].step;
    result_.optimality.flat_points.col(to_signed(d)) = flat[d].design;
  }
  return false;
}

Eigen::VectorXd SearchTrials::extents() const {
  Eigen::VectorXd unit(to_signed(study_.tuned.size()));
  for (Eigen::Index k = 0; k < unit.size(); ++k)
    unit[k] = extent(tuned_parameter(study_, k), result_.best.rho[k]);
  return unit;
}

/// The extents, but of a parameter without bounds that began at zero what its values and slopes
/// tell of its size: the start tells nothing.
Eigen::VectorXd SearchTrials::sizes() {
  Eigen::VectorXd unit = extents();
  judged_scaling();
  for (Eigen::Index k = 0; k < unit.size(); ++k) {
    const Parameter& p = tuned_parameter(study_, k);
    if (!has_range(p) && p.value == 0.0)
      unit[k] = std::min(judged_.range(to_index(k)), std::max(std::abs(result_.best.rho[k]), 1.0));
  }
  return unit;
}

/// @param direction in units of the sizes, with a largest entry of 1.
SearchTrials::Beside SearchTrials::look_beside(const Eigen::VectorXd& direction, const Side& side,
                                               double share, Flat* flat) {
  Beside result = Beside::kSame;
  for (const double sign : {1.0, -1.0}) {
    double taken = share;
    for (Eigen::Index k = 0; k < direction.size(); ++k) {
      const Parameter& p = tuned_parameter(study_, k);
      const double by = sign * direction[k] * side.unit[k],
                   room = (by > 0.0 ? p.upper : p.lower) - result_.best.rho[k];
      if (by != 0.0) taken = std::min(taken, room / by);
    }
    if (!(taken > kLeastBeside * share)) continue;
    const Eigen::VectorXd step = sign * taken * direction.cwiseProduct(side.unit);
    Side other = side;
    for (std::size_t k = 0; k < other.held.size(); ++k)
      if (direction[to_signed(k)] == 1.0) other.held[k] = true;
    const Beside found = look_at(step, other, taken, flat);
    if (found == Beside::kLower) return found;
    if (found == Beside::kChanged) result = found;
  }
  return result;
}

double SearchTrials::mean_at(const EnsembleEvaluation& at) const {
  return at.values.dot(ensemble_.weights());
}

/// By how much objectives along a step may differ and count as the same: by the tolerance of the
/// search, or by what rounding and the choice of steps make of them beside the best point, where
/// the step itself changes nothing.
double SearchTrials::same_within(const Eigen::VectorXd& step) {
  double noise = 0.0;
  for (const double share : {kNoiseStep, 2.0 * kNoiseStep}) {
    const EnsembleEvaluation there =
        ensemble_.evaluate(result_.best.rho + share * step, Derivatives::kGradient, cancel_);
    result_.cost.statistics += there.total.statistics;
    if (there.total.status.ok()) noise = std::max(noise, std::abs(mean_at(there) - mean_at(best_)));
  }
  return std::max(options_.relative_tolerance * std::abs(result_.best.objective), kOfNoise * noise);
}

SearchTrials::Beside SearchTrials::look_at(const Eigen::VectorXd& step, const Side& side,
                                           double share, Flat* flat) {
  const Eigen::VectorXd rho = result_.best.rho + step;
  // With the steps of a gradient, so that an objective that stays the same is the same number.
  const EnsembleEvaluation there = ensemble_.evaluate(rho, Derivatives::kGradient, cancel_);
  result_.cost.statistics += there.total.statistics;
  differs_beside_ = false;
  if (!there.total.status.ok()) return Beside::kChanged;
  note_slopes(there.gradients);
  const double psi = result_.best.objective, stiffest = side.root.norm() * share,
               small = options_.relative_tolerance * std::abs(psi),
               of_root =
                   std::min(kFlatShare * stiffest * stiffest,
                            options_.relative_tolerance * std::abs(result_.initial.objective));
  differs_beside_ = std::abs(there.total.objective - psi) > small;
  if (there.total.objective < psi - std::max(small, of_root) &&
      violation(there, rho) <= best_violation_ &&
      result_.cost.evaluations < options_.max_evaluations) {
    evaluate(rho, Derivatives::kGradient);
    return result_.best.rho == rho ? Beside::kLower : Beside::kChanged;
  }
  if (side.root.size() == 0) return there.total.objective == psi ? Beside::kSame : Beside::kChanged;
  if (flat->step.size() == 0) flat->step = step;
  const double rise = std::abs(mean_at(there) - mean_at(best_)),
               limit = rise <= small ? small : same_within(step);
  if (rise > limit) return look_along_valley(rho, side, rise, limit, flat);
  if (flat->design.size() == 0) flat->design = rho;
  return Beside::kSame;
}

/// In a curved valley the other parameters take the rise back, to second order and in fact.
SearchTrials::Beside SearchTrials::look_along_valley(Eigen::VectorXd rho, const Side& side,
                                                     double rise, double limit, Flat* flat) {
  const double before = mean_at(best_);
  for (int k = 0; k < kValleySteps; ++k) {
    EnsembleEvaluation there = ensemble_.evaluate(rho, Derivatives::kGaussNewton, cancel_);
    result_.cost.statistics += there.total.statistics;
    if (!there.total.status.ok()) return Beside::kChanged;
    const ValleyFloor floor = valley_floor(
        mean_at(there), product(there.gradients, ensemble_.weights()).cwiseProduct(side.unit),
        there.total.jacobian_root * side.unit.asDiagonal(), side.active, side.held);
    if (std::abs(floor.value - before) > std::max(limit, kTakenBack * rise))
      return Beside::kChanged;
    rho += floor.step.cwiseProduct(side.unit);
    for (Eigen::Index i = 0; i < rho.size(); ++i) {
      const Parameter& p = tuned_parameter(study_, i);
      rho[i] = std::min(p.upper, std::max(p.lower, rho[i]));
    }
    there = ensemble_.evaluate(rho, Derivatives::kGradient, cancel_);
    result_.cost.statistics += there.total.statistics;
    if (!there.total.status.ok()) return Beside::kChanged;
    if (mean_at(there) - before > std::max(limit, kLeft * rise)) continue;
    if (flat->design.size() == 0) flat->design = rho;
    return Beside::kSame;
  }
  return Beside::kChanged;
}

}  // namespace codesign
