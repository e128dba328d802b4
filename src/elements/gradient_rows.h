// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_GRADIENT_ROWS_H_
#define MECHANISM_CODESIGN_ELEMENTS_GRADIENT_ROWS_H_

#include "elements/state_view.h"
#include "sparse/sparsity.h"

namespace codesign {

// Functions that append entries to a sparse gradient. `with_r` says whether the entries by r of the bodies may differ from zero; if not
// they are left out. Entries that belong to the ground are always left out.

/// The mark of the present end of a gradient, with which SparseGradient::scale_from() scales the entries appended later. `gradient` may be
/// null.
template <class T>
typename SparseGradient<T>::Mark mark(const SparseGradient<T>* gradient) {
  return gradient ? gradient->mark() : typename SparseGradient<T>::Mark{0, 0, 0, T(0.0)};
}

/// Appends factor times a gradient over the 14 local coordinates of a pair. @param entries the positions, velocities or rates of a
/// gradient.
template <class T>
void append_local(const StateView<T>& view, int pair, const LocalRow<T>& row, const T& factor, bool with_r,
                  typename SparseGradient<T>::Entries* entries) {
  for (int local = 0; local < kLocalSize; ++local) {
    const int c = view.column(pair, local);
    if (c < 0 || (local % kBodySize < 3 && !with_r)) continue;
    entries->push_back({c, T(factor * row[local])});
  }
}

/// Appends factor times the gradient of the rate theta' of a joint coordinate, by positions and velocities; theory (8). `motion` must have
/// detail kGradient and `gradient` must not be null, here and below.
template <class T>
void append_rate(const StateView<T>& view, int pair, int element, const CoordinateMotion<T>& motion, const T& factor,
                 OptionalGradient<T> gradient) {
  const bool with_r = view.coordinate_moves_r(pair, element);
  append_local(view, pair, motion.rate_q, factor, with_r, &gradient->position);
  append_local(view, pair, motion.J, factor, with_r, &gradient->velocity);
}

/// Appends factor times the gradient of theta'', by positions, velocities and accelerations.
template <class T>
void append_acceleration(const StateView<T>& view, int pair, int element, const CoordinateMotion<T>& motion, const T& factor,
                         OptionalGradient<T> gradient) {
  const bool with_r = view.coordinate_moves_r(pair, element);
  append_local(view, pair, motion.acceleration_q, factor, with_r, &gradient->position);
  append_local(view, pair, motion.acceleration_v, factor, with_r, &gradient->velocity);
  append_local(view, pair, motion.J, factor, with_r, &gradient->rate);
}

/// Appends factor times the gradient of axis . omega', omega' = 2 G(p) p' the angular velocity of a body in its own axes, theory (4).
/// @param index the body, not the ground. @param axis in body axes.
template <class T>
void append_body_rate(const StateView<T>& view, int index, const Vector3<T>& axis, const T& factor, OptionalGradient<T> gradient) {
  const BodyKinematics<T>& k = view.body(index);
  const Vector3<T> twice = (T(2.0) * factor) * axis;
  const Vector4<T> by_pd = body_rate_transposed(k.p, twice), by_p = -body_rate_transposed(k.pd, twice);
  for (int e = 0; e < 4; ++e) {
    gradient->velocity.push_back({kBodySize * index + 3 + e, by_pd[e]});
    gradient->position.push_back({kBodySize * index + 3 + e, by_p[e]});
  }
}

/// Appends the gradient of factor . omega, omega = 2 E(p) p' the angular velocity of a body in ground axes, theory (4).
/// @param index the body, not the ground. @param factor in ground axes.
template <class T>
void append_spin(const StateView<T>& view, int index, const Vector3<T>& factor, OptionalGradient<T> gradient) {
  const BodyKinematics<T>& k = view.body(index);
  const Vector4<T> by_p = T(-2.0) * (ground_rate_matrix(k.pd).transpose() * factor);
  const Vector4<T> by_pd = T(2.0) * (ground_rate_matrix(k.p).transpose() * factor);
  for (int e = 0; e < 4; ++e) {
    gradient->position.push_back({kBodySize * index + 3 + e, by_p[e]});
    gradient->velocity.push_back({kBodySize * index + 3 + e, by_pd[e]});
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_GRADIENT_ROWS_H_
