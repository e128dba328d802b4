// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOINTS_PAIR_MOTION_H_
#define MECHANISM_CODESIGN_JOINTS_PAIR_MOTION_H_

#include <array>

#include "mechanism_codesign/joints/pair_rows.h"

namespace codesign {

/// The vectors that a pair's product rows share, in motion; evaluated once for all rows.
template <class T>
struct PairMotion {
  std::array<VectorMotion<T>, PairRows<T>::kVectors> motion;
  std::array<VectorJacobian<T>, PairRows<T>::kVectors> jacobian;

  /// Vectors that are fixed in the ground have no Jacobian.
  void update(const PairRows<T>& rows, const BodyKinematics<T>& i, const BodyKinematics<T>& j, bool with_jacobians) {
    for (std::size_t k = 0; k < rows.vectors.size(); ++k) {
      if (!rows.used[k]) continue;
      const VectorTerm<T>& term = rows.vectors[k];
      const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
      motion[k] = term.point ? point_motion(body, term.s) : direction_motion(body, term.s);
      if (with_jacobians && !body.at_rest) jacobian[k] = vector_jacobian(body, term.s);
    }
  }

  const VectorMotion<T>& of(const VectorTerm<T>& term) const { return motion[static_cast<std::size_t>(term.shared)]; }
  const VectorJacobian<T>& jacobian_of(const VectorTerm<T>& term) const { return jacobian[static_cast<std::size_t>(term.shared)]; }

  VectorMotion<T> of(const PairVector<T>& x) const {
    if (x.terms == 1) return of(x.term[0]);
    const VectorMotion<T>&to = of(x.term[0]), &from = of(x.term[1]);
    return {to.x - from.x, to.xd - from.xd, to.xdd - from.xdd};
  }
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOINTS_PAIR_MOTION_H_
