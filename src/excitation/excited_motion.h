// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "identification/effort/driven_system.h"
#include "identification/effort/effort_tangent.h"
#include "math/arrays.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// A motion of the excited joints, joints x samples; joints move little between samples.
struct DrivePath {
  Eigen::MatrixXd position, velocity, acceleration;  ///< [rad or m], per s, per s^2

  Eigen::Index samples() const { return position.cols(); }
};

/// The response of a mechanism to a DrivePath.
struct PathResponse {
  Eigen::MatrixXd effort;  ///< of the excited joints [N m or N], joints x samples
  Eigen::MatrixXd follower_position, follower_velocity;  ///< followers x samples
  /// d effort / d rho, (samples * joints) x tuned parameters, row sample * joints + k; empty unless
  /// requested
  RowJacobian jacobian;
};

/// Inverse dynamics of a mechanism along motions that a search proposes, at one design, with exact
/// derivatives of the efforts by the tuned parameters; doc/theory.md (28), (46). Not thread-safe
/// itself; the results are the same to the last bit for any number of threads.
class ExcitedMotion {
 public:
  /// @param system as make_system() compiled it; must outlive this. @param joints the excited
  /// joints, all with an effort; they determine the motion.
  /// @param followers other joints with one coordinate. @param parameters all named parameters.
  /// @throws InputError as make_driven_system(), and for a follower that moves no mass.
  ExcitedMotion(const CompiledSystem& system, std::vector<MeasuredJoint> joints,
                const std::vector<MeasuredJoint>& followers, std::vector<double> parameters,
                int threads);
  ~ExcitedMotion();

  Eigen::Index joints() const { return to_signed(joints_.size()); }
  Eigen::Index followers() const { return to_signed(followers_.size()); }
  Eigen::Index parameters() const;

  /// Assembles the mechanism at positions of the excited joints; motions must begin near these
  /// positions.
  Status begin(const Eigen::VectorXd& positions);
  /// Call it after begin() has succeeded. Statuses as DrivenMotion; the cause names the sample.
  Status respond(const DrivePath& path, bool with_jacobian, PathResponse* response);

  /// Derivatives of the last response by the motion: direction order * joints + j is position (0),
  /// velocity (1) or acceleration (2) of joint j, column sample * 3 joints + direction. Central
  /// differences of exact numbers, (46b).
  struct Slopes {
    Eigen::MatrixXd effort, follower_position, follower_velocity;
    /// rows (sample * 3 joints + direction) * joints + k; empty unless the response had one
    RowJacobian jacobian;
  };
  Status differentiate(const DrivePath& path, const PathResponse& response, Slopes* slopes);

  /// Once set (by any thread), calls end soon with kCancelled. nullptr: no cancellation.
  void obey(const std::atomic<bool>* cancel) { cancel_ = cancel; }

 private:
  struct PathWorker;
  struct FrictionSource {
    int pair, element;
  };
  template <class Work>
  Status in_blocks(Eigen::Index samples, const Work& work);
  void read(PathWorker* worker, const State<double>& state, Eigen::Index column,
            Eigen::MatrixXd* effort, Eigen::MatrixXd* position, Eigen::MatrixXd* velocity) const;
  Status differentiate_sample(const DrivePath& path, Eigen::Index sample, PathWorker* worker,
                              Slopes* slopes) const;

  const CompiledSystem& system_;
  const std::vector<MeasuredJoint> joints_;
  const DrivenSystem driven_;
  const std::vector<double> parameters_;
  std::vector<FrictionSource> followers_;
  std::vector<std::unique_ptr<PathWorker>> workers_;
  State<double> rest_;
  std::vector<State<double>> states_;  ///< states at the samples of the last response
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace codesign
