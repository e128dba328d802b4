// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "joints/pair_constants.h"
#include "joints/pair_rows.h"
#include "math/scalar.h"

namespace codesign {

/// Which members of CoordinateMotion to compute; each includes those before it.
enum class CoordinateDetail {
  kRate,          ///< rate and J
  kAcceleration,  ///< acceleration
  kAll            ///< position
};

/// A joint coordinate theta with its rate and acceleration, and the gradient J of the rate by the
/// pair's 14 velocities; doc/theory.md (8).
///
/// rate = J v, and a load L that opposes the coordinate enters the equations of motion as +J^T L,
/// so that its power is exactly -L * rate. Members that CoordinateDetail excludes are not
/// initialized.
template <class T>
struct CoordinateMotion {
  T position, rate, acceleration;  ///< [rad or m], per s, per s^2
  LocalRow<T> J;
};

namespace internal {

/// All members except the position for theta = atan2(N, D), with scalar products N and D, by the
/// quotient rule.
template <class T>
void angle_motion(const ProductMotion<T>& N, const LocalRow<T>& N_q, const ProductMotion<T>& D,
                  const LocalRow<T>& D_q, CoordinateMotion<T>* m) {
  const T square = N.phi * N.phi + D.phi * D.phi;
  const T c = D.phi / square, s = N.phi / square;
  m->J = c * N_q - s * D_q;
  const T ratio =
      (N.phid * N.phi + D.phid * D.phi) / square;  // half the relative growth rate of N^2 + D^2
  m->rate = c * N.phid - s * D.phid;
  m->acceleration = c * N.phidd - s * D.phidd - 2.0 * m->rate * ratio;
}

/// A scalar product with its gradient by the pair's coordinates.
template <class T>
struct Product {
  ProductMotion<T> motion;
  LocalRow<T> phi_q;
};

template <class T>
Product<T> product(const PairVector<T>& X, const PairVector<T>& Y, const BodyKinematics<T>& i,
                   const BodyKinematics<T>& j) {
  const VectorMotion<T> x = motion_of(X, i, j), y = motion_of(Y, i, j);
  return {product_motion(x, y), product_gradient(X, Y, x, y, i, j)};
}

/// The product of the direction a_i, fixed in body i, and b_j, fixed in body j.
template <class T>
Product<T> directions_product(const Vector3<T>& a_i, const Vector3<T>& b_j,
                              const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  return product(PairVector<T>::direction(Side::kI, a_i), PairVector<T>::direction(Side::kJ, b_j),
                 i, j);
}

/// The rate u_i . R(p_i) p_i' + u_j . R(p_j) p_j' with R = G or E, so that no arc tangent need be
/// differentiated.
/// @param rate_matrix p -> R(p). @param to_body (A, u) -> u in body axes. @param u_i, u_j fixed in
/// the bodies (G) or in the ground (E), factor and sign included.
template <class T, class RateMatrix, class ToBody>
void angular_rate(const RateMatrix& rate_matrix, const ToBody& to_body, const Vector3<T>& u_i,
                  const Vector3<T>& u_j, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                  CoordinateDetail detail, CoordinateMotion<T>* m) {
  m->J.setZero();
  m->rate = m->acceleration = T(0.0);
  const auto add = [&](Side side, const BodyKinematics<T>& body, const Vector3<T>& u) {
    if (body.at_rest) return;
    if (body.in_forest) {
      const Vector3<T> along = T(0.5) * to_body(body.A, u);  // omega' = 2 G p', omega = 2 E p'
      m->J.template segment<3>(p_offset(side)) = along;
      m->rate += dot<T>(along, body.omega);
      if (detail != CoordinateDetail::kRate) m->acceleration += dot<T>(along, body.alpha);
      return;
    }
    const Vector4<T> row = rate_matrix(body.p).transpose() * u;
    m->J.template segment<4>(p_offset(side)) = row;
    for (int k = 0; k < 4; ++k) m->rate += row[k] * body.pd[k];
    if (detail == CoordinateDetail::kRate) return;
    for (int k = 0; k < 4; ++k) m->acceleration += row[k] * body.pdd[k];
  };
  add(Side::kJ, j, u_j);
  add(Side::kI, i, u_i);
}

/// The rate of a turn about the common axis, 2 u_j . G(p_j) p_j' - 2 u_i . G(p_i) p_i'.
template <class T>
void turn_rate(const PairConstants<T>& pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
               CoordinateDetail detail, CoordinateMotion<T>* m) {
  angular_rate<T>([](const Vector4<T>& p) { return body_rate_matrix(p); },
                  [](const Matrix3<T>&, const Vector3<T>& u) { return u; },
                  Vector3<T>(T(-2.0) * pair.C_i.col(2)), Vector3<T>(2.0 * pair.C_j.col(2)), i, j,
                  detail, m);
}

/// The rate of a turn about a ground axis a, 2 a . (E(p_j) p_j' - E(p_i) p_i').
template <class T>
void spin_rate(const Vector3<T>& a, const BodyKinematics<T>& i, const BodyKinematics<T>& j,
               CoordinateDetail detail, CoordinateMotion<T>* m) {
  angular_rate<T>(
      [](const Vector4<T>& p) { return ground_rate_matrix(p); },
      [](const Matrix3<T>& A, const Vector3<T>& u) { return Vector3<T>(A.transpose() * u); },
      Vector3<T>(T(-2.0) * a), Vector3<T>(2.0 * a), i, j, detail, m);
}

/// All members except the position for theta = asin(s), with the scalar product s.
template <class T>
void sine_motion(const Product<T>& s, CoordinateMotion<T>* m) {
  using std::sqrt;
  const ProductMotion<T>& f = s.motion;
  const T square = 1.0 - f.phi * f.phi, k = 1.0 / sqrt(square), k3 = k / square;
  m->J = k * s.phi_q;
  m->rate = k * f.phid;
  m->acceleration = k * f.phidd + k3 * f.phi * f.phid * f.phid;
}

/// Multiplies the members that `detail` includes, except the position, by the sign.
template <class T>
void apply_sign(double sign, CoordinateDetail detail, CoordinateMotion<T>* m) {
  if (sign > 0.0) return;
  m->rate = -m->rate;
  m->J = -m->J;
  if (detail == CoordinateDetail::kRate) return;
  m->acceleration = -m->acceleration;
}

}  // namespace internal

/// The axis of a sliding coordinate as a vector over the pair.
template <class T>
PairVector<T> slide_axis(const CoordinateConstants<T>& c) {
  return PairVector<T>::direction(c.fixed_in_j ? Side::kJ : Side::kI, c.a);
}

/// The value of a coordinate [rad or m]; 0 for kSpin and kNone, which have none. Arc tangents lie
/// in (-pi, pi]; the caller adds whole turns.
template <class T>
T coordinate_position(const PairConstants<T>& pair, const CoordinateConstants<T>& c,
                      const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  using Kind = typename CoordinateConstants<T>::Kind;
  using std::asin;
  const auto cosine = [&](const Vector3<T>& a, const Vector3<T>& b) {
    return dot<T>(i.A * a, j.A * b);
  };
  const T sign(c.sign);
  switch (c.kind) {
    case Kind::kTurn:
      return sign * arc_tangent(cosine(pair.C_i.col(1), pair.C_j.col(0)),
                                cosine(pair.C_i.col(0), pair.C_j.col(0)));
    case Kind::kAngle:
      return sign * arc_tangent(cosine(c.a, c.b), cosine(c.c, c.d));
    case Kind::kSine:
      return c.offset + sign * asin(cosine(c.a, c.b));
    case Kind::kSlide:
      return sign *
             dot<T>((c.fixed_in_j ? j : i).A * c.a, j.r + j.A * pair.s_j - i.r - i.A * pair.s_i);
    case Kind::kSpin:
    case Kind::kNone:
      break;
  }
  return T(0.0);
}

namespace internal {

/// All members except the position for a sliding coordinate, a scalar product itself.
template <class T>
void slide_motion(const PairConstants<T>& pair, const CoordinateConstants<T>& c,
                  const BodyKinematics<T>& i, const BodyKinematics<T>& j, CoordinateDetail detail,
                  CoordinateMotion<T>* m) {
  const auto s = product(slide_axis(c), PairVector<T>::displacement(pair.s_i, pair.s_j), i, j);
  m->rate = s.motion.phid;
  m->J = s.phi_q;
  if (detail != CoordinateDetail::kRate) m->acceleration = s.motion.phidd;
}

/// All members except the position for kAngle and kSine.
template <class T>
void angle_or_sine_motion(const CoordinateConstants<T>& c, const BodyKinematics<T>& i,
                          const BodyKinematics<T>& j, CoordinateMotion<T>* m) {
  const auto N = directions_product(c.a, c.b, i, j);
  if (c.kind == CoordinateConstants<T>::Kind::kSine) {
    sine_motion(N, m);
    return;
  }
  const auto D = directions_product(c.c, c.d, i, j);
  angle_motion(N.motion, N.phi_q, D.motion, D.phi_q, m);
}

}  // namespace internal

/// Evaluates one coordinate of a pair; its position as coordinate_position().
template <class T>
CoordinateMotion<T> coordinate_motion(const PairConstants<T>& pair, const CoordinateConstants<T>& c,
                                      const BodyKinematics<T>& i, const BodyKinematics<T>& j,
                                      CoordinateDetail detail = CoordinateDetail::kAll) {
  using Kind = typename CoordinateConstants<T>::Kind;
  CoordinateMotion<T> m;
  switch (c.kind) {
    case Kind::kTurn:
      internal::turn_rate(pair, i, j, detail, &m);
      break;
    case Kind::kSlide:
      internal::slide_motion(pair, c, i, j, detail, &m);
      break;
    case Kind::kSpin:
      internal::spin_rate(c.a, i, j, detail, &m);
      break;
    case Kind::kAngle:
    case Kind::kSine:
      internal::angle_or_sine_motion(c, i, j, &m);
      break;
    case Kind::kNone:
      m.rate = m.acceleration = T(0.0);
      m.J.setZero();
      break;
  }
  internal::apply_sign(c.sign, detail, &m);
  if (detail == CoordinateDetail::kAll) m.position = coordinate_position(pair, c, i, j);
  return m;
}

}  // namespace codesign
