// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <type_traits>
#include <utility>
#include <vector>

#include "integration/tableau.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "system/state.h"

namespace codesign {

/// Offsets of the parts of an increment u_i, (15), in one vector [x | v | z | psi] with x = (q, s),
/// so that a sum over stages is one loop.
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

/// to = from + sum of factors[j] parts[j], with parts from entry `first` on.
template <std::size_t count, class T>
inline void combine_parts(const T* from, const double* factors, const T* const* parts, int first,
                          int length, T* to) {
  int k = 0;
  // NOLINTBEGIN(clang-analyzer-core.*): `count` parts are there; the analyzer takes it for another
  // number than that of the factors by which they were collected.
  if constexpr (std::is_same_v<T, double>) {
    using Four = Lanes<4>::Four;
    for (; k + 4 <= length; k += 4) {
      Four sum = *reinterpret_cast<const Four*>(from + k);
      for (std::size_t j = 0; j < count; ++j)
        sum += factors[j] * *reinterpret_cast<const Four*>(parts[j] + first + k);
      *reinterpret_cast<Four*>(to + k) = sum;
    }
  }
  for (; k < length; ++k) {
    T sum = from[k];
    for (std::size_t j = 0; j < count; ++j) sum += factors[j] * parts[j][first + k];
    to[k] = sum;
  }
  // NOLINTEND(clang-analyzer-core.*)
}

/// Calls run(std::integral_constant<std::size_t, count>()), so that loops over the stages are
/// unrolled; one expression, which a compiler makes one jump.
template <std::size_t... counts, class Run>
inline void with_count(std::size_t count, std::index_sequence<counts...>, const Run& run) {
  (void)((count == counts && (run(std::integral_constant<std::size_t, counts>()), true)) || ...);
}
using Counts = std::make_index_sequence<RosenbrockTableau::kMaximumStages + 1>;

}  // namespace internal

/// to = from + sum of factors[j] parts[j] in one pass, for as many factors as there are, at most
/// RosenbrockTableau::kMaximumStages. `to` may be `from`.
/// @param parts where each part begins, as the inner loop takes it; each is as long as `to`.
template <class T>
void combine(In<T> from, In<double> factors,
             const T* const (&parts)[RosenbrockTableau::kMaximumStages], Out<T> to) {
  assert(from.size() == to.size() && factors.size() <= RosenbrockTableau::kMaximumStages);
  internal::with_count(to_index(factors.size()), internal::Counts(), [&](auto count) {
    internal::combine_parts<count>(from.data(), factors.data(), parts, 0,
                                   static_cast<int>(to.size()), to.data());
  });
}

/// to = from + sum of factors[j] u_j, for the entries of each u_j from `first` on.
template <class T>
void combine(In<T> from, In<double> factors, const std::vector<VectorX<T>>& u, int first,
             Out<T> to) {
  const T* parts[RosenbrockTableau::kMaximumStages];
  for (std::ptrdiff_t j = 0; j < factors.size(); ++j)
    parts[j] = In<T>(u[to_index(j)]).subspan(first, to.size()).data();
  combine(from, factors, parts, to);
}

/// to = from + sum of factors[j] u_j, for the parts q, s, v and z of the state.
template <class T>
void combine(const IncrementLayout& at, const State<T>& from, In<double> factors,
             const std::vector<VectorX<T>>& u, State<T>* to) {
  const T* parts[RosenbrockTableau::kMaximumStages];
  for (std::ptrdiff_t j = 0; j < factors.size(); ++j) parts[j] = u[to_index(j)].data();
  internal::with_count(to_index(factors.size()), internal::Counts(), [&](auto count) {
    const auto part = [&](const VectorX<T>& begin, int first, VectorX<T>* end) {
      internal::combine_parts<count>(begin.data(), factors.data(), parts, first,
                                     static_cast<int>(end->size()), end->data());
    };
    part(from.q, at.x(), &to->q);
    part(from.s, at.s(), &to->s);
    part(from.v, at.v(), &to->v);
    part(from.z, at.z(), &to->z);
  });
}

}  // namespace codesign
