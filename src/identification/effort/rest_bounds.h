// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/effort/effort_model.h"

namespace codesign {

/// Where a model is evaluated for measured samples: at each as it was measured, and behind it, for
/// each joint that rests there, twice with this joint just moving, backward and forward. Friction
/// at rest is any value between those of these two, doc/theory.md (28d).
class RestBounds {
 public:
  /// @param speeds joints x samples of the motion [rad/s or m/s]: the speed of a joint that just
  /// moves; zero where it does not rest
  RestBounds(const MotionSamples& measured, const Eigen::MatrixXd& speeds);

  /// The motion with the samples that were added, which have the numbers of the measured ones.
  const MotionSamples& samples() const { return samples_; }
  /// The place of a measured sample in samples().
  Eigen::Index place(Eigen::Index sample) const {
    return places_[static_cast<std::size_t>(sample)];
  }
  /// Whether a joint rests at a sample.
  bool rests(Eigen::Index joint, Eigen::Index sample) const {
    return bounds_.size() > 0 && bounds_(joint, sample) >= 0;
  }
  /// The place with the joint just moving, backward or forward; place() where it does not rest.
  Eigen::Index bound(Eigen::Index joint, Eigen::Index sample, bool is_forward) const {
    return rests(joint, sample) ? bounds_(joint, sample) + (is_forward ? 1 : 0) : place(sample);
  }

 private:
  MotionSamples samples_;
  std::vector<Eigen::Index> places_;
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> bounds_;  ///< -1: none; may be empty
};

/// Of residuals with the effort at both bounds, the one that counts: the nearer bound of a recorded
/// effort outside of them, zero within. Each row of `backward` gets the row of residual and
/// derivatives that counts. Where no joint rests, both are the same.
void take_nearer_bound(const Eigen::MatrixXd& forward, Eigen::MatrixXd* backward);

}  // namespace codesign
