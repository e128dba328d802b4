// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/rate_solution.h"
#include "math/arrays.h"
#include "sparse/least_squares.h"

namespace codesign {

/// The memory that Assembly::extend() computes in; one per scalar, reused from design to design.
template <class T>
struct ExtensionWorkspace {
  VectorX<T> theta, rate, Phi, Phi_rate;
  Eigen::MatrixXd errors, rows, scaled, changes;  ///< derivatives, one column per direction
  LeastSquaresWorkspace solution;
  RateWorkspace<T> rates;
};

}  // namespace codesign
