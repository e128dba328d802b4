// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_DIRECTIONS_H_
#define MECHANISM_CODESIGN_SENSITIVITY_DIRECTIONS_H_

#include <Eigen/Core>

#include "mechanism_codesign/math/lanes.h"

namespace codesign {

/// N directional derivatives of a vector, one column per component.
template <int N>
using Directions = Eigen::Matrix<double, N, Eigen::Dynamic>;

/// One component's derivatives as the processor holds them.
template <int N>
typename Lanes<N>::Vector& vector_at(Directions<N>* x, int column) {
  return *reinterpret_cast<typename Lanes<N>::Vector*>(x->data() + N * column);
}
template <int N>
const typename Lanes<N>::Vector& vector_at(const Directions<N>& x, int column) {
  return *reinterpret_cast<const typename Lanes<N>::Vector*>(x.data() + N * column);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_DIRECTIONS_H_
