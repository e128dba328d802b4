// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// Where the gains of a state feedback start, `gains: {from: ...}`: its parameters `NAME_k0`, ...,
/// one per signal, begin with those that place the poles of its loop, or that minimize the integral
/// of sum weights_k signal_k^2 + effort u^2; theory (71).
struct InitialGains {
  std::size_t controller = 0;           ///< index in Study::controllers
  std::vector<int> parameters;          ///< of the gains, in the order of the signals
  std::vector<double> weights;          ///< of the signals; empty: by poles
  double effort = 1.0;                  ///< weight of the squared output
  std::vector<double> real, imaginary;  ///< the poles [1/s]
  SourceLocation where;
};

}  // namespace codesign
