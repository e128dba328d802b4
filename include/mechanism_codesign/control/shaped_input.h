// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_SHAPED_INPUT_H_
#define MECHANISM_CODESIGN_CONTROL_SHAPED_INPUT_H_

#include <vector>

#include "mechanism_codesign/control/reference.h"
#include "mechanism_codesign/model/basis.h"

namespace codesign {

/// A shaped input u(t) = sum_k c_k B_k(t) and its rate, theory (C8). Higher derivatives are left at zero.
/// @param coefficients the c_k of the design.
template <class T>
ReferenceMotion<T> shaped_input(const BasisDescription& basis, const std::vector<T>& coefficients, double t) {
  const BasisWeights weights = basis_weights(basis, t);
  ReferenceMotion<T> motion;
  for (int k = 0; k < weights.count; ++k) {
    const T& coefficient = coefficients[static_cast<std::size_t>(weights.first + k)];
    motion.value += T(weights.value[static_cast<std::size_t>(k)]) * coefficient;
    motion.rate += T(weights.rate[static_cast<std::size_t>(k)]) * coefficient;
  }
  return motion;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_SHAPED_INPUT_H_
