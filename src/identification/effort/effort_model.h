// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "description/study.h"
#include "identification/effort/driven_system.h"
#include "identification/effort/effort_tangent.h"
#include "math/arrays.h"
#include "mechanism_codesign/status.h"

namespace codesign {

class MotionProjection;

/// The measured motion, one row per measured joint and one column per instant (a sample), recording
/// after recording.
struct MotionSamples {
  Eigen::MatrixXd position, velocity, acceleration;  ///< [rad or m], per s, per s^2
  /// joints with positions known up to a constant in each recording, ascending
  std::vector<int> shifted{};
  /// the first sample of each recording, ascending; joints move little between samples of one
  /// recording
  std::vector<int> begins{0};
  std::vector<double> times{};  ///< of each sample [s], for loads that depend on the time; none: 0
  std::vector<int> numbers{};   ///< of each sample, for messages; empty: from 0 on
};

/// The efforts that a mechanism needs for a measured motion, and their exact derivatives by the
/// tuned parameters; doc/theory.md (28).
///
/// Samples are independent of each other and are shared among threads; the results are the same to
/// the last bit for any number of threads. No allocation per sample once warm. Not thread-safe
/// itself.
class EffortModel {
 public:
  /// @param system as make_system() compiled it; only needed by the constructor and begin(), but
  /// must outlive this.
  /// @param motion as many rows as `joints`; finite numbers. With shifted joints, every shifted
  /// joint must be a drive, and there must be no surplus joint.
  /// @param threads number of samples evaluated at the same time. @param signals that are computed
  /// beside the efforts
  /// @throws InputError as make_driven_system().
  EffortModel(const CompiledSystem& system, std::vector<MeasuredJoint> joints, MotionSamples motion,
              int threads = 1, const std::vector<SignalDescription>& signals = {});
  ~EffortModel();

  /// The joints whose efforts are computed, in the order of the rows of efforts and of
  /// DrivenSystem::drives.
  const std::vector<std::string>& drives() const { return names_; }
  const DrivenSystem& driven() const { return driven_; }
  int samples() const { return static_cast<int>(motion_.position.cols()); }
  int parameters() const { return static_cast<int>(driven_.system->whole_study().tuned.size()); }

  /// Adds constants to the positions given to the constructor. @param shifts [rad or m], one row
  /// per shifted joint and column per recording
  void shift(const Eigen::MatrixXd& shifts);

  /// Follows the motion through all samples at a design; evaluate() later starts from these states.
  /// Projects the measured motion of all joints onto the motion of the drives, theory (28a). Call
  /// it first, and again after a large change of dimensions.
  /// @param parameters all named parameters (Study::parameters order). @return the status of a
  /// failure names the sample.
  Status begin(const std::vector<double>& parameters);

  /// Computes efforts and derivatives. @throws std::logic_error if begin() has not succeeded
  /// before.
  /// @param parameters all named parameters.
  /// @param efforts resized to outputs x samples: of each drive the effort on the child along the
  /// joint coordinate [N m or N], then the signals.
  /// @param jacobian may be null; else resized to (outputs * samples) x tuned parameters, row
  /// sample * outputs + k for output k; then one column per shifted joint, with the derivatives by
  /// its shift in the recording of the sample.
  /// @return kInvalidDesign for impossible masses or dimensions, kCancelled, or the status of the
  /// first sample that fails.
  Status evaluate(const std::vector<double>& parameters, Eigen::MatrixXd* efforts,
                  RowJacobian* jacobian);

  /// The motion of the drives in use: as measured, or projected if there are surplus joints; drives
  /// x samples.
  const Eigen::MatrixXd& position() const { return position_; }
  const Eigen::MatrixXd& velocity() const { return velocity_; }
  const Eigen::MatrixXd& acceleration() const { return acceleration_; }
  /// The whole state of a sample at the design of begin().
  const State<double>& state(int sample) const { return states_[to_index(sample)]; }

  /// Once `cancel` is set (by any thread), begin() and evaluate() end soon with kCancelled.
  /// nullptr: no cancellation.
  void obey(const std::atomic<bool>* cancel) { cancel_ = cancel; }

 private:
  struct EffortWorker;
  struct Failure {
    int sample = -1;
    Status status;
  };
  DriveMotion given(int sample) const;
  /// Drives and signals.
  Eigen::Index outputs() const {
    return position_.rows() + to_signed(driven_.system->watched().size());
  }
  double time(int sample) const {
    return motion_.times.empty() ? 0.0 : motion_.times[to_index(sample)];
  }
  /// A failure that names the sample.
  Status at_sample(int sample, Status status) const;
  Status follow(const MotionProjection& projection, int sample, EffortWorker* worker);
  Status prepare(const std::vector<double>& parameters, EffortWorker* worker) const;
  Failure evaluate_block(int block, EffortWorker* worker, Eigen::MatrixXd* efforts,
                         RowJacobian* jacobian) const;

  const CompiledSystem& system_;
  const std::vector<MeasuredJoint> joints_;
  MotionSamples motion_;  ///< with the shifts added
  const DrivenSystem driven_;
  std::vector<int> shifted_drives_;
  const Eigen::MatrixXd unshifted_;  ///< positions of the shifted joints
  std::vector<std::string> names_;
  Eigen::MatrixXd position_, velocity_, acceleration_;
  std::vector<State<double>> states_;
  std::vector<std::unique_ptr<EffortWorker>> workers_;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign
