// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_SPRING_END_H_
#define MECHANISM_CODESIGN_ELEMENTS_SPRING_END_H_

#include "joints/body_kinematics.h"
#include "joints/local_row.h"
#include "sparse/sparsity.h"

namespace codesign {
namespace internal {

/// One end of a spring-damper with the Jacobians of d, the vector from the first end to the second, theory (13b), by the coordinates of its
/// body: D = d_q = +-[I, B(p, s)] and Dd = (d')_q = +-[0, B(p', s)], with the minus sign for body i.
template <class T>
struct SpringEnd {
  int column = -1;  ///< first coordinate of the body; -1 for the ground
  Eigen::Matrix<T, 3, kBodySize> D, Dd;

  SpringEnd(int body_index, const BodyKinematics<T>& body, const Vector3<T>& s, const T& sign)
      : column(body_index < 0 ? -1 : kBodySize * body_index) {
    D.template leftCols<3>() = sign * Matrix3<T>::Identity();
    D.template rightCols<4>() = sign * rotated_vector_jacobian(body.p, s);
    Dd.template leftCols<3>().setZero();
    Dd.template rightCols<4>() = sign * rotated_vector_jacobian(body.pd, s);
  }

  /// Appends the gradient of b . d by this body's coordinates. @param jacobian D or Dd.
  void append(const Eigen::Matrix<T, 3, kBodySize>& jacobian, const Vector3<T>& b, typename SparseGradient<T>::Entries* entries) const {
    for (int k = 0; column >= 0 && k < kBodySize; ++k) entries->push_back({column + k, dot<T>(jacobian.col(k), b)});
  }
};

}  // namespace internal

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_SPRING_END_H_
