// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_
#define MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_

#include <vector>

#include "mechanism_codesign/dynamics/state.h"

namespace codesign {

/// Where an increment's parts stand in one vector [x | v | z | psi] with x = (q, s); sums over stages are then single loops.
struct IncrementLayout {
  int n, states, x_size, z_size;

  explicit IncrementLayout(const Layout& layout)
      : n(layout.n), states(layout.states), x_size(layout.positions()), z_size(layout.columns()) {}

  int x() const { return 0; }
  int s() const { return n; }
  int v() const { return x_size; }
  int z() const { return x_size + n; }
  int sigma() const { return z() + z_size - states; }
  int psi() const { return z() + z_size; }
  int size() const { return psi() + 1; }
};

/// to = from + sum over j < count of factors[j] u_j, of the entries [first, first + size) of each u_j. In one pass: sums stay in registers.
template <class T>
void combine(const T* from, const double* factors, const std::vector<VectorX<T>>& u, std::size_t count, int first, int size, T* to) {
  constexpr int kBlock = 4;
  int k = 0;
  for (; k + kBlock <= size; k += kBlock) {
    T sum[kBlock];
    for (int b = 0; b < kBlock; ++b) sum[b] = from[k + b];
    for (std::size_t j = 0; j < count; ++j) {
      const T* const other = u[j].data() + first + k;
      for (int b = 0; b < kBlock; ++b) sum[b] += factors[j] * other[b];
    }
    for (int b = 0; b < kBlock; ++b) to[k + b] = sum[b];
  }
  for (; k < size; ++k) {
    T sum = from[k];
    for (std::size_t j = 0; j < count; ++j) sum += factors[j] * u[j][first + k];
    to[k] = sum;
  }
}

/// to = from + sum over j < count of factors[j] u_j, in all parts of the state.
template <class T>
void combine(const IncrementLayout& at, const State<T>& from, const double* factors, const std::vector<VectorX<T>>& u, std::size_t count,
             State<T>* to) {
  combine(from.q.data(), factors, u, count, at.x(), at.n, to->q.data());
  combine(from.s.data(), factors, u, count, at.s(), at.states, to->s.data());
  combine(from.v.data(), factors, u, count, at.v(), at.n, to->v.data());
  combine(from.z.data(), factors, u, count, at.z(), at.z_size, to->z.data());
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_
