// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EXCITATION_EXCITATION_RESULT_H_
#define MECHANISM_CODESIGN_EXCITATION_EXCITATION_RESULT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "excitation/limit_scan.h"
#include "excitation/trajectory_points.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// What a recording along a trajectory is expected to tell of one number.
struct PredictedNumber {
  std::string name, unit;
  double nominal = 0.0;                  ///< at which the prediction is made
  bool is_determined = true;             ///< whether any trajectory tells it
  double deviation_before = 0.0;         ///< standard deviation with the plain trajectory; infinite where nothing is told
  double deviation = 0.0;                ///< with the trajectory found
  double half_before = 0.0, half = 0.0;  ///< half the width of the interval
};

/// A limited signal along the trajectory found.
struct KeptLimit {
  LimitedSignal limits;
  ScannedSignal reached;
};

/// One search.
struct ExcitationStart {
  double initial_criterion = 0.0, criterion = 0.0;
  int evaluations = 0;
  std::string termination;
};

/// What excite() found.
struct ExcitationResult {
  Status status;            ///< ok, kCancelled, kNotIdentifiable (the rest is there all the same), kInfeasible, or a failure at the start
  std::string termination;  ///< of the best search
  std::vector<PredictedNumber> numbers;            ///< empty: nothing was found
  std::vector<std::string> undetermined;           ///< sentences about what no trajectory tells
  double criterion_before = 0.0, criterion = 0.0;  ///< (46a) of the recordings; infinite where they tell less than others would
  int counted = 0;                                 ///< numbers, or sums of them, that the criterion counts
  TrajectoryPoints before, points;
  Eigen::VectorXd rest;          ///< positions of the joints at both ends
  Eigen::MatrixXd coefficients;  ///< of the shapes (45), shapes x joints
  std::vector<KeptLimit> limits;
  std::vector<ExcitationStart> starts;
  int evaluations = 0;
  double cpu_seconds = 0.0;

  /// By which factor the volume of the confidence ellipsoid is smaller than with the plain trajectory.
  double volume_factor() const;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EXCITATION_EXCITATION_RESULT_H_
