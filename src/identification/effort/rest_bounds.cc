// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/rest_bounds.h"

#include <cmath>

#include "math/arrays.h"

namespace codesign {

RestBounds::RestBounds(const MotionSamples& measured, const Eigen::MatrixXd& speeds) {
  const Eigen::Index count = measured.position.cols(), joints = measured.position.rows(),
                     added = 2 * (speeds.array() > 0.0).count();
  places_.reserve(to_index(count));
  samples_ = measured;
  if (added == 0) {
    for (Eigen::Index k = 0; k < count; ++k) places_.push_back(k);
    return;
  }
  bounds_.setConstant(joints, count, -1);
  for (Eigen::MatrixXd* rows : {&samples_.position, &samples_.velocity, &samples_.acceleration})
    rows->resize(joints, count + added);
  samples_.times.clear();
  samples_.numbers.clear();
  Eigen::Index place = 0;
  const auto add = [&](Eigen::Index sample) {
    samples_.position.col(place) = measured.position.col(sample);
    samples_.velocity.col(place) = measured.velocity.col(sample);
    samples_.acceleration.col(place) = measured.acceleration.col(sample);
    if (!measured.times.empty()) samples_.times.push_back(measured.times[to_index(sample)]);
    samples_.numbers.push_back(static_cast<int>(sample));
    return place++;
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    places_.push_back(add(k));
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      if (!(speeds(joint, k) > 0.0)) continue;
      bounds_(joint, k) = place;
      for (const double direction : {-1.0, 1.0})
        samples_.velocity(joint, add(k)) = direction * speeds(joint, k);
    }
  }
  for (int& begin : samples_.begins)
    begin = begin < count ? static_cast<int>(places_[to_index(begin)])
                          : static_cast<int>(count + added);
}

void take_nearer_bound(const Eigen::MatrixXd& forward, Eigen::MatrixXd* backward) {
  for (Eigen::Index k = 0; k < backward->rows(); ++k) {
    const double one = (*backward)(k, 0), other = forward(k, 0);
    if (one == other) continue;
    if (one * other <= 0.0)
      backward->row(k).setZero();
    else if (std::abs(other) < std::abs(one))
      backward->row(k) = forward.row(k);
  }
}

}  // namespace codesign
