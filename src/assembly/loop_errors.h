// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/posture.h"
#include "assembly/scaled_loops.h"
#include "assembly/start_design.h"
#include "math/scalar.h"
#include "system/state.h"

namespace codesign {

/// The larger part of a closure error [m or rad].
double size_of(const LoopMiss& miss);

/// The errors of the rows of loops and couplings at a posture, and the memory that they are found
/// in.
struct LoopErrors {
  Eigen::MatrixXd rows;        ///< loops.jacobian.rows() x 1; zero for rows that are not heeded
  VectorX<double> all, rates;  ///< of all constraints
  State<double> state;
  std::vector<LinkMotion<double>> links;

  /// Sets `rows`, and posture->miss from all rows if they are finite. @returns the largest error,
  /// or NaN.
  double find(const TreeLoops& loops, const StartDesign& design, LoopRows heeded, Posture* posture);
};

}  // namespace codesign
