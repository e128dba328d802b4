// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "math/scalar.h"

namespace codesign {

// Euler parameters p = [e0, e] of a body-fixed frame, as in Haug (1989) and the paper;
// doc/theory.md (1)-(4). Every function of p below is homogeneous in p, so that its derivatives
// also hold where |p| differs from 1, and second derivatives are constant matrices.

/// Rotation matrix A(p) = (e0^2 - e.e) I + 2 e e^T + 2 e0 e~, body to ground; theory (1).
/// Orthogonal only for |p| = 1.
template <class T>
Matrix3<T> rotation(const Vector4<T>& p) {
  const T &e0 = p[0], &e1 = p[1], &e2 = p[2], &e3 = p[3];
  const T d = e0 * e0 - e1 * e1 - e2 * e2 - e3 * e3;
  const T e12 = 2.0 * e1 * e2, e13 = 2.0 * e1 * e3, e23 = 2.0 * e2 * e3;
  const T e01 = 2.0 * e0 * e1, e02 = 2.0 * e0 * e2, e03 = 2.0 * e0 * e3;
  Matrix3<T> A;
  A << d + 2.0 * e1 * e1, e12 - e03, e13 + e02,  //
      e12 + e03, d + 2.0 * e2 * e2, e23 - e01,   //
      e13 - e02, e23 + e01, d + 2.0 * e3 * e3;
  return A;
}

/// Directional derivative DA(p)[r], symmetric and linear in p and r: DA(p)[p] = 2 A(p); theory (1).
template <class T>
Matrix3<T> rotation_derivative(const Vector4<T>& p, const Vector4<T>& r) {
  const T d0 = p[0] * r[0], d1 = p[1] * r[1], d2 = p[2] * r[2], d3 = p[3] * r[3];
  const T e12 = p[1] * r[2] + p[2] * r[1], e13 = p[1] * r[3] + p[3] * r[1],
          e23 = p[2] * r[3] + p[3] * r[2];
  const T e01 = p[0] * r[1] + p[1] * r[0], e02 = p[0] * r[2] + p[2] * r[0],
          e03 = p[0] * r[3] + p[3] * r[0];
  Matrix3<T> D;
  D << d0 + d1 - d2 - d3, e12 - e03, e13 + e02,  //
      e12 + e03, d0 - d1 + d2 - d3, e23 - e01,   //
      e13 - e02, e23 + e01, d0 - d1 - d2 + d3;
  return 2.0 * D;
}

/// B(p, s) = d(A(p) s)/dp, 3x4, linear in p and in s; theory (2).
template <class T>
Matrix34<T> rotated_vector_jacobian(const Vector4<T>& p, const Vector3<T>& s) {
  const T &e0 = p[0], &x = p[1], &y = p[2], &z = p[3];
  const T es = x * s[0] + y * s[1] + z * s[2];
  const T c0 = e0 * s[0] + y * s[2] - z * s[1];
  const T c1 = e0 * s[1] + z * s[0] - x * s[2];
  const T c2 = e0 * s[2] + x * s[1] - y * s[0];
  const T d01 = x * s[1] - y * s[0], d02 = x * s[2] - z * s[0], d12 = y * s[2] - z * s[1];
  Matrix34<T> B;
  B << c0, es, e0 * s[2] + d01, -e0 * s[1] + d02,  //
      c1, -e0 * s[2] - d01, es, e0 * s[0] + d12,   //
      c2, e0 * s[1] - d02, -e0 * s[0] - d12, es;
  return 2.0 * B;
}

/// K(W) with p^T K(b s^T) p = 2 b . A(p) s, so that B(p, s)^T b = K(b s^T) p; symmetric, linear in
/// W = sum of b s^T; theory (3).
template <class T>
Matrix4<T> rotation_hessian(const Matrix3<T>& W) {
  const T trace = W(0, 0) + W(1, 1) + W(2, 2);
  Matrix4<T> K;
  K(0, 0) = 2.0 * trace;
  K(0, 1) = K(1, 0) = 2.0 * (W(2, 1) - W(1, 2));
  K(0, 2) = K(2, 0) = 2.0 * (W(0, 2) - W(2, 0));
  K(0, 3) = K(3, 0) = 2.0 * (W(1, 0) - W(0, 1));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      K(i + 1, j + 1) = 2.0 * (W(i, j) + W(j, i) - (i == j ? trace : T(0.0)));
  return K;
}

/// K(W) p without forming K.
template <class T>
Vector4<T> rotation_hessian_product(const Matrix3<T>& W, const Vector4<T>& p) {
  const T trace = W(0, 0) + W(1, 1) + W(2, 2);
  const T w0 = W(2, 1) - W(1, 2), w1 = W(0, 2) - W(2, 0), w2 = W(1, 0) - W(0, 1);
  const T s01 = W(0, 1) + W(1, 0), s02 = W(0, 2) + W(2, 0), s12 = W(1, 2) + W(2, 1);
  const Vector4<T> half(trace * p[0] + w0 * p[1] + w1 * p[2] + w2 * p[3],                      //
                        w0 * p[0] + (2.0 * W(0, 0) - trace) * p[1] + s01 * p[2] + s02 * p[3],  //
                        w1 * p[0] + s01 * p[1] + (2.0 * W(1, 1) - trace) * p[2] + s12 * p[3],  //
                        w2 * p[0] + s02 * p[1] + s12 * p[2] + (2.0 * W(2, 2) - trace) * p[3]);
  return 2.0 * half;
}

/// G(p) = [-e, -e~ + e0 I], 3x4: the angular velocity in body axes is omega' = 2 G(p) dp/dt; theory
/// (4). G(p) r = -G(r) p.
template <class T>
Matrix34<T> body_rate_matrix(const Vector4<T>& p) {
  Matrix34<T> G;
  G << -p[1], p[0], p[3], -p[2],  //
      -p[2], -p[3], p[0], p[1],   //
      -p[3], p[2], -p[1], p[0];
  return G;
}

/// G(p) r without forming G; half the angular velocity in body axes for r = dp/dt.
template <class T>
Vector3<T> body_rate(const Vector4<T>& p, const Vector4<T>& r) {
  return Vector3<T>(p[0] * r[1] - p[1] * r[0] + p[3] * r[2] - p[2] * r[3],  //
                    p[0] * r[2] - p[2] * r[0] + p[1] * r[3] - p[3] * r[1],  //
                    p[0] * r[3] - p[3] * r[0] + p[2] * r[1] - p[1] * r[2]);
}
/// G(p)^T y without forming G.
template <class T>
Vector4<T> body_rate_transposed(const Vector4<T>& p, const Vector3<T>& y) {
  return Vector4<T>(-(p[1] * y[0] + p[2] * y[1] + p[3] * y[2]),  //
                    p[0] * y[0] - p[3] * y[1] + p[2] * y[2],     //
                    p[3] * y[0] + p[0] * y[1] - p[1] * y[2],     //
                    p[1] * y[1] - p[2] * y[0] + p[0] * y[2]);
}

/// E(p) = [-e, e~ + e0 I], 3x4: the angular velocity in ground axes is omega = 2 E(p) dp/dt; theory
/// (4). E(p) r = -E(r) p.
template <class T>
Matrix34<T> ground_rate_matrix(const Vector4<T>& p) {
  Matrix34<T> E;
  E << -p[1], p[0], -p[3], p[2],  //
      -p[2], p[3], p[0], -p[1],   //
      -p[3], -p[2], p[1], p[0];
  return E;
}

/// Y(y) with G(p)^T y = Y(y) p; theory (4).
template <class T>
Matrix4<T> body_rate_hessian(const Vector3<T>& y) {
  Matrix4<T> Y;
  Y << T(0.0), -y[0], -y[1], -y[2],  //
      y[0], T(0.0), y[2], -y[1],     //
      y[1], -y[2], T(0.0), y[0],     //
      y[2], y[1], -y[0], T(0.0);
  return Y;
}

/// Quaternion product p (x) r: rotation(p (x) r) = rotation(p) rotation(r).
template <class T>
Vector4<T> quaternion_product(const Vector4<T>& p, const Vector4<T>& r) {
  Vector4<T> c;
  c << p[0] * r[0] - p[1] * r[1] - p[2] * r[2] - p[3] * r[3],  //
      p[0] * r[1] + p[1] * r[0] + p[2] * r[3] - p[3] * r[2],   //
      p[0] * r[2] - p[1] * r[3] + p[2] * r[0] + p[3] * r[1],   //
      p[0] * r[3] + p[1] * r[2] - p[2] * r[1] + p[3] * r[0];
  return c;
}

/// Euler parameters of a rotation matrix, by Shepperd's method: the largest component comes from
/// the diagonal and is positive.
template <class T>
Vector4<T> euler_parameters(const Matrix3<T>& A) {
  using std::sqrt;
  const T squares[4] = {1.0 + A(0, 0) + A(1, 1) + A(2, 2), 1.0 + A(0, 0) - A(1, 1) - A(2, 2),
                        1.0 - A(0, 0) + A(1, 1) - A(2, 2), 1.0 - A(0, 0) - A(1, 1) + A(2, 2)};
  int largest = 0;
  for (int k = 1; k < 4; ++k)
    if (is_less(squares[largest], squares[k], false)) largest = k;
  const T root = sqrt(squares[largest]);
  const T f = 0.5 / root;
  const T a = A(2, 1) - A(1, 2), b = A(0, 2) - A(2, 0), c = A(1, 0) - A(0, 1);
  const T u = A(1, 0) + A(0, 1), v = A(0, 2) + A(2, 0), w = A(2, 1) + A(1, 2);
  Vector4<T> p;
  switch (largest) {
    case 0:
      p << 0.5 * root, f * a, f * b, f * c;
      break;
    case 1:
      p << f * a, 0.5 * root, f * u, f * v;
      break;
    case 2:
      p << f * b, f * u, 0.5 * root, f * w;
      break;
    default:
      p << f * c, f * v, f * w, 0.5 * root;
      break;
  }
  return p;
}

}  // namespace codesign
