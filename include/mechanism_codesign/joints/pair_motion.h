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

  /// @param fixed_i, fixed_j whether that body is the ground, on which vectors rest and have no Jacobian.
  void update(const PairRows<T>& rows, const BodyKinematics<T>& i, bool fixed_i, const BodyKinematics<T>& j, bool fixed_j,
              bool with_jacobians) {
    for (std::size_t k = 0; k < rows.vectors.size(); ++k) {
      if (!rows.used[k]) continue;
      const VectorTerm<T>& term = rows.vectors[k];
      const bool fixed = term.side == Side::kI ? fixed_i : fixed_j;
      const BodyKinematics<T>& body = term.side == Side::kI ? i : j;
      motion[k] = fixed ? VectorMotion<T>{term.s, Vector3<T>::Zero(), Vector3<T>::Zero()} : direction_motion(body, term.s);
      if (term.point && !fixed) {
        motion[k].x += body.r;
        motion[k].xd += body.rd;
        motion[k].xdd += body.rdd;
      }
      if (with_jacobians && !fixed) jacobian[k] = vector_jacobian(body, term.s);
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
