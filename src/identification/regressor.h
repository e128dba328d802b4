// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <string>
#include <vector>

#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/status.h"
#include "recordings/joint_recording.h"
#include "statistics/time_series.h"

namespace codesign {

/// The derivatives of the efforts that recorded motions need by the numbers of an identification,
/// doc/theory.md (28b), with the study's filters as in a fit. Of numbers in which efforts are
/// linear, as the inertial numbers of free inertias are, it is the regressor.
struct Regressor {
  /// ok, or that of the first sample whose efforts cannot be computed; the members below are then
  /// empty
  Status status;
  std::vector<std::string> outputs;  ///< the joints whose motion determines all; then signals
  SeriesLengths lengths;             ///< rows of each recording
  std::vector<double> times;         ///< one per row [s]
  /// rows x outputs [N m or N], of joints without the known offset of their sensors
  Eigen::MatrixXd computed;
  /// Free inertias by the numbers in which efforts are linear: LINK_m and so on.
  std::vector<std::string> names;
  Eigen::VectorXd values;  ///< of the numbers
  Eigen::MatrixXd matrix;  ///< (rows outputs) x numbers, the rows of output 0 first
  /// What the motion determines, (32): combinations of the numbers with their values, and those
  /// columns of the matrix that belong to them: base * base_values = matrix * values.
  std::vector<std::string> base_names;
  Eigen::VectorXd base_values;
  std::vector<int> base_columns;
};

/// @param problem with tuned parameters and a block `identify`. @param x of
/// FitVariables: the point of the derivatives; empty: the start. @param recordings all with the
/// same joints; efforts need not be recorded, and do not count
/// @throws InputError as identify()
Regressor find_regressor(const Problem& problem, const Eigen::VectorXd& x,
                         std::vector<JointRecording> recordings, const std::atomic<bool>* cancel);

}  // namespace codesign
