// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include "excitation/excited_motion.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Kind = LimitedSignal::Kind;
constexpr Eigen::Index kFinePerWave = 64;
// Limit of a coefficient: shapes that cancel each other may be larger than a single one.
constexpr double kLargest = 10.0;
// A joint without limits rests within this distance from its start [rad or m].
constexpr double kHalfTurn = 3.14;
constexpr double kInnerRest = 0.8;  // mixed trajectories rest within this share of the range
constexpr double kRoom = 1.0 - 1e-9;

std::vector<double> fine_times(const TrajectoryBasis& basis) {
  const auto waves = static_cast<Eigen::Index>(std::ceil(basis.period() / basis.shortest_wave()));
  return times_in_period(basis.period(), kFinePerWave * waves);
}

}  // namespace

std::vector<double> times_in_period(double period, Eigen::Index count) {
  std::vector<double> times;
  for (Eigen::Index k = 0; k < count; ++k)
    times.push_back(period * static_cast<double>(k) / static_cast<double>(count));
  return times;
}

SampledShapes::SampledShapes(const TrajectoryBasis& basis, const std::vector<double>& times) {
  for (Eigen::MatrixXd* part : {&value, &rate, &acceleration})
    part->resize(to_signed(times.size()), basis.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    const TrajectoryBasis::Shapes shapes = basis.at(times[k]);
    const auto row = to_signed(k);
    value.row(row) = shapes.value;
    rate.row(row) = shapes.rate;
    acceleration.row(row) = shapes.acceleration;
  }
}

TrajectorySpace::TrajectorySpace(const ExcitationDescription& description,
                                 const MotionLimits& limits, const Eigen::VectorXd& start)
    : limits_(limits),
      basis_(description),
      fine_(basis_, fine_times(basis_)),
      rest_middle_(start),
      scale_(basis_.size(), start.size()) {
  rest_half_.setConstant(start.size(), kHalfTurn);
  for (Eigen::Index joint = 0; joint < joints(); ++joint) {
    double reach = std::numeric_limits<double>::infinity();
    if (const LimitedSignal* position = limits.find(joint, Kind::kPosition)) {
      rest_middle_[joint] = position->middle();
      rest_half_[joint] = reach = position->half();
    }
    const LimitedSignal *velocity = limits.find(joint, Kind::kVelocity),
                        *acceleration = limits.find(joint, Kind::kAcceleration);
    for (Eigen::Index k = 0; k < basis_.size(); ++k) {
      double scale = reach / fine_.value.col(k).cwiseAbs().maxCoeff();
      scale = std::min(scale, velocity->half() / fine_.rate.col(k).cwiseAbs().maxCoeff());
      if (acceleration)
        scale =
            std::min(scale, acceleration->half() / fine_.acceleration.col(k).cwiseAbs().maxCoeff());
      scale_(k, joint) = scale;
    }
  }
}

Eigen::VectorXd TrajectorySpace::upper() const {
  Eigen::VectorXd bounds = Eigen::VectorXd::Constant(size(), kLargest);
  for (Eigen::Index joint = 0; joint < joints(); ++joint) bounds[joint * stride()] = 1.0;
  return bounds;
}

Eigen::VectorXd TrajectorySpace::rest(const Eigen::VectorXd& x) const {
  Eigen::VectorXd rest = rest_middle_;
  for (Eigen::Index joint = 0; joint < joints(); ++joint)
    rest[joint] += rest_half_[joint] * x[joint * stride()];
  return rest;
}

Eigen::MatrixXd TrajectorySpace::coefficients(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd result(basis_.size(), joints());
  for (Eigen::Index joint = 0; joint < joints(); ++joint)
    result.col(joint) =
        scale_.col(joint).cwiseProduct(x.segment(joint * stride() + 1, basis_.size()));
  return result;
}

DrivePath TrajectorySpace::path(const Eigen::VectorXd& x, const SampledShapes& at) const {
  const Eigen::MatrixXd c = coefficients(x);
  DrivePath path{(at.value * c).transpose(), (at.rate * c).transpose(),
                 (at.acceleration * c).transpose()};
  path.position.colwise() += rest(x);
  return path;
}

