// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZER_OPTIONS_H_
#define MECHANISM_CODESIGN_OPTIMIZER_OPTIONS_H_

#include <string>

#include "mechanism_codesign/error.h"

namespace codesign {

/// The block `optimizer:` of a study.
struct OptimizerOptions {
  std::string algorithm = "lbfgs";   ///< as the study spells it: lbfgs, slsqp, mma, ...
  int max_evaluations = 200;         ///< at least 1
  double relative_tolerance = 1e-6;  ///< on the objective, 1e-15 to less than 1
  SourceLocation where;              ///< of the algorithm, for messages
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZER_OPTIONS_H_
