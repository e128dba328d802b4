// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "forces/friction_numbers.h"
#include "forces/law.h"
#include "math/scalar.h"

namespace codesign {

/// The states of a friction law with bristles; theory (13e), (13f). They start in steady sliding,
/// (13j), which at rest is zero, or hold a joint that starts stuck, (13h).
template <class T>
struct BristleState {
  /// deflection times sigma_0, which is a friction per normal force [-]; one per slip direction
  Vector3<T> zeta = Vector3<T>::Zero();
  T dwell{0.0};  ///< s_dw [-]: 1 after a long rest, 0 while sliding; Gonthier's model only
};

/// Friction and the rates of the states at one instant.
template <class T>
struct Bristle {
  Vector3<T> mu = Vector3<T>::Zero();    ///< friction per normal force, opposing u [-]
  Vector3<T> rate = Vector3<T>::Zero();  ///< zeta' [1/s]
  T dwell_rate{0.0};                     ///< s_dw' [1/s]
};

/// The friction S(v) per normal force as a function of the sliding velocity [m/s], odd in v; theory
/// (10), (10a). mu_static and mu_dynamic may be those of one direction or a difference of both.
template <class T>
using FrictionCurve = T (*)(const T& v, const T& mu_static, const T& mu_dynamic,
                            const FrictionNumbers<T>& c);
/// S(|u|)/|u| [s/m] as a function of u.u; theory (13a).
template <class T>
using FrictionPerSpeed = T (*)(const T& square, const T& mu_static, const T& mu_dynamic,
                               const T& v_t);
/// Friction per normal force and rates of the states; theory (13e), (13f).
template <class T>
using BristleFunction = Bristle<T> (*)(const Vector3<T>& u, const BristleState<T>& state,
                                       const FrictionNumbers<T>& c);

/// The states of a contact that has slid at u for long; theory (13j). Zero at rest, and continuous
/// in u.
template <class T>
using SteadyFunction = BristleState<T> (*)(const Vector3<T>& u, const FrictionNumbers<T>& c);

/// A friction law, one row of the table in friction_law.cc: its name, and one function of values. A
/// law without states has `curve`, a law with states `bristle`.
struct FrictionLaw {
  const char* name = "";   ///< the value of `<codesign:friction model>`
  const char* title = "";  ///< its name in sentences
  Law<FrictionCurve> curve{};
  /// for joints that slip in several directions; without it, curve(|u|)/|u| just beside rest
  Law<FrictionPerSpeed> per_speed{};
  Law<BristleFunction> bristle{};  ///< zeta for each slip coordinate
  bool dwells = false;             ///< `bristle` also has the state s_dw
  /// `curve` is linear in mu_s and mu_d, which may differ for motion against the axis, theory (48)
  bool directional = false;
  bool divides_by_mu_dynamic = false;  ///< mu_dynamic must not be zero
  bool has_stribeck_velocity = false;  ///< `curve` reads it
  /// transition_velocity shapes nothing but the friction above mu_d: without mu_s > mu_d it has no
  /// effect
  bool only_above_mu_dynamic = false;
  Law<SteadyFunction> steady{};  ///< where contacts start that slip; without it at zero

  /// Whether the law uses a number; other numbers are refused, since they would have no effect.
  bool uses(const FrictionNumberRule& rule) const {
    using L = FrictionNumberRule::Laws;
    return rule.laws == L::kAll || (rule.laws == L::kBristles && bristle) ||
           (rule.laws == L::kDwelling && dwells) || (rule.laws == L::kDirectional && directional) ||
           (rule.laws == L::kStribeck && has_stribeck_velocity);
  }
};

/// The friction law of a joint.
class FrictionModel : public RowReference<FrictionLaw> {
 public:
  using RowReference::RowReference;
  static const FrictionModel kBrownMcPhee, kGonthier, kLuGre, kStribeck;
};

/// The library's friction laws.
std::vector<FrictionModel> friction_laws();

/// S(|u|)/|u| [s/m] of a law without states as a function of u.u [m^2/s^2].
template <class T>
T per_speed(const FrictionLaw& law, const T& square, const FrictionNumbers<T>& c) {
  using std::sqrt;
  if (law.per_speed)
    return law.per_speed.of<T>(square, c.mu_static, c.mu_dynamic, c.transition_velocity);
  // Speed over v_t that counts as rest, where the quotient has a limit but no value.
  constexpr double kRest = 1e-6;
  const T rest = kRest * c.transition_velocity, speed = sqrt(square + rest * rest);
  return law.curve.of<T>(speed, c.mu_static, c.mu_dynamic, c) / speed;
}

}  // namespace codesign
