// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_PARAMETER_H_
#define MECHANISM_CODESIGN_PARAMETER_H_

#include <limits>
#include <string>

#include "mechanism_codesign/error.h"

namespace codesign {

/// A named design or control parameter, one entry of rho.
struct Parameter {
  std::string name;
  double value = 0.0;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string unit;
  SourceLocation where;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_PARAMETER_H_
