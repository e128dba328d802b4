// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "codegen/traced.h"
#include "math/scalar.h"

// Templates over the scalar that a .cc file defines are instantiated for these types; INSTANTIATE
// is a macro with the type as its argument.

/// The types in which numbers of a design and functions of time are evaluated: real numbers, the
/// complex step, and several directions at once.
#define CODESIGN_FOR_EACH_VALUE_TYPE(INSTANTIATE) \
  INSTANTIATE(double)                             \
  INSTANTIATE(std::complex<double>)               \
  INSTANTIATE(Lanes<4>)                           \
  INSTANTIATE(Lanes<8>)

/// The types of formulas: Traced records them, double serves observers.
#define CODESIGN_FOR_EACH_FORMULA_TYPE(INSTANTIATE) \
  INSTANTIATE(double)                               \
  INSTANTIATE(Traced)
