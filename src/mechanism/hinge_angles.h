// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "joints/pair_constants.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

/// Three hinges through one point, R_ij = R(z1, a) R(z2, b) R(z3, c): their angles from the
/// orientation of body j in body i, theory (8).
template <class T>
struct ThreeHinges {
  Vector3<T> z1, z2, z3;   ///< the axes at zero position, unit vectors in the axes of body i
  std::optional<T> start;  ///< of b [rad], if it is known
  Matrix3<T> R_ji;         ///< axes of body i in those of body j, at zero position

  /// The angle of hinge 0, 1 or 2; of the kind kNone if there is no closed form: z1 or z3 is not
  /// normal to z2, or z1 and z3 are parallel and b does not start to one side.
  CoordinateConstants<T> angle(std::size_t hinge) const {
    if (!is_normal(z1, z2) || !is_normal(z2, z3)) return {};
    return is_normal(z1, z3) ? right_angled(hinge) : proper_euler(hinge);
  }

 private:
  using Coordinate = CoordinateConstants<T>;
  static constexpr double kSmall = 1e-18;  // square of a sine or cosine that counts as zero

  static bool is_normal(const Vector3<T>& a, const Vector3<T>& b) {
    const T cosine = dot<T>(a, b);
    return is_less(T(cosine * cosine), T(kSmall), true);
  }

  // The angles about z1 and z3 are arc tangents, the one about z2 an arc sine.
  Coordinate right_angled(std::size_t hinge) const {
    Coordinate c;
    if (hinge == 1) {
      c.kind = Coordinate::Kind::kSine;
      c.sign = is_less(T(0.0), T(dot<T>(z1, cross<T>(z2, z3))), true) ? 1.0 : -1.0;
      c.a = z1;
      c.b = R_ji * z3;
      return c;
    }
    const bool first = hinge == 0;
    c.kind = Coordinate::Kind::kAngle;
    c.sign = first ? 1.0 : -1.0;
    c.a = first ? cross<T>(z1, z3) : z1;
    c.b = R_ji * (first ? z3 : cross<T>(z3, z1));
    c.c = first ? z3 : z1;
    c.d = R_ji * (first ? z3 : z1);
    return c;
  }

  // With gamma, the angle about z2 from z1 to z3, z1 . R z3 = cos(b + gamma): this tells b but for
  // the sign of sin(b + gamma), since (a + pi, -2 gamma - b, c + pi) is the same orientation. The
  // start of b chooses it; without one it is that at zero position.
  Coordinate proper_euler(std::size_t hinge) const {
    using std::sin;
    constexpr double kRightAngle = 1.5707963267948966;
    const Vector3<T> across = cross<T>(z2, z1), after = cross<T>(z2, z3);
    const T gamma = arc_tangent(T(dot<T>(z3, across)), T(dot<T>(z3, z1))),
            sine = sin(T(start ? T(gamma + *start) : gamma));
    Coordinate c;
    if (is_less(T(sine * sine), T(kSmall), false)) return c;
    const double side = is_less(T(0.0), sine, true) ? 1.0 : -1.0;
    if (hinge == 1) {
      c.kind = Coordinate::Kind::kSine;
      c.sign = -side;
      c.offset = T(side * kRightAngle) - gamma;
      c.a = z1;
      c.b = R_ji * z3;
      return c;
    }
    c.kind = Coordinate::Kind::kAngle;
    c.a = T(side) * (hinge == 0 ? z2 : z1);
    c.b = R_ji * (hinge == 0 ? z3 : z2);
    c.c = hinge == 0 ? Vector3<T>(T(side) * across) : Vector3<T>(T(-side) * z1);
    c.d = R_ji * (hinge == 0 ? z3 : after);
    return c;
  }
};

}  // namespace codesign
