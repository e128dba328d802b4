// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_JOINTS_COORDINATE_H_
#define MECHANISM_CODESIGN_JOINTS_COORDINATE_H_

#include <cmath>

#include "mechanism_codesign/joints/scalar_product.h"
#include "mechanism_codesign/math/elementary.h"
#include "mechanism_codesign/model/constants.h"

namespace codesign {

/// A joint's scalar coordinate theta with its rate and acceleration, and their gradients over the pair's coordinates; doc/theory.md (8).
///
/// `J` maps velocities to the rate (rate = J v) and, transposed, a load on the joint to generalized forces, so that power balances exactly.
template <class T>
struct CoordinateMotion {
  T position{0.0}, rate{0.0}, acceleration{0.0};
  LocalRow<T> position_q = LocalRow<T>::Zero(), J = LocalRow<T>::Zero(), rate_q = LocalRow<T>::Zero(), acceleration_q = LocalRow<T>::Zero(),
              acceleration_v = LocalRow<T>::Zero();
};

namespace internal {

/// N/D-type angle: theta = atan2(N, D) with N, D scalar products; all derivatives by the quotient rule on the unit circle.
template <class T>
void angle_motion(const ProductMotion<T>& N, const ProductGradient<T>& Ng, const ProductMotion<T>& D, const ProductGradient<T>& Dg,
                  CoordinateMotion<T>* m) {
  const T square = N.phi * N.phi + D.phi * D.phi;
  const T c = D.phi / square, s = N.phi / square;
  m->position = arc_tangent(N.phi, D.phi);
  m->J = c * Ng.phi_q - s * Dg.phi_q;
  m->position_q = m->J;
  const T ratio = (N.phid * N.phi + D.phid * D.phi) / square;  // half the relative growth rate of N^2 + D^2
  m->rate = c * N.phid - s * D.phid;
  const LocalRow<T> square_q = T(2.0) * (N.phi * Ng.phi_q + D.phi * Dg.phi_q) / square;
  const LocalRow<T> cross_q = (Dg.phi_q * N.phid - Ng.phi_q * D.phid) / square;
  m->rate_q = c * Ng.phid_q - s * Dg.phid_q + cross_q - m->rate * square_q;
  m->acceleration = c * N.phidd - s * D.phidd - T(2.0) * m->rate * ratio;
  const LocalRow<T> ratio_q = (Ng.phi_q * N.phid + Dg.phi_q * D.phid + Ng.phid_q * N.phi + Dg.phid_q * D.phi) / square - ratio * square_q;
  const LocalRow<T> outer_q = (Dg.phi_q * N.phidd - Ng.phi_q * D.phidd) / square - (c * N.phidd - s * D.phidd) * square_q;
  m->acceleration_q = c * Ng.phidd_q - s * Dg.phidd_q + outer_q - T(2.0) * (m->rate_q * ratio + m->rate * ratio_q);
  const LocalRow<T> ratio_v = (Ng.phi_q * N.phi + Dg.phi_q * D.phi) / square;
  m->acceleration_v = T(2.0) * (c * Ng.phid_q - s * Dg.phid_q) - T(2.0) * (m->J * ratio + m->rate * ratio_v);
}

template <class T>
struct Product {
  ProductMotion<T> motion;
  ProductGradient<T> gradient;
};

template <class T>
Product<T> product(const PairVector<T>& X, const PairVector<T>& Y, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  const VectorMotion<T> x = motion_of(X, i, j), y = motion_of(Y, i, j);
  return {product_motion(x, y), product_gradient(X, Y, x, y, i, j)};
}

template <class T>
Product<T> directions_product(const Vector3<T>& a_i, const Vector3<T>& b_j, const BodyKinematics<T>& i, const BodyKinematics<T>& j) {
  return product(PairVector<T>::direction(Side::kI, a_i), PairVector<T>::direction(Side::kJ, b_j), i, j);
}

/// A rate that is linear in p and in p': R(p_j) p_j' . u_j - R(p_i) p_i' . u_i with R(p) r = -R(r) p, so that no arc tangent is
/// differentiated.
/// @param rate_matrix p -> G(p) or E(p), @param u_i, u_j carried by the bodies (for G) or fixed in the ground (for E).
template <class T, class RateMatrix>
void angular_rate(const RateMatrix& rate_matrix, const Vector3<T>& u_i, const Vector3<T>& u_j, const BodyKinematics<T>& i,
                  const BodyKinematics<T>& j, CoordinateMotion<T>* m) {
  m->J.setZero();
  m->rate = m->acceleration = T(0.0);
  m->rate_q.setZero();
  m->acceleration_q.setZero();
  m->acceleration_v.setZero();
  const auto add = [&](Side side, const BodyKinematics<T>& body, const Vector3<T>& u) {
    const Vector4<T> gradient = rate_matrix(body.p).transpose() * u;
    m->J.template segment<4>(p_offset(side)) = gradient;
    for (int k = 0; k < 4; ++k) {
      m->rate += gradient[k] * body.pd[k];
      m->acceleration += gradient[k] * body.pdd[k];
    }
    m->rate_q.template segment<4>(p_offset(side)) = -(rate_matrix(body.pd).transpose() * u);
    m->acceleration_q.template segment<4>(p_offset(side)) = -(rate_matrix(body.pdd).transpose() * u);
  };
  add(Side::kJ, j, u_j);
  add(Side::kI, i, u_i);
}

/// About the common axis, 2 u_j . G(p_j) p_j' - 2 u_i . G(p_i) p_i'.
template <class T>
void turn_rate(const PairConstants<T>& pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, CoordinateMotion<T>* m) {
  angular_rate<T>([](const Vector4<T>& p) { return body_rate_matrix(p); }, Vector3<T>(T(-2.0) * pair.C_i.col(2)),
                  Vector3<T>(T(2.0) * pair.C_j.col(2)), i, j, m);
}

/// About a ground axis, 2 a . (E(p_j) p_j' - E(p_i) p_i').
template <class T>
void spin_rate(const Vector3<T>& a, const BodyKinematics<T>& i, const BodyKinematics<T>& j, CoordinateMotion<T>* m) {
  angular_rate<T>([](const Vector4<T>& p) { return ground_rate_matrix(p); }, Vector3<T>(T(-2.0) * a), Vector3<T>(T(2.0) * a), i, j, m);
}

template <class T>
void sine_motion(const Product<T>& s, CoordinateMotion<T>* m) {
  using std::asin;
  using std::sqrt;
  const ProductMotion<T>& f = s.motion;
  const T square = T(1.0) - f.phi * f.phi, k = T(1.0) / sqrt(square), k3 = k / square;
  m->position = asin(f.phi);
  m->J = m->position_q = k * s.gradient.phi_q;
  m->rate = k * f.phid;
  m->rate_q = k * s.gradient.phid_q + (k3 * f.phi * f.phid) * s.gradient.phi_q;
  const T curvature = k3 * f.phi;
  m->acceleration = k * f.phidd + curvature * f.phid * f.phid;
  const T curvature_slope = k3 + T(3.0) * k3 * f.phi * f.phi / square;
  m->acceleration_q = k * s.gradient.phidd_q + (curvature * f.phidd + curvature_slope * f.phid * f.phid) * s.gradient.phi_q +
                      (T(2.0) * curvature * f.phid) * s.gradient.phid_q;
  m->acceleration_v = T(2.0) * (k * s.gradient.phid_q + (curvature * f.phid) * s.gradient.phi_q);
}

template <class T>
void apply_sign(double sign, CoordinateMotion<T>* m) {
  if (sign > 0.0) return;
  m->position = -m->position;
  m->rate = -m->rate;
  m->acceleration = -m->acceleration;
  for (LocalRow<T>* row : {&m->position_q, &m->J, &m->rate_q, &m->acceleration_q, &m->acceleration_v}) *row = -*row;
}

}  // namespace internal

/// How much of a coordinate is asked for.
enum class CoordinateDetail {
  kRate,  ///< rate and J
  kAll    ///< position, acceleration and all gradients too
};

/// The direction or displacement products of a sliding coordinate.
template <class T>
PairVector<T> slide_axis(const CoordinateConstants<T>& c) {
  return PairVector<T>::direction(c.fixed_in_j ? Side::kJ : Side::kI, c.a);
}

/// Evaluates one coordinate of a pair. A turn's position lies in (-pi, pi]; whole turns are counted by the caller.
template <class T>
CoordinateMotion<T> coordinate_motion(const PairConstants<T>& pair, const CoordinateConstants<T>& c, const BodyKinematics<T>& i,
                                      const BodyKinematics<T>& j, CoordinateDetail detail = CoordinateDetail::kAll) {
  using Kind = typename CoordinateConstants<T>::Kind;
  CoordinateMotion<T> m;
  if (c.kind == Kind::kTurn && detail == CoordinateDetail::kRate) {
    internal::turn_rate(pair, i, j, &m);
  } else if (c.kind == Kind::kSlide) {
    const auto s = internal::product(slide_axis(c), PairVector<T>::displacement(pair.s_i, pair.s_j), i, j);
    m.position = s.motion.phi;
    m.rate = s.motion.phid;
    m.acceleration = s.motion.phidd;
    m.J = m.position_q = s.gradient.phi_q;
    m.rate_q = s.gradient.phid_q;
    m.acceleration_q = s.gradient.phidd_q;
    m.acceleration_v = T(2.0) * s.gradient.phid_q;
  } else if (c.kind == Kind::kSpin) {
    internal::spin_rate(c.a, i, j, &m);
  } else if (c.kind == Kind::kSine) {
    internal::sine_motion(internal::directions_product(c.a, c.b, i, j), &m);
  } else if (c.kind != Kind::kNone) {
    const bool turn = c.kind == Kind::kTurn;
    const auto N =
        turn ? internal::directions_product<T>(pair.C_i.col(1), pair.C_j.col(0), i, j) : internal::directions_product(c.a, c.b, i, j);
    const auto D =
        turn ? internal::directions_product<T>(pair.C_i.col(0), pair.C_j.col(0), i, j) : internal::directions_product(c.c, c.d, i, j);
    internal::angle_motion(N.motion, N.gradient, D.motion, D.gradient, &m);
    if (turn) internal::turn_rate(pair, i, j, &m);
  }
  internal::apply_sign(c.sign, &m);
  return m;
}

namespace internal {

/// Calls add(row, column, value) with weight (X . Y)_qq.
template <class T, class Add>
void add_product_curvature(const PairVector<T>& X, const PairVector<T>& Y, const T& weight, const BodyKinematics<T>& i,
                           const BodyKinematics<T>& j, const Add& add) {
  product_hessian(X, Y, weight, i, j, add);
  BodyLoad<T> load_i, load_j;
  add_product_load(X, Y, motion_of(X, i, j), motion_of(Y, i, j), weight, &load_i, &load_j);
  const auto add_turning = [&](Side side, const Matrix3<T>& W) {
    const Matrix4<T> K = rotation_hessian(W);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) add(p_offset(side) + row, p_offset(side) + column, K(row, column));
  };
  add_turning(Side::kI, load_i.W);
  add_turning(Side::kJ, load_j.W);
}

/// Calls add(row, column, value) with weight (a b^T + b a^T)/2 over the pair's Euler parameters.
template <class T, class Add>
void add_outer_product(const LocalRow<T>& a, const LocalRow<T>& b, const T& weight, const Add& add) {
  const T half = T(0.5) * weight;
  for (int row = 0; row < kLocalSize; ++row)
    for (int column = 0; column < kLocalSize; ++column)
      if (row % kBodySize >= 3 && column % kBodySize >= 3) add(row, column, T(half * (a[row] * b[column] + b[row] * a[column])));
}

/// theta_qq of theta = atan2(N, D) or asin(N), by the chain rule.
template <class T, class Add>
void add_angle_curvature(const CoordinateConstants<T>& c, const BodyKinematics<T>& i, const BodyKinematics<T>& j, const T& load,
                         const Add& add) {
  using std::sqrt;
  const PairVector<T> a = PairVector<T>::direction(Side::kI, c.a), b = PairVector<T>::direction(Side::kJ, c.b);
  const Product<T> N = product(a, b, i, j);
  const T n = N.motion.phi;
  if (c.kind == CoordinateConstants<T>::Kind::kSine) {
    const T square = T(1.0) - n * n, slope = T(1.0) / sqrt(square);
    add_product_curvature(a, b, T(load * slope), i, j, add);
    add_outer_product(N.gradient.phi_q, N.gradient.phi_q, T(load * slope * n / square), add);
    return;
  }
  const PairVector<T> e = PairVector<T>::direction(Side::kI, c.c), f = PairVector<T>::direction(Side::kJ, c.d);
  const Product<T> D = product(e, f, i, j);
  const T d = D.motion.phi, square = n * n + d * d, weight = load / square, curvature = weight / square;
  add_product_curvature(a, b, T(weight * d), i, j, add);
  add_product_curvature(e, f, T(-weight * n), i, j, add);
  add_outer_product(N.gradient.phi_q, N.gradient.phi_q, T(T(-2.0) * curvature * n * d), add);
  add_outer_product(D.gradient.phi_q, D.gradient.phi_q, T(T(2.0) * curvature * n * d), add);
  add_outer_product(N.gradient.phi_q, D.gradient.phi_q, T(T(2.0) * curvature * (n * n - d * d)), add);
}

}  // namespace internal

