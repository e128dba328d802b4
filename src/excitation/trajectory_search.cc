// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <vector>

#include "equations/equations.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"

namespace codesign {
namespace {

// Sharpness of the envelopes in the first and the second search.
constexpr double kSharpness[] = {60.0, 600.0};
// Tolerance of the criterion, which is a logarithm: this change is 5 millionths of the volume.
constexpr double kTolerance = 1e-5;
constexpr double kRowTolerance = 1e-7;
constexpr double kInside = 0.999, kFarBeyond = 3.0;  // of the limits
constexpr int kMostShrinks = 3;
// Calls by NLopt per point: SLSQP asks for the value, then for the gradient, and counts
// differently.
constexpr int kMostCalls = 3;

nlopt::algorithm method_of(TrajectorySearchMethod method) {
  switch (method) {
    case TrajectorySearchMethod::kSlsqp:
      return nlopt::LD_SLSQP;
    case TrajectorySearchMethod::kCcsaq:
      return nlopt::LD_CCSAQ;
    case TrajectorySearchMethod::kMma:
      return nlopt::LD_MMA;
  }
  return nlopt::LD_SLSQP;
}

/// The state that NLopt's callbacks share.
class TrajectorySearch {
 public:
  TrajectorySearch(const ExcitationDescription& description, int start,
                   const ExcitationObserver& observer, ExcitationProgram* program)
      : description_(description), start_(start), observer_(observer), program_(*program) {}

  TrajectorySearchResult run(const Eigen::VectorXd& x) {
    result_.x = x;
    result_.criterion = result_.initial_criterion = std::numeric_limits<double>::infinity();
    for (const double sharpness : kSharpness) {
      most_ = sharpness == kSharpness[0] ? (2 * description_.max_evaluations + 2) / 3
                                         : description_.max_evaluations;
      const int left = most_ - result_.evaluations;
      if (interrupted_ || left <= 0) break;
      program_.set_sharpness(sharpness);
      last_x_.resize(0);
      minimize(left);
    }
    return result_;
  }

 private:
  void minimize(int evaluations) {
    nlopt::opt optimizer(method_of(description_.search), static_cast<unsigned>(program_.size()));
    const Eigen::VectorXd lower = program_.space().lower(), upper = program_.space().upper();
    optimizer.set_lower_bounds({lower.begin(), lower.end()});
    optimizer.set_upper_bounds({upper.begin(), upper.end()});
    optimizer.set_min_objective(&TrajectorySearch::objective_callback, this);
    optimizer.add_inequality_mconstraint(
        &TrajectorySearch::limits_callback, this,
        std::vector<double>(to_index(program_.rows()), kRowTolerance));
    optimizer.set_ftol_abs(kTolerance);
    optimizer.set_maxeval(kMostCalls * evaluations);
    std::vector<double> x(result_.x.begin(), result_.x.end());
    double value = 0.0;
    try {
      result_.termination = termination_name(optimizer.optimize(x, value));
    } catch (const nlopt::forced_stop&) {
      result_.termination = interrupted_ ? "cancelled" : "max_evaluations_reached";
    } catch (const nlopt::roundoff_limited&) {
      result_.termination = "roundoff_limited";
    } catch (const std::exception&) {
      result_.termination = "algorithm_failed";
    }
  }

  static double objective_callback(unsigned size, const double* x, double* gradient, void* self) {
    auto& search = *static_cast<TrajectorySearch*>(self);
    search.evaluate_at(size, x, gradient != nullptr);
    if (!search.last_.status.ok()) return search.step_back(gradient);
    if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, size) = search.last_.gradient;
    return search.last_.criterion;
  }

  static void limits_callback(unsigned count, double* values, unsigned size, const double* x,
                              double* gradient, void* self) {
    auto& search = *static_cast<TrajectorySearch*>(self);
    search.evaluate_at(size, x, gradient != nullptr);
    const bool usable = search.last_.status.ok();
    Eigen::Map<Eigen::VectorXd> rows(values, count);
    if (usable)
      rows = search.last_.limits;
    else
      rows.setOnes();
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (!gradient) return;
    if (usable)
      Eigen::Map<RowMajor>(gradient, count, size) = search.last_.limits_x;
    else
      Eigen::Map<RowMajor>(gradient, count, size).setZero();
  }

  /// The value of a motion that cannot be followed: worse than all values so far, and larger with
  /// growing distance, so that a line search turns back.
  double step_back(double* gradient) const {
    const Eigen::VectorXd away = last_x_ - result_.x;
    if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, away.size()) = 2.0 * away;
    return worst_ + 1.0 + away.squaredNorm();
  }

  // Constraints are asked for after the objective, at the same point.
  void evaluate_at(unsigned size, const double* at, bool with_gradient) {
    const Eigen::Map<const Eigen::VectorXd> x(at, size);
    if (interrupted_) throw nlopt::forced_stop();
    if (last_x_.size() == x.size() && last_x_ == x && (last_has_gradient_ || !with_gradient))
      return;
    // A request for the gradient at the point of the last value does not count as another
    // evaluation.
    const bool is_new = last_x_.size() != x.size() || last_x_ != x;
    if (is_new && result_.evaluations >= most_) throw nlopt::forced_stop();
    last_x_ = x;
    last_has_gradient_ = with_gradient;
    last_ = program_.evaluate(x, with_gradient);
    if (is_new) ++result_.evaluations;
    if (is_new || last_.status.is_interrupted()) note();
  }

  void note() {
    if (last_.status.ok()) {
      worst_ = std::isfinite(worst_) ? std::max(worst_, last_.criterion) : last_.criterion;
      if (result_.evaluations == 1) result_.initial_criterion = last_.criterion;
      keep(last_x_, last_);
      keep_within_limits();
    }
    const ExcitationTrial trial{start_, result_.evaluations, last_.status, last_.criterion,
                                last_.worst};
    interrupted_ = last_.status.is_interrupted() || (observer_ && !observer_(trial));
    if (interrupted_) throw nlopt::forced_stop();
  }

  void keep(const Eigen::VectorXd& x, const ExcitationProgram::Value& value) {
    if (value.worst > 1.0 || value.criterion >= result_.criterion) return;
    result_.criterion = value.criterion;
    result_.x = x;
  }

  // With many joints a search stays outside the limits for long. With reduced excursions such a
  // point is often better than the start.
  void keep_within_limits() {
    ExcitationProgram::Value value;
    value.worst = last_.worst;
    Eigen::VectorXd x = last_x_;
    for (int k = 0; k < kMostShrinks && value.worst > 1.0 && value.worst < kFarBeyond; ++k) {
      x = program_.space().shrunk(x, kInside / value.worst);
      value = program_.evaluate(x, false);
      if (!value.status.ok()) return;
      keep(x, value);
    }
  }

  const ExcitationDescription& description_;
  const int start_;
  const ExcitationObserver& observer_;
  ExcitationProgram& program_;
  TrajectorySearchResult result_;
  ExcitationProgram::Value last_;
  Eigen::VectorXd last_x_;
  int most_ = 0;  // limit of evaluations until the end of this search
  bool last_has_gradient_ = false, interrupted_ = false;
  double worst_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

TrajectorySearchResult search_trajectory(const ExcitationDescription& description,
                                         const Eigen::VectorXd& x, int start,
                                         const ExcitationObserver& observer,
                                         ExcitationProgram* program) {
  return TrajectorySearch(description, start, observer, program).run(x);
}

}  // namespace codesign