Eigen::VectorXd TrajectorySpace::pull_back(const SampledShapes& at,
                                           const Eigen::MatrixXd& by_motion) const {
  const Eigen::Index n = joints();
  Eigen::VectorXd gradient(size());
  const Eigen::MatrixXd by_coefficients =
      at.value.transpose() * by_motion.topRows(n).transpose() +
      at.rate.transpose() * by_motion.middleRows(n, n).transpose() +
      at.acceleration.transpose() * by_motion.bottomRows(n).transpose();
  for (Eigen::Index joint = 0; joint < n; ++joint) {
    gradient[joint * stride()] = rest_half_[joint] * by_motion.row(joint).sum();
    gradient.segment(joint * stride() + 1, basis_.size()) =
        scale_.col(joint).cwiseProduct(by_coefficients.col(joint));
  }
  return gradient;
}

double TrajectorySpace::factor_by_rates(Eigen::Index joint, const Eigen::VectorXd& c) const {
  double factor =
      limits_.find(joint, Kind::kVelocity)->half() / (fine_.rate * c).cwiseAbs().maxCoeff();
  if (const LimitedSignal* acceleration = limits_.find(joint, Kind::kAcceleration))
    factor =
        std::min(factor, acceleration->half() / (fine_.acceleration * c).cwiseAbs().maxCoeff());
  return factor;
}

// Makes the excursions of a joint as large as its limits of position, velocity and acceleration
// permit.
void TrajectorySpace::fit_joint(Eigen::Index joint, Eigen::VectorXd* x) const {
  auto own = x->segment(joint * stride() + 1, basis_.size());
  const Eigen::VectorXd c = scale_.col(joint).cwiseProduct(own);
  double factor = factor_by_rates(joint, c);
  if (limits_.find(joint, Kind::kPosition)) {
    const Eigen::VectorXd value = fine_.value * c;
    const double rest = (*x)[joint * stride()];
    if (value.maxCoeff() > 0.0)
      factor = std::min(factor, rest_half_[joint] * (1.0 - rest) / value.maxCoeff());
    if (value.minCoeff() < 0.0)
      factor = std::min(factor, rest_half_[joint] * (-1.0 - rest) / value.minCoeff());
  }
  own *= kRoom * factor;
}

Eigen::VectorXd TrajectorySpace::plain() const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size());
  for (Eigen::Index joint = 0; joint < joints(); ++joint) {
    const Eigen::VectorXd c = basis_.plain(static_cast<int>(joint)), value = fine_.value * c;
    x.segment(joint * stride() + 1, basis_.size()) = c.cwiseQuotient(scale_.col(joint));
    if (limits_.find(joint, Kind::kPosition)) {
      const double width = value.maxCoeff() - value.minCoeff();
      const double factor =
          kRoom * std::min(factor_by_rates(joint, c), 2.0 * rest_half_[joint] / width);
      x[joint * stride()] =
          -0.5 * factor * (value.maxCoeff() + value.minCoeff()) / rest_half_[joint];
    }
    fit_joint(joint, &x);
  }
  return x;
}

Eigen::VectorXd TrajectorySpace::plain_around(const Eigen::VectorXd& positions) const {
  Eigen::VectorXd x = plain();
  for (Eigen::Index joint = 0; joint < joints(); ++joint) {
    const double rest = (positions[joint] - rest_middle_[joint]) / rest_half_[joint];
    x[joint * stride()] = std::clamp(rest, -kInnerRest, kInnerRest);
    fit_joint(joint, &x);
  }
  return x;
}

Eigen::VectorXd TrajectorySpace::mixed(const Eigen::VectorXd& numbers) const {
  Eigen::VectorXd x = 2.0 * numbers.array() - 1.0;
  for (Eigen::Index joint = 0; joint < joints(); ++joint) {
    x[joint * stride()] *= kInnerRest;
    fit_joint(joint, &x);
  }
  return x;
}

Eigen::VectorXd TrajectorySpace::shrunk(Eigen::VectorXd x, double factor) const {
  for (Eigen::Index joint = 0; joint < joints(); ++joint)
    x.segment(joint * stride() + 1, basis_.size()) *= factor;
  return x;
}

}  // namespace codesign
