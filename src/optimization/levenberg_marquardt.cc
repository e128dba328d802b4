// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "math/arrays.h"
#include "optimization/bounded_step.h"

namespace codesign {
namespace {

using Outcome = LeastSquaresModel::Outcome;

// Of the predicted decrease: a step that gains less is rejected.
constexpr double kLeastGain = 1e-4;
constexpr double kPoorGain = 0.25,
                 kGoodGain = 0.75;  // the radius shrinks below the first and grows above the second
constexpr double kUnusable = 0.25;  // factor of the radius after a point without a value
constexpr double kLeastScale = 1e-8;  // relative to the largest entry of D
constexpr double kEpsilon = std::numeric_limits<double>::epsilon(),
                 kRoundingOfVariables = 4.0 * kEpsilon;

/// One search: the radius, the scales, and the best point so far.
class SquaresSearch {
 public:
  SquaresSearch(const LevenbergMarquardtOptions& options, const Eigen::VectorXd& lower,
                const Eigen::VectorXd& upper, LeastSquaresModel* model, Eigen::VectorXd* x,
                LeastSquaresPoint* best)
      : options_(options), lower_(lower), upper_(upper), model_(*model), x_(*x), best_(*best) {}

  LevenbergMarquardtEnd run() {
    const Outcome first = model_.evaluate(x_, &best_);
    if (first != Outcome::kUsable)
      return first == Outcome::kStop ? LevenbergMarquardtEnd::kStopped
                                     : LevenbergMarquardtEnd::kStartFailed;
    norms_ = best_.root.colwise().norm().transpose();
    std::optional<LevenbergMarquardtEnd> end;
    while (!end) end = take_step();
    return *end;
  }

 private:
  /// D: the largest norms so far. A variable without influence gets a scale, too.
  Eigen::VectorXd scale() const {
    const double largest = norms_.size() > 0 ? norms_.maxCoeff() : 0.0;
    return norms_.cwiseMax(largest > 0.0 ? kLeastScale * largest : 1.0);
  }

  /// The first radius lets no variable change by more than the option says.
  void choose_radius(const BoundedStep& step) {
    const Eigen::VectorXd p = step.within(std::numeric_limits<double>::infinity());
    radius_ = step.length(p);
    const double largest = p.cwiseAbs().maxCoeff();
    if (largest > options_.largest_first_step) radius_ *= options_.largest_first_step / largest;
  }

  /// One trial point; the reason to end, or nothing.
  std::optional<LevenbergMarquardtEnd> take_step() {
    if (x_.size() == 0) return LevenbergMarquardtEnd::kOptimum;
    const Eigen::VectorXd down = lower_ - x_, up = upper_ - x_;
    const BoundedStep step(best_.gradient, best_.root, scale(), down, up);
    if (evaluations_ == 1) {
      choose_radius(step);
      first_value_ = best_.value;
    }
    const Eigen::VectorXd p = step.within(radius_);
    const double predicted_decrease = step.predicted_decrease(p) + best_.inner_decrease;
    // A sum of squares that tends to zero has no relative accuracy: below the rounding error of its
    // first value nothing is left to gain.
    if (!(predicted_decrease > kEpsilon * std::max(best_.value, first_value_)))
      return LevenbergMarquardtEnd::kOptimum;
    const bool stays = (p.array().abs() <= kRoundingOfVariables * x_.array().abs()).all();
    if (stays && best_.inner_decrease <= options_.relative_tolerance * best_.value)
      return LevenbergMarquardtEnd::kVariableTolerance;
    if (evaluations_ >= options_.max_evaluations) return LevenbergMarquardtEnd::kMaxEvaluations;
    Eigen::VectorXd trial = x_ + p;
    for (Eigen::Index k = 0; k < trial.size(); ++k) {
      if (p[k] == down[k]) trial[k] = lower_[k];
      if (p[k] == up[k]) trial[k] = upper_[k];
    }
    ++evaluations_;
    const Outcome outcome = model_.evaluate(trial, &tried_);
    if (outcome == Outcome::kStop) return LevenbergMarquardtEnd::kStopped;
    const double before = best_.value;
    std::optional<LevenbergMarquardtEnd> end;
    if (outcome == Outcome::kUsable)
      end = judge(step, p, predicted_decrease, trial);
    else
      radius_ = kUnusable * step.length(p);
    // A predicted decrease of the model's own unknowns that was not kept although x stayed does not
    // count again.
    if (stays && !(best_.value < before)) best_.inner_decrease = 0.0;
    return end;
  }

