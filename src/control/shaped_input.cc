// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/shaped_input.h"

#include "codegen/number_types.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
void ShapedInput<T>::set(const BasisDescription& basis, const std::vector<T>& parameters) {
  basis_ = &basis;
  coefficients_.clear();
  for (const Quantity& coefficient : basis.coefficients)
    coefficients_.push_back(coefficient.at(parameters));
}

template <class T>
ReferenceMotion<T> ShapedInput<T>::at(double t) const {
  const BasisWeights weights = basis_weights(*basis_, t);
  ReferenceMotion<T> motion;
  for (int k = 0; k < weights.count; ++k) {
    const T& coefficient = coefficients_[to_index(weights.first + k)];
    motion.value += T(weights.value[to_index(k)]) * coefficient;
    motion.rate += T(weights.rate[to_index(k)]) * coefficient;
  }
  return motion;
}

void ShapedInput<Traced>::set(const BasisDescription& basis,
                              const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  motion_.value = Traced(recording, recording->timed(SourceId(basis), 0));
  motion_.rate = Traced(recording, recording->timed(SourceId(basis), 1));
}

#define CODESIGN_INSTANTIATE(T) template class ShapedInput<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
