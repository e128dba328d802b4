// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_
#define MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_

#include <type_traits>
#include <vector>

#include "integration/tableau.h"
#include "math/lanes.h"
#include "system/state.h"

namespace codesign {

/// Offsets of the parts of an increment u_i, (15), in one vector [x | v | z | psi] with x = (q, s), so that a sum over stages is one loop.
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

namespace internal {

template <std::size_t count, class T>
void combine_parts(const T* from, const double* factors, const T* const* parts, int length, T* to) {
  int k = 0;
  if constexpr (std::is_same_v<T, double>) {
    using Four = Lanes<4>::Four;
    for (; k + 4 <= length; k += 4) {
      Four sum = *reinterpret_cast<const Four*>(from + k);
      for (std::size_t j = 0; j < count; ++j) sum += factors[j] * *reinterpret_cast<const Four*>(parts[j] + k);
      *reinterpret_cast<Four*>(to + k) = sum;
    }
  }
  for (; k < length; ++k) {
    T sum = from[k];
    for (std::size_t j = 0; j < count; ++j) sum += factors[j] * parts[j][k];
    to[k] = sum;
  }
}

template <std::size_t most, class T>
void combine_up_to(std::size_t count, const T* from, const double* factors, const T* const* parts, int length, T* to) {
  if (count == most) return combine_parts<most>(from, factors, parts, length, to);
  if constexpr (most > 0) combine_up_to<most - 1>(count, from, factors, parts, length, to);
}

}  // namespace internal

/// to = from + sum over j < count of factors[j] parts[j], for `length` numbers, in one pass; count <= RosenbrockTableau::kMaximumStages.
/// `to` may be `from`. The count becomes a template parameter, so that the loop over the parts is unrolled.
template <class T>
void combine(const T* from, const double* factors, const T* const* parts, std::size_t count, int length, T* to) {
  internal::combine_up_to<RosenbrockTableau::kMaximumStages>(count, from, factors, parts, length, to);
}

/// to = from + sum over j < count of factors[j] u_j, for the entries [first, first + size) of each u_j.
template <class T>
void combine(const T* from, const double* factors, const std::vector<VectorX<T>>& u, std::size_t count, int first, int size, T* to) {
  const T* parts[RosenbrockTableau::kMaximumStages];
  for (std::size_t j = 0; j < count; ++j) parts[j] = u[j].data() + first;
  combine(from, factors, parts, count, size, to);
}

/// to = from + sum over j < count of factors[j] u_j, for the parts q, s, v and z of the state.
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
