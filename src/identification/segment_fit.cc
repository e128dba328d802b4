// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/segment_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identification/residual_fit.h"
#include "math/dense.h"
#include "optimization/levenberg_marquardt.h"

namespace codesign {
namespace {

constexpr int kMostRuns = 8, kFewRuns = 3;
constexpr double kSettled = 1e-8;    // of the value: a start with a smaller promise is the best one
constexpr double kPatience = 10.0;   // factor of kSettled with each run: the noise of step sizes makes promises that are not kept
constexpr double kResolved = 1e-14;  // of the sum of squares of the recorded values: a simulation does not resolve less

/// Columns scaled to length one, so that the rank does not depend on units.
class StartColumns {
 public:
  explicit StartColumns(const Eigen::MatrixXd& columns)
      : lengths_(lengths_of(columns)), scaled_(columns * lengths_.cwiseInverse().asDiagonal()) {}

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const {
    if (lengths_.size() == 0) return Eigen::MatrixXd::Zero(0, right.cols());
    return lengths_.cwiseInverse().asDiagonal() * scaled_.solve(right);
  }
  /// Decrease of the sum of squares by the best start, to first order.
  double promise(const Eigen::VectorXd& residuals) const {
    if (lengths_.size() == 0) return 0.0;
    return scaled_.explained(residuals);
  }

 private:
  static Eigen::VectorXd lengths_of(const Eigen::MatrixXd& columns) {
    const Eigen::VectorXd lengths = columns.colwise().norm().transpose();
    return lengths.unaryExpr([](double length) { return length > 0.0 ? length : 1.0; });
  }

  Eigen::VectorXd lengths_;
  PivotedLeastSquares scaled_;
};

/// The cost of a segment as a function of its start. Keeps the best point and, if derivatives by x are computed, its derivative by x.
class StartCost final : public LeastSquaresModel {
 public:
  StartCost(const SegmentProblem& problem, SegmentLanes lanes, SegmentRun* run, SegmentSolution* best)
      : problem_(problem), lanes_(lanes), run_(*run), best_(*best) {
    const Eigen::MatrixXd& recorded = problem.segment.recorded;
    for (Eigen::Index k = 0; k < recorded.cols(); ++k) resolved_ += kResolved * (recorded.col(k) / problem.spreads[k]).squaredNorm();
  }

  Outcome evaluate(const Eigen::VectorXd& start, LeastSquaresPoint* point) override {
    const Segment& segment = problem_.segment;
    const Status status = run_.run(problem_.of.parameters(problem_.variables, problem_.x, start), segment.begin, segment.times, lanes_);
    ++best_.runs;
    if (lanes_ == SegmentLanes::kAll) ++best_.whole_runs;
    if (!status.ok()) {
      if (!is_begun_) best_.status = status;
      return status.code == StatusCode::kCancelled ? stop(status) : Outcome::kFailed;
    }
    compare();
    const WeightedResiduals weighted = weigh(residuals_, &by_all_, problem_.spreads, problem_.loss);
    const Eigen::MatrixXd by_start = weighted.jacobian.rightCols(problem_.of.starts);
    point->value = weighted.value;
    point->gradient = 2.0 * (by_start.transpose() * weighted.residuals.reshaped());
    point->root = triangular_root(by_start);
    const StartColumns columns(by_start);
    const double promise = columns.promise(weighted.residuals.reshaped());
    if (!is_begun_ || weighted.value < best_.value) keep(start, weighted, columns, promise > resolved_ ? promise : 0.0);
    const double settled = kSettled * std::pow(kPatience, best_.runs - 1) * weighted.value;
    return promise <= std::max(settled, resolved_) ? Outcome::kStop : Outcome::kUsable;
  }
  bool is_begun() const { return is_begun_; }

 private:
  Outcome stop(const Status& status) {
    best_.status = status;
    return Outcome::kStop;
  }

