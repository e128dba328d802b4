// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

#include "mechanism_codesign/error.h"

namespace codesign {

/// A design parameter: a named number on which numbers of model or study may depend. If the study
/// tunes it, it is an entry of rho.
struct Parameter {
  std::string name;
  double value = 0.0;                                       ///< start value, in SI units
  double lower = -std::numeric_limits<double>::infinity();  ///< lower bound; -infinity: none
  double upper = std::numeric_limits<double>::infinity();   ///< upper bound; infinity: none
  std::string unit;                                         ///< for display only; may be empty
  SourceLocation where;                                     ///< where it is declared, for messages
};

}  // namespace codesign
