// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/inertia_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "identification/fit/inertia_step.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using End = LevenbergMarquardtEnd;
using Outcome = LeastSquaresModel::Outcome;

constexpr double kOptimal = 1e-9;  // of psi: a smaller predicted decrease is rounding
// Of the predicted decrease: a step that gains less is rejected.
constexpr double kLeastGain = 1e-4;
constexpr double kPoorGain = 0.25, kGoodGain = 0.75;  // the damping grows below, falls above
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-7, kMostDamping = 1e12;

/// The convex problem at a point: unknowns are symmetric_numbers(E) of the inertias, in place of
/// their ten numbers, and the other variables times the norm of their column.
struct LocalProblem {
  Eigen::VectorXd gradient, lower, upper, norms;
  Eigen::VectorXd scale;  ///< of each unknown: p over the change of the variable
  Eigen::MatrixXd root;
  std::vector<InertiaBlock> blocks;
};

/// Adds what a study states of an inertia, which is linear in E.
void add_stated(const InertiaPrior& prior, const Eigen::Matrix4d& E, Eigen::Index first_row,
                LocalProblem* local) {
  const SymmetricNumbers over = prior.stated(),
                         off = symmetric_numbers(E - Eigen::Matrix4d::Identity());
  for (std::size_t k = 0; k < prior.columns.size(); ++k) {
    const auto i = to_signed(k);
    local->gradient[prior.columns[k]] += 2.0 * over[i] * over[i] * off[i];
    local->root(first_row + i, prior.columns[k]) = over[i];
  }
}

LocalProblem local_problem(const LeastSquaresPoint& point, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                           const std::vector<InertiaPrior>& inertias) {
  LocalProblem local;
  const Eigen::Index rows = point.root.rows();
  local.gradient = point.gradient;
  local.root = Eigen::MatrixXd::Zero(rows + 10 * to_signed(inertias.size()), x.size());
  local.root.topRows(rows) = point.root;
  local.norms = local.root.colwise().norm().transpose();
  const double largest = local.norms.maxCoeff();
  local.scale = local.norms.cwiseMax(largest > 0.0 ? 1e-8 * largest : 1.0);
  for (const InertiaPrior& prior : inertias)
    for (const int column : prior.columns) local.scale[column] = 1.0;
  local.gradient = local.gradient.cwiseQuotient(local.scale);
  local.root = local.root * local.scale.cwiseInverse().asDiagonal();
  Eigen::Index row = rows;
  for (const InertiaPrior& prior : inertias) {
    const Eigen::Matrix<double, 10, 10> slopes = prior.relative.numbers_by_matrix(prior.numbers(x));
    const Eigen::MatrixXd changed =
        Eigen::MatrixXd(local.root.topRows(rows)(Eigen::all, prior.columns)) * slopes;
    const Eigen::VectorXd gradient = slopes.transpose() * local.gradient(prior.columns);
    for (std::size_t k = 0; k < prior.columns.size(); ++k) {
      local.root.col(prior.columns[k]).head(rows) = changed.col(to_signed(k));
      local.gradient[prior.columns[k]] = gradient[to_signed(k)];
    }
    local.blocks.push_back({prior.columns, prior.relative.matrix(prior.numbers(x)), prior.weight});
    add_stated(prior, local.blocks.back().matrix, row, &local);
    row += 10;
  }
  local.norms = local.root.colwise().norm().transpose();
  local.lower = (lower - x).cwiseProduct(local.scale);
  local.upper = (upper - x).cwiseProduct(local.scale);
  return local;
}

/// One search: the damping and the best point so far.
class InertiaSearch {
 public:
  InertiaSearch(const LevenbergMarquardtOptions& options, const Eigen::VectorXd& lower,
                const Eigen::VectorXd& upper, const std::vector<InertiaPrior>& inertias,
                LeastSquaresModel* model, Eigen::VectorXd* x)
      : options_(options),
        lower_(lower),
        upper_(upper),
        inertias_(inertias),
        model_(*model),
        x_(*x) {}

  End run() {
    const Outcome first = model_.evaluate(x_, &best_);
    if (first != Outcome::kUsable)
      return first == Outcome::kStop ? End::kStopped : End::kStartFailed;
    std::optional<End> end;
    while (!end) end = take_step();
    return *end;
  }

