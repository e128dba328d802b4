// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "equations/equations.h"
#include "excitation/information.h"
#include "excitation/trajectory_space.h"
#include "math/arrays.h"

namespace codesign {

/// A smooth bound above the largest |z_i| - 1, doc/theory.md (47):
///   m + log(sum exp(s(z_i - m)) + exp(s(-z_i - m))) / s - 1
/// with m the largest |z_i|; it exceeds that maximum by at most log(2 N) / s.
/// @param by_z may be null; else receives the derivatives.
double limit_envelope(const Eigen::VectorXd& z, double sharpness, Eigen::VectorXd* by_z);

/// The smooth program of the search for a trajectory, doc/theory.md (46), (47): the information
/// criterion, to be minimized, and one row per limited signal, to be kept at most zero. Not
/// thread-safe.
class ExcitationProgram {
 public:
  /// @param columns of the information's Jacobian that count. All other arguments must outlive
  /// this.
  ExcitationProgram(const TrajectorySpace& space, const MotionLimits& limits,
                    const Information& information, std::vector<int> columns,
                    ExcitedMotion* motion);

  Eigen::Index size() const { return space_.size(); }
  Eigen::Index rows() const { return to_signed(limits_.signals.size()); }
  const TrajectorySpace& space() const { return space_; }
  /// Sets the sharpness of the envelopes; a larger value is nearer to the limits.
  void set_sharpness(double sharpness) { sharpness_ = sharpness; }

  struct Value {
    /// not ok: the motion cannot be followed, or its efforts do not determine all columns
    Status status;
    double criterion = 0.0;  ///< (46a), for the samples of the program
    Eigen::VectorXd limits;  ///< the envelope of each signal
    double worst = 0.0;  ///< largest |z| of all signals at the samples; at most 1 within the limits
    Eigen::VectorXd gradient;  ///< derivative of the criterion; empty unless requested
    Eigen::MatrixXd limits_x;  ///< rows x size
  };
  Value evaluate(const Eigen::VectorXd& x, bool with_gradient);
  /// Only Value::worst, without derivatives of the efforts by parameters; infinite if the motion
  /// cannot be followed.
  double worst_of(const Eigen::VectorXd& x);

 private:
  Eigen::VectorXd relative_of(const LimitedSignal& signal, const DrivePath& dense) const;
  void evaluate_limits(const DrivePath& dense, bool with_gradient, Value* value);
  Eigen::MatrixXd by_motion(const LimitedSignal& signal, const Eigen::VectorXd& by_z) const;
  Eigen::MatrixXd by_motion(const Information::ByResponse& by) const;

  const TrajectorySpace& space_;
  const MotionLimits& limits_;
  const Information& information_;
  const std::vector<int> columns_;
  ExcitedMotion& motion_;
  const Eigen::Index samples_;
  const double step_;
  const SampledShapes shapes_, dense_;
  double sharpness_ = 100.0;
  PathResponse response_;
  ExcitedMotion::Slopes slopes_;
};

}  // namespace codesign