  /// Residuals of the last run and their derivatives: by x in the first columns, unless only the derivatives by the start are computed,
  /// then by the start.
  void compare() {
    const Eigen::Index rows = run_.values().rows(), lanes = run_.slopes().cols(), sensors = lanes - problem_.of.starts;
    residuals_ = run_.values() - problem_.segment.recorded;
    by_all_.setZero(run_.slopes().rows(), problem_.x.size() + problem_.of.starts);
    for (Eigen::Index k = 0; lanes_ == SegmentLanes::kAll && k < sensors; ++k)
      by_all_.col(problem_.of.columns[static_cast<std::size_t>(k)]) = run_.slopes().col(k);
    by_all_.rightCols(problem_.of.starts) = run_.slopes().rightCols(problem_.of.starts);
    for (std::size_t k = 0; k < problem_.of.outputs.size(); ++k)
      if (problem_.efforts[k]) sense(k, static_cast<Eigen::Index>(k) * rows);
  }

  /// The residuals of a recorded effort, (28c). @param first row of its derivatives
  void sense(std::size_t output, Eigen::Index first) {
    const std::string& joint = problem_.of.outputs[output].joint;
    const EffortSensor sensor = problem_.variables.sensor(joint, problem_.x);
    const FitVariables::SensorColumns at = problem_.variables.columns(joint);
    const auto column = static_cast<Eigen::Index>(output);
    for (Eigen::Index k = 0; k < residuals_.rows(); ++k) {
      const double time = problem_.segment.times[static_cast<std::size_t>(k)];
      const EffortResidual residual = effort_residual(sensor, *problem_.efforts[output], time, run_.values()(k, column));
      residuals_(k, column) = residual.value;
      by_all_.row(first + k) *= residual.by_effort;
      if (at.scale >= 0) by_all_(first + k, at.scale) += residual.by_scale;
      if (at.delay >= 0) by_all_(first + k, at.delay) += residual.by_delay;
      if (at.offset >= 0) by_all_(first + k, at.offset) += residual.by_effort;
    }
  }

  void keep(const Eigen::VectorXd& start, const WeightedResiduals& weighted, const StartColumns& columns, double promise) {
    is_begun_ = true;
    best_.status = {};
    best_.start = start;
    best_.value = weighted.value;
    best_.promise = promise;
    best_.residuals = residuals_;
    best_.correction = columns.solve(weighted.residuals.reshaped());
    if (lanes_ != SegmentLanes::kAll) return;
    best_.slope = columns.solve(weighted.jacobian.leftCols(problem_.x.size()));
    best_.jacobian = by_all_.leftCols(problem_.x.size()) - product(by_all_.rightCols(problem_.of.starts), best_.slope);
  }

  const SegmentProblem& problem_;
  const SegmentLanes lanes_;
  SegmentRun& run_;
  SegmentSolution& best_;
  double resolved_ = 0.0;
  Eigen::MatrixXd residuals_, by_all_;
  bool is_begun_ = false;
};

}  // namespace

SegmentSolution fit_segment(const SegmentProblem& problem, const std::vector<Eigen::VectorXd>& guesses, SegmentWork work, SegmentRun* run) {
  LevenbergMarquardtOptions options;
  options.max_evaluations = work == SegmentWork::kBetterStart ? kFewRuns : kMostRuns;
  options.relative_tolerance = kSettled;
  options.largest_first_step = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd open = Eigen::VectorXd::Constant(problem.of.starts, std::numeric_limits<double>::infinity());
  SegmentSolution best;
  for (const Eigen::VectorXd& guess : guesses) {
    StartCost cost(problem, work == SegmentWork::kElimination ? SegmentLanes::kAll : SegmentLanes::kStart, run, &best);
    Eigen::VectorXd start = guess;
    LeastSquaresPoint point;
    if (work == SegmentWork::kElimination)
      cost.evaluate(start, &point);
    else
      minimize_squares(options, -open, open, &cost, &start, &point);
    if (cost.is_begun() || best.status.code == StatusCode::kCancelled) break;
  }
  return best;
}

}  // namespace codesign
