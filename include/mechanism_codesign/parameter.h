// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PARAMETER_H_
#define MECHANISM_CODESIGN_PARAMETER_H_

#include <limits>
#include <string>

#include "mechanism_codesign/error.h"

namespace codesign {

/// A named design or control parameter; an entry of rho if a study tunes it.
struct Parameter {
  std::string name;
  double value = 0.0;                                       ///< default, and start of an optimization
  double lower = -std::numeric_limits<double>::infinity();  ///< bound of the optimization
  double upper = std::numeric_limits<double>::infinity();   ///< bound of the optimization
  std::string unit;                                         ///< for display only; may be empty
  SourceLocation where;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PARAMETER_H_
