// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/information.h"

#include <cmath>
#include <limits>
#include <utility>

#include "identification/effort/effort_tangent.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "statistics/identifiability.h"

namespace codesign {
namespace {

/// The effort as the sensor would record it, at equal steps.
RecordedEffort shown_by(const EffortSensor& sensor, const Eigen::VectorXd& effort, double step) {
  std::vector<double> times, values;
  for (Eigen::Index k = 0; k < effort.size(); ++k) {
    times.push_back(step * static_cast<double>(k) + sensor.delay);
    values.push_back((effort[k] + sensor.offset) / sensor.scale);
  }
  return {std::move(times), std::move(values)};
}

/// Adds to `by_effort` the contribution of the derivatives `by_slope` by the slopes of a
/// RecordedEffort at equal steps.
void add_by_slopes(const Eigen::VectorXd& by_slope, double step, Eigen::VectorXd* by_effort) {
  const Eigen::Index last = by_slope.size() - 1;
  if (last < 2) return;
  Eigen::VectorXd inner = by_slope;
  // The slope at an end is twice the chord minus the slope of the neighbour.
  inner[1] -= by_slope[0];
  inner[last - 1] -= by_slope[last];
  (*by_effort)[0] -= 2.0 * by_slope[0] / step;
  (*by_effort)[1] += 2.0 * by_slope[0] / step;
  (*by_effort)[last - 1] -= 2.0 * by_slope[last] / step;
  (*by_effort)[last] += 2.0 * by_slope[last] / step;
  for (Eigen::Index k = 1; k < last; ++k) {
    (*by_effort)[k + 1] += 0.5 * inner[k] / step;
    (*by_effort)[k - 1] -= 0.5 * inner[k] / step;
  }
}

}  // namespace

Information::Information(const FitVariables& variables, std::vector<std::string> joints,
                         Eigen::VectorXd noise)
    : variables_(variables), joints_(std::move(joints)), noise_(std::move(noise)) {}

Eigen::MatrixXd Information::jacobian(const PathResponse& response, double step) const {
  const Eigen::Index samples = response.effort.cols(), n = response.effort.rows();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n * samples, variables_.size());
  Eigen::VectorXd efforts(n * samples);
  for (Eigen::Index joint = 0; joint < n; ++joint) {
    const std::string& name = joints_[to_index(joint)];
    const EffortSensor sensor = variables_.sensor(name, variables_.start());
    const FitVariables::SensorColumns at = variables_.columns(name);
    const RecordedEffort shown = shown_by(sensor, response.effort.row(joint), step);
    for (Eigen::Index sample = 0; sample < samples; ++sample) {
      const EffortResidual residual = effort_residual(
          sensor, shown, step * static_cast<double>(sample), response.effort(joint, sample));
      auto row = J.row(joint * samples + sample);
      row.head(variables_.tuned()) = residual.by_effort * response.jacobian.row(sample * n + joint);
      if (at.scale >= 0) row[at.scale] = residual.by_scale;
      if (at.delay >= 0) row[at.delay] = residual.by_delay;
      if (at.offset >= 0) row[at.offset] = residual.by_effort;
    }
    J.middleRows(joint * samples, samples) /= noise_[joint];
    efforts.segment(joint * samples, samples) =
        response.effort.row(joint).transpose() / noise_[joint];
  }
  clear_rounding(variables_.start(), &J, efforts.norm());
  return J;
}

Information::ByResponse Information::by_response(const Eigen::MatrixXd& by_jacobian,
                                                 Eigen::Index samples, double step) const {
  const auto n = to_signed(joints_.size());
  ByResponse result{RowJacobian(samples * n, variables_.tuned()),
                    Eigen::MatrixXd::Zero(n, samples)};
  for (Eigen::Index joint = 0; joint < n; ++joint) {
    const std::string& name = joints_[to_index(joint)];
    const EffortSensor sensor = variables_.sensor(name, variables_.start());
    const FitVariables::SensorColumns at = variables_.columns(name);
    const double by_effort = sensor.start_scale / sensor.scale, weight = 1.0 / noise_[joint];
    const auto block = by_jacobian.middleRows(joint * samples, samples);
    for (Eigen::Index sample = 0; sample < samples; ++sample)
      result.jacobian.row(sample * n + joint) =
          weight * by_effort * block.row(sample).head(variables_.tuned());
    if (at.scale >= 0)
      result.effort.row(joint) -=
          weight * by_effort / sensor.scale * block.col(at.scale).transpose();
    if (at.delay < 0) continue;
    // The derivative of the residual by the delay is minus the slope of the recorded effort, times
    // the scale at the start.
    Eigen::VectorXd by_effort_of_slopes = Eigen::VectorXd::Zero(samples);
    add_by_slopes(-weight * by_effort * block.col(at.delay), step, &by_effort_of_slopes);
    result.effort.row(joint) += by_effort_of_slopes.transpose();
  }
  return result;
}

double information_criterion(const Eigen::MatrixXd& J, const std::vector<int>& columns,
                             Eigen::MatrixXd* by_jacobian) {
  const auto count = to_signed(columns.size());
  if (by_jacobian != nullptr) by_jacobian->setZero(J.rows(), J.cols());
  if (count == 0) return 0.0;
  Eigen::MatrixXd A(J.rows(), count);
  Eigen::VectorXd lengths(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    lengths[k] = J.col(columns[to_index(k)]).norm();
    if (!(lengths[k] > 0.0) || !std::isfinite(lengths[k]))
      return std::numeric_limits<double>::infinity();
    A.col(k) = J.col(columns[to_index(k)]) / lengths[k];
  }
  const Eigen::MatrixXd R = upper_factor(A);
  if (R.diagonal().minCoeff() < kRankThreshold) return std::numeric_limits<double>::infinity();
  if (by_jacobian != nullptr) {
    Eigen::MatrixXd by_A = A;  // A (A^T A)^-1
    R.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(by_A);
    R.transpose().triangularView<Eigen::Lower>().solveInPlace<Eigen::OnTheRight>(by_A);
    for (Eigen::Index k = 0; k < count; ++k)
      by_jacobian->col(columns[to_index(k)]) = -2.0 * by_A.col(k) / lengths[k];
  }
  return -2.0 * (R.diagonal().array().log().sum() + lengths.array().log().sum());
}

}  // namespace codesign
