// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "excitation/limit_scan.h"
#include "excitation/trajectory_basis.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// The predicted uncertainty of one number, identified from a recording along a trajectory.
struct PredictedNumber {
  std::string name, unit;
  double nominal = 0.0;       ///< value at which the prediction is made
  bool is_determined = true;  ///< whether any trajectory determines it
  /// standard deviation with the plain trajectory; infinite if that does not determine the number
  double deviation_before = 0.0;
  double deviation = 0.0;                ///< standard deviation with the trajectory found
  double half_before = 0.0, half = 0.0;  ///< half the width of the interval
};

/// A limited signal along the trajectory found.
struct KeptLimit {
  LimitedSignal limits;
  ScannedSignal reached;
};

/// A base parameter, with its predicted standard deviation.
struct PredictedBase {
  std::string expression;
  double deviation_before = 0.0, deviation = 0.0;  ///< with the plain trajectory, and that found
};

/// A trajectory that was given, for comparison: predictions as if it were recorded as it is.
struct ComparedTrajectory {
  Status status;  ///< not ok: the mechanism does not follow it; the other members are empty then
  Eigen::Index samples = 0;
  double rate = 0.0;                   ///< [Hz]
  double criterion = 0.0;              ///< (46a)
  double condition = 0.0;              ///< as ExcitationResult::condition
  Eigen::VectorXd deviations, halves;  ///< of the numbers
  Eigen::VectorXd base;                ///< deviations of the base parameters
  std::vector<KeptLimit> limits;       ///< what it reaches at its samples, within its limits or not

  /// The limit that it breaks by most, relative to the range; null: it keeps all.
  const KeptLimit* broken() const;
};

/// One search.
struct ExcitationStart {
  double initial_criterion = 0.0, criterion = 0.0;
  int evaluations = 0;
  std::string termination;
};

/// The result of excite().
struct ExcitationResult {
  /// ok, also where a prior decides what no trajectory determines; kCancelled, kNotIdentifiable
  /// (the other members are set, too), kInfeasible, or a failure at the start
  Status status;
  std::string termination;                ///< of the best search
  std::vector<PredictedNumber> numbers;   ///< empty: no trajectory was found
  std::vector<std::string> undetermined;  ///< sentences about numbers that no trajectory determines
  /// (46a) of the recordings; infinite if they determine too few numbers
  double criterion_before = 0.0, criterion = 0.0;
  /// BasePrecision::Merit::condition of the plain trajectory and of that found
  double condition_before = 0.0, condition = 0.0;
  std::vector<PredictedBase> base;  ///< empty if the numbers are the base parameters themselves
  std::optional<ComparedTrajectory> compared;
  Warnings warnings;  ///< of its samples
  int counted = 0;    ///< number of identified numbers, or sums of them, in the criterion
  TrajectoryPoints before, points;
  Eigen::VectorXd rest;          ///< positions of the joints at both ends
  Eigen::MatrixXd coefficients;  ///< coefficients of the shapes (45), shapes x joints
  std::vector<KeptLimit> limits;
  std::vector<ExcitationStart> starts;
  int evaluations = 0;
  double cpu_seconds = 0.0;

  /// Factor by which the volume of the confidence ellipsoid is smaller than with the plain
  /// trajectory.
  double volume_factor() const;
};

}  // namespace codesign
