// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excitation_program.h"

#include <cmath>
#include <limits>
#include <utility>
#include "equations/equations.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Kind = LimitedSignal::Kind;
constexpr double kPerWave = 16.0;  // number of effort samples in the shortest wave
// Factor for the number of samples of positions, velocities and accelerations, which are cheap.
constexpr Eigen::Index kDenseness = 4;

Eigen::Index samples_of(const TrajectoryBasis& basis) {
  return static_cast<Eigen::Index>(std::ceil(kPerWave * basis.period() / basis.shortest_wave()));
}

bool is_response(const LimitedSignal& signal) {
  return signal.is_follower || signal.kind == Kind::kEffort;
}

const Eigen::MatrixXd& motion_of(const DrivePath& path, Kind kind) {
  return kind == Kind::kPosition   ? path.position
         : kind == Kind::kVelocity ? path.velocity
                                   : path.acceleration;
}

}  // namespace

double limit_envelope(const Eigen::VectorXd& z, double sharpness, Eigen::VectorXd* by_z) {
  const double m = z.cwiseAbs().maxCoeff();
  const Eigen::ArrayXd above = (sharpness * (z.array() - m)).exp(),
                       below = (sharpness * (-z.array() - m)).exp();
  const double sum = above.sum() + below.sum();
  if (by_z) *by_z = (above - below) / sum;
  return m + std::log(sum) / sharpness - 1.0;
}

ExcitationProgram::ExcitationProgram(const TrajectorySpace& space, const MotionLimits& limits,
                                     const Information& information, std::vector<int> columns,
                                     ExcitedMotion* motion)
    : space_(space),
      limits_(limits),
      information_(information),
      columns_(std::move(columns)),
      motion_(*motion),
      samples_(samples_of(space.basis())),
      step_(space.basis().period() / static_cast<double>(samples_)),
      shapes_(space.basis(), times_in_period(space.basis().period(), samples_)),
      dense_(space.basis(), times_in_period(space.basis().period(), kDenseness * samples_)) {}

Eigen::VectorXd ExcitationProgram::relative_of(const LimitedSignal& signal,
                                               const DrivePath& dense) const {
  const Eigen::MatrixXd& values = signal.is_follower             ? signal.kind == Kind::kPosition
                                                                       ? response_.follower_position
                                                                       : response_.follower_velocity
                                  : signal.kind == Kind::kEffort ? response_.effort
                                                                 : motion_of(dense, signal.kind);
  return values.row(signal.joint).transpose().unaryExpr([&](double value) {
    return signal.relative(value);
  });
}

Eigen::MatrixXd ExcitationProgram::by_motion(const LimitedSignal& signal,
                                             const Eigen::VectorXd& by_z) const {
  const Eigen::Index n = space_.joints();
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(3 * n, by_z.size());
  const Eigen::VectorXd by_value = by_z / signal.half();
  if (!is_response(signal)) {
    by.row(to_signed(signal.kind) * n + signal.joint) = by_value;
    return by;
  }
  const Eigen::MatrixXd& slopes = !signal.is_follower              ? slopes_.effort
                                  : signal.kind == Kind::kPosition ? slopes_.follower_position
                                                                   : slopes_.follower_velocity;
  for (Eigen::Index sample = 0; sample < by_z.size(); ++sample)
    by.col(sample) =
        by_value[sample] * slopes.row(signal.joint).segment(sample * 3 * n, 3 * n).transpose();
  return by;
}

Eigen::MatrixXd ExcitationProgram::by_motion(const Information::ByResponse& response) const {
  const Eigen::Index n = space_.joints();
  Eigen::MatrixXd by(3 * n, samples_);
  for (Eigen::Index sample = 0; sample < samples_; ++sample)
    for (Eigen::Index direction = 0; direction < 3 * n; ++direction) {
      const Eigen::Index column = sample * 3 * n + direction;
      by(direction, sample) = response.effort.col(sample).dot(slopes_.effort.col(column)) +
                              response.jacobian.middleRows(sample * n, n)
                                  .cwiseProduct(slopes_.jacobian.middleRows(column * n, n))
                                  .sum();
    }
  return by;
}

void ExcitationProgram::evaluate_limits(const DrivePath& dense, bool with_gradient, Value* value) {
  value->limits.resize(rows());
  if (with_gradient) value->limits_x.resize(rows(), size());
  for (Eigen::Index row = 0; row < rows(); ++row) {
    const LimitedSignal& signal = limits_.signals[to_index(row)];
    const Eigen::VectorXd z = relative_of(signal, dense);
    Eigen::VectorXd by_z;
    value->limits[row] = limit_envelope(z, sharpness_, with_gradient ? &by_z : nullptr);
    value->worst = std::max(value->worst, z.cwiseAbs().maxCoeff());
    if (with_gradient)
      value->limits_x.row(row) =
          space_.pull_back(is_response(signal) ? shapes_ : dense_, by_motion(signal, by_z));
  }
}

ExcitationProgram::Value ExcitationProgram::evaluate(const Eigen::VectorXd& x, bool with_gradient) {
  Value value;
  const DrivePath path = space_.path(x, shapes_);
  value.status = motion_.respond(path, true, &response_);
  if (!value.status.ok()) return value;
  Eigen::MatrixXd by_jacobian;
  value.criterion = information_criterion(information_.jacobian(response_, step_), columns_,
                                          with_gradient ? &by_jacobian : nullptr);
  if (!std::isfinite(value.criterion)) {
    value.status = {StatusCode::kNotIdentifiable, 0.0,
                    "this motion determines fewer numbers than other motions"};
    return value;
  }
  if (with_gradient) {
    value.status = motion_.differentiate(path, response_, &slopes_);
    if (!value.status.ok()) return value;
    value.gradient = space_.pull_back(
        shapes_, by_motion(information_.by_response(by_jacobian, samples_, step_)));
  }
  evaluate_limits(space_.path(x, dense_), with_gradient, &value);
  return value;
}

double ExcitationProgram::worst_of(const Eigen::VectorXd& x) {
  if (!motion_.respond(space_.path(x, shapes_), false, &response_).ok())
    return std::numeric_limits<double>::infinity();
  Value value;
  evaluate_limits(space_.path(x, dense_), false, &value);
  return value.worst;
}

}  // namespace codesign
