// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/euler_parameters.h"
#include "math/scalar.h"

namespace codesign {
namespace internal {

template <class T>
T dot4(const Vector4<T>& a, const Vector4<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// B(p, s)^T y = K(y s^T) p, theory (3), computed without forming a matrix.
template <class T>
Vector4<T> gradient_on_p(const Vector4<T>& p, const Vector3<T>& s, const Vector3<T>& y) {
  const Vector3<T> e(p[1], p[2], p[3]), normal = cross(s, y);
  const T sy = T(2.0) * dot(s, y), es = T(2.0) * dot(e, s), ey = T(2.0) * dot(e, y),
          e0 = T(2.0) * p[0];
  return Vector4<T>(p[0] * sy + T(2.0) * dot(e, normal),
                    es * y[0] + ey * s[0] - sy * e[0] + e0 * normal[0],
                    es * y[1] + ey * s[1] - sy * e[1] + e0 * normal[1],
                    es * y[2] + ey * s[2] - sy * e[2] + e0 * normal[2]);
}

}  // namespace internal

}  // namespace codesign