  /// Compares the gain of the step with its predicted decrease.
  std::optional<LevenbergMarquardtEnd> judge(const BoundedStep& step, const Eigen::VectorXd& p,
                                             double predicted_decrease,
                                             const Eigen::VectorXd& trial) {
    const double gain = best_.value - tried_.value, ratio = gain / predicted_decrease,
                 length = step.length(p);
    const double small = options_.relative_tolerance * best_.value;
    const bool is_limited = length >= 0.9 * radius_;
    if (ratio < kPoorGain) {
      // The minimum along p of the parabola through both values and the slope.
      const double slope = step.slope(p) - 2.0 * best_.inner_decrease,
                   parabola = slope / (2.0 * (slope + gain));
      radius_ = std::min(0.5, std::max(0.1, slope + gain < 0.0 ? parabola : 0.5)) * length;
    } else if (ratio > kGoodGain) {
      radius_ = std::max(radius_, 2.0 * length);
    }
    // If the model is right and only the radius limits the step, the next step gains more.
    const bool holds_back = is_limited && ratio > kGoodGain;
    const bool has_converged =
        std::abs(gain) <= small && predicted_decrease <= small && ratio <= 2.0 && !holds_back;
    if (ratio > kLeastGain) {
      x_ = trial;
      std::swap(best_, tried_);
      norms_ = norms_.cwiseMax(best_.root.colwise().norm().transpose());
    }
    return has_converged ? std::optional(LevenbergMarquardtEnd::kValueTolerance) : std::nullopt;
  }

  const LevenbergMarquardtOptions& options_;
  const Eigen::VectorXd &lower_, &upper_;
  LeastSquaresModel& model_;
  Eigen::VectorXd& x_;
  LeastSquaresPoint& best_;
  LeastSquaresPoint tried_;
  Eigen::VectorXd norms_;  ///< largest norms of the columns of R so far
  double radius_ = 0.0;    ///< Delta
  double first_value_ = 0.0;
  int evaluations_ = 1;
};

/// The objective of an ensemble by the scaled variables of (24).
class EnsembleSquares final : public LeastSquaresModel {
 public:
  EnsembleSquares(SearchTrials* trials, const Scaling& scaling)
      : trials_(*trials), scaling_(scaling) {}

  Outcome evaluate(const Eigen::VectorXd& x, LeastSquaresPoint* point) override {
    const Eigen::VectorXd rho = scaling_.from_scaled({x.begin(), x.end()});
    const bool is_known = trials_.last_rho().size() == rho.size() && trials_.last_rho() == rho &&
                          trials_.last().total.status.ok() &&
                          trials_.last().total.jacobian_root.size() > 0;
    if (!is_known && !trials_.evaluate(rho, Derivatives::kGaussNewton)) return Outcome::kStop;
    const Evaluation& evaluation = trials_.last().total;
    if (!evaluation.status.ok()) return Outcome::kFailed;
    const std::vector<double> gradient = scaling_.scale_gradient(evaluation.gradient);
    point->value = evaluation.objective;
    point->gradient = Eigen::Map<const Eigen::VectorXd>(gradient.data(), x.size());
    point->root = evaluation.jacobian_root;
    for (Eigen::Index k = 0; k < x.size(); ++k) point->root.col(k) *= scaling_.range(to_index(k));
    return Outcome::kUsable;
  }

 private:
  SearchTrials& trials_;
  const Scaling& scaling_;
};

Eigen::VectorXd as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), to_signed(numbers.size()));
}

}  // namespace

const char* name_of(LevenbergMarquardtEnd end) {
  switch (end) {
    case LevenbergMarquardtEnd::kOptimum:
      return "success";
    case LevenbergMarquardtEnd::kValueTolerance:
      return "objective_tolerance_reached";
    case LevenbergMarquardtEnd::kVariableTolerance:
      return "parameter_tolerance_reached";
    case LevenbergMarquardtEnd::kMaxEvaluations:
      return "max_evaluations_reached";
    case LevenbergMarquardtEnd::kStartFailed:
      return "start_failed";
    case LevenbergMarquardtEnd::kStopped:
      return "cancelled";
  }
  return "";
}

LevenbergMarquardtEnd minimize_squares(const LevenbergMarquardtOptions& options,
                                       const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                       LeastSquaresModel* model, Eigen::VectorXd* x,
                                       LeastSquaresPoint* best) {
  return SquaresSearch(options, lower, upper, model, x, best).run();
}

void search_squares(const OptimizerOptions& options, const Eigen::VectorXd& start,
                    const Scaling& scaling, SearchTrials* trials) {
  EnsembleSquares squares(trials, scaling);
  const Eigen::VectorXd lower = as_vector(scaling.lower()), upper = as_vector(scaling.upper());
  Eigen::VectorXd x = as_vector(scaling.to_scaled(start)).cwiseMax(lower).cwiseMin(upper);
  LeastSquaresPoint best;
  LevenbergMarquardtOptions search;
  search.max_evaluations = options.max_evaluations - trials->result().cost.evaluations;
  search.relative_tolerance = options.relative_tolerance;
  trials->result().termination =
      name_of(minimize_squares(search, lower, upper, &squares, &x, &best));
}

}  // namespace codesign
