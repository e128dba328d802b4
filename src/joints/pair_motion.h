// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "joints/pair_rows.h"

namespace codesign {

/// The motion of the vectors that a pair's product rows share (PairRows::vectors), evaluated once for all rows.
template <class T>
struct PairMotion {
  std::array<VectorMotion<T>, PairRows<T>::kVectors> motion;
  VectorMotion<T> displacement;  ///< from the point of i to the point of j

  /// Evaluates the vectors that are used.
  void update(const PairRows<T>& rows, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
    for (std::size_t k = 0; k < rows.vectors.size(); ++k) {
      if (!rows.used[k]) continue;
      const VectorTerm<T>& term = rows.vectors[k];
      const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
      motion[k] = term.point ? point_motion(body, term.s) : direction_motion(body, term.s);
    }
    constexpr auto from = static_cast<std::size_t>(PairRows<T>::shared(Side::kI, PairRows<T>::kPoint)),
                   to = static_cast<std::size_t>(PairRows<T>::shared(Side::kJ, PairRows<T>::kPoint));
    if (rows.used[from]) displacement = {motion[to].x - motion[from].x, motion[to].xd - motion[from].xd, motion[to].xdd - motion[from].xdd};
  }

  const VectorMotion<T>& of(const VectorTerm<T>& term) const { return motion[static_cast<std::size_t>(term.shared)]; }

  /// The motion of a direction of the rows, or of the displacement.
  const VectorMotion<T>& of(const PairVector<T>& x) const { return x.terms == 1 ? of(x.term[0]) : displacement; }
};

}  // namespace codesign