 private:
  /// Judges the best point, then tries another; the reason to end, or nothing.
  std::optional<End> take_step() {
    const LocalProblem local = local_problem(best_, x_, lower_, upper_, inertias_);
    const InertiaStep whole(local.gradient, local.root, local.blocks, local.lower, local.upper);
    const double left = whole.decrease() + best_.inner_decrease;
    if (!(left > kOptimal * best_.value)) return End::kOptimum;
    if (left <= options_.relative_tolerance * best_.value) return End::kValueTolerance;
    double predicted = left;
    Eigen::VectorXd trial = moved(local, whole);
    while (true) {
      if (evaluations_ >= options_.max_evaluations) return End::kMaxEvaluations;
      if (damping_ > 0.0) trial = damped(local, &predicted);
      if (std::optional<End> end = try_point(trial, predicted)) return end;
      if (is_accepted_) return std::nullopt;
      if (damping_ > kMostDamping) return End::kVariableTolerance;
    }
  }

  Eigen::VectorXd moved(const LocalProblem& local, const InertiaStep& step) const {
    Eigen::VectorXd trial = x_ + step.step().cwiseQuotient(local.scale);
    for (Eigen::Index k = 0; k < trial.size(); ++k) {
      if (step.step()[k] == local.lower[k]) trial[k] = lower_[k];
      if (step.step()[k] == local.upper[k]) trial[k] = upper_[k];
    }
    for (std::size_t l = 0; l < inertias_.size(); ++l)
      trial(inertias_[l].columns) = inertias_[l].relative.numbers(step.matrix(l));
    return trial;
  }

  /// The step of the same problem with |sqrt(damping) D p|^2 more, D the norms of the columns.
  Eigen::VectorXd damped(LocalProblem local, double* predicted) const {
    const Eigen::MatrixXd undamped = local.root;
    const double largest = local.norms.maxCoeff();
    local.root.conservativeResize(undamped.rows() + undamped.cols(), Eigen::NoChange);
    local.root.bottomRows(undamped.cols()) =
        (std::sqrt(damping_) * local.norms.cwiseMax(largest > 0.0 ? 1e-8 * largest : 1.0))
            .asDiagonal();
    const InertiaStep step(local.gradient, local.root, local.blocks, local.lower, local.upper);
    *predicted = step.decrease() +
                 (local.root.bottomRows(undamped.cols()) * step.step()).squaredNorm() +
                 best_.inner_decrease;
    return moved(local, step);
  }

  std::optional<End> try_point(const Eigen::VectorXd& trial, double predicted) {
    is_accepted_ = false;
    double ratio = -std::numeric_limits<double>::infinity();
    if (trial.array().isFinite().all()) {
      ++evaluations_;
      const Outcome outcome = model_.evaluate(trial, &tried_);
      if (outcome == Outcome::kStop) return End::kStopped;
      if (outcome == Outcome::kUsable) ratio = (best_.value - tried_.value) / predicted;
    }
    if (ratio < kPoorGain)
      damping_ = std::max(kFirstDamping, 10.0 * damping_);
    else if (ratio > kGoodGain)
      damping_ = damping_ > kLeastDamping ? 0.1 * damping_ : 0.0;
    is_accepted_ = ratio > kLeastGain;
    if (is_accepted_) {
      x_ = trial;
      std::swap(best_, tried_);
    }
    return std::nullopt;
  }

  const LevenbergMarquardtOptions& options_;
  const Eigen::VectorXd &lower_, &upper_;
  const std::vector<InertiaPrior>& inertias_;
  LeastSquaresModel& model_;
  Eigen::VectorXd& x_;
  LeastSquaresPoint best_, tried_;
  double damping_ = 0.0;
  bool is_accepted_ = false;
  int evaluations_ = 1;
};

}  // namespace

std::vector<InertiaPrior> unbounded_inertias(const FitPrior& prior, const Eigen::VectorXd& lower,
                                             const Eigen::VectorXd& upper) {
  std::vector<InertiaPrior> found;
  std::copy_if(
      prior.inertias.begin(), prior.inertias.end(), std::back_inserter(found),
      [&](const InertiaPrior& inertia) {
        return std::all_of(inertia.columns.begin(), inertia.columns.end(), [&](int column) {
          return std::isinf(lower[column]) && std::isinf(upper[column]) &&
                 (prior.deviations.size() == 0 || std::isinf(prior.deviations[column]));
        });
      });
  return found;
}

End minimize_with_inertias(const LevenbergMarquardtOptions& options, const Eigen::VectorXd& lower,
                           const Eigen::VectorXd& upper, const std::vector<InertiaPrior>& inertias,
                           LeastSquaresModel* model, Eigen::VectorXd* x) {
  return InertiaSearch(options, lower, upper, inertias, model, x).run();
}

}  // namespace codesign