/// Calls add(row, column, value) with (J^T load)_q.
template <class T, class Add>
void coordinate_load_gradient(const PairConstants<T>& pair, const CoordinateConstants<T>& c, const BodyKinematics<T>& i,
                              const BodyKinematics<T>& j, const T& load, const Add& add) {
  using Kind = typename CoordinateConstants<T>::Kind;
  const T signed_load = T(c.sign) * load;
  const auto add_block = [&add](Side side, const Matrix4<T>& block) {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) add(p_offset(side) + row, p_offset(side) + column, block(row, column));
  };
  const T twice = T(2.0) * signed_load;
  switch (c.kind) {
    case Kind::kTurn:
      add_block(Side::kJ, body_rate_hessian<T>(twice * pair.C_j.col(2)));
      add_block(Side::kI, body_rate_hessian<T>(-twice * pair.C_i.col(2)));
      return;
    case Kind::kSpin:
      add_block(Side::kJ, ground_rate_hessian<T>(twice * c.a));
      add_block(Side::kI, ground_rate_hessian<T>(-twice * c.a));
      return;
    case Kind::kSlide:
      internal::add_product_curvature(slide_axis(c), PairVector<T>::displacement(pair.s_i, pair.s_j), signed_load, i, j, add);
      return;
    case Kind::kAngle:
    case Kind::kSine:
      internal::add_angle_curvature(c, i, j, signed_load, add);
      return;
    case Kind::kNone:
      return;
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_JOINTS_COORDINATE_H_
