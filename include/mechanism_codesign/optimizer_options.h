// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/error.h"

namespace codesign {

/// The block `optimizer:` of a study; doc/study.md describes it.
struct OptimizerOptions {
  /// name as in a study: auto, levenberg_marquardt, lbfgs, slsqp, mma, ...
  std::string algorithm = "auto";
  int max_evaluations = 200;  ///< limit of evaluations, at least 1
  /// relative change of the objective at which the search ends; from 1e-15 to less than 1
  double relative_tolerance = 1e-6;
  SourceLocation where;  ///< where the algorithm is named, for messages
};

}  // namespace codesign
