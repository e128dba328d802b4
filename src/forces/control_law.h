// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "forces/law.h"
#include "math/scalar.h"

namespace codesign {

/// The PID law u = p e + i s + d e', theory (C3), with the error e, its integral s and its rate e'.
/// The gains are the derivatives of u by e, s and e'.
template <class T>
struct Pid {
  T p{0.0}, i{0.0}, d{0.0};

  T output(const T& error, const T& integral, const T& error_rate) const {
    return p * error + i * integral + d * error_rate;
  }
};

/// A saturated effort and its derivative by the requested effort.
template <class T>
struct SaturatedEffort {
  T value{0.0};  ///< [unit of u]
  T slope{0.0};  ///< d value / d u, in (0, 1]
};

/// Smooth saturation of an actuator, doc/theory.md (13c): u / (1 + (u/u_max)^8)^(1/8).
/// Odd and analytic, with gain 1 up to terms of order (u/u_max)^8; its magnitude stays below u_max.
/// @param u requested effort [N m or N]. @param u_max > 0, the limit, in the same unit.
template <class T>
SaturatedEffort<T> saturate(const T& u, const T& u_max) {
  using std::sqrt;
  const auto eighth_root = [](const T& x) { return sqrt(sqrt(sqrt(x))); };
  const T x = u / u_max;
  // Above the limit the formula is written in 1/x, whose powers cannot overflow.
  const bool beyond = is_less(T(1.0), T(x * x), false);
  const T r = beyond ? T(1.0) / x : x, r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const T root = eighth_root(T(1.0) + r8), root9 = (T(1.0) + r8) * root;
  if (!beyond) return {u / root, T(1.0) / root9};
  const T sign(is_less(x, T(0.0), false) ? -1.0 : 1.0);
  return {sign * u_max / root, sign * r8 * r / root9};
}

/// Bounds of a number, lower <= 0 <= upper, in its unit.
template <class T>
struct Bounds {
  T lower{0.0}, upper{0.0};
  bool is_symmetric = true;  ///< lower = -upper, so that no side needs to be chosen

  /// The magnitude of the bound on the side of x.
  T beside(const T& x) const {
    return !is_symmetric && is_less(x, T(0.0), false) ? T(-lower) : upper;
  }
};

/// saturate() with a bound of its own on each side of zero; lower < 0 < upper. At zero, where the
/// sides meet, it has eight continuous derivatives.
template <class T>
SaturatedEffort<T> saturate(const T& u, const Bounds<T>& bounds) {
  return saturate(u, bounds.beside(u));
}

/// The switches of an output limit with corners, for the names of events.
enum LimitPart { kUpperLimit, kLowerLimit, kErrorAtLimit };

/// u within its bounds, with corners that are events, theory (50).
template <class T>
SaturatedEffort<T> cut(const T& u, const Bounds<T>& bounds) {
  name_part(u, kUpperLimit);
  if (is_below_kink(bounds.upper, u, false)) return {bounds.upper, T(0.0)};
  name_part(u, kLowerLimit);
  if (is_below_kink(u, bounds.lower, false)) return {bounds.lower, T(0.0)};
  return {u, T(1.0)};
}

/// The values that a control law is a function of; what ControlLaw does not ask for is zero.
template <class T>
struct ControlValues {
  Pid<T> gains;
  /// e = setpoint - input, its integral and its rate, [unit of the input], s, 1/s
  T error{0.0}, integral{0.0}, error_rate{0.0};
  T clamped{0.0};  ///< k_i times the integral within i_clamp; the integral is then zero
  T load{0.0};     ///< inverse dynamics, see ControlLoad [N m or N]
  /// u_0(t) - sum of K_i (x_i - r_i(t)) of (C7), the shape u(t) of (C8), or e of (49a)
  T given{0.0};

  /// p e + i s + d e' of (C3).
  T pid() const { return gains.output(error, integral, error_rate) + clamped; }
};

/// The output u before any limit [N m or N, positive along the coordinate that the controller
/// drives].
template <class T>
using ControlFunction = T (*)(const ControlValues<T>& x);

/// What a controller reads: keys of the study and, with them, values of ControlValues.
enum class ControlInput {
  kSignal,       ///< `input`, `setpoint` and `gains`: error, integral, rate
  kOwnPosition,  ///< `setpoint` and `gains`; the input is the position of the joint that it drives
  kFeedback,     ///< `feedback` and `feedforward`: given
  kShape,        ///< `shape` and its coefficients, a function of time only: given
  kObserved      ///< the measured position of a joint: given is the innovation of an observer
};

/// Inverse dynamics of the tree that hangs on the driven joint.
enum class ControlLoad {
  kNone,
  kAtRest,  ///< the load that holds it against gravity, (C5)
  /// the load at the accelerations setpoint'' + pid() that all controllers of this kind demand,
  /// (C6)
  kDemanded
};

/// A control law, one row of the table in control_law.cc: its name, what it reads, and one function
/// of values; doc/theory.md (C3)-(C8).
struct ControlLaw {
  const char* name = "";  ///< the value of the controller's `type`
  Law<ControlFunction> output{};
  const char* gains = "";  ///< the letters of the gains that the study may give
  ControlInput input = ControlInput::kSignal;
  ControlLoad load = ControlLoad::kNone;
  bool reads_rate = false;  ///< whether it reads the rate of the error, if there is a gain d
  /// whether the output is pid(), which a robot may also sample, clamp and filter, (50)-(52)
  bool is_pid = false;

  /// Whether the law compares an input with a setpoint.
  bool has_error() const {
    return input == ControlInput::kSignal || input == ControlInput::kOwnPosition;
  }
};

/// The law of a controller.
class ControllerKind : public RowReference<ControlLaw> {
 public:
  using RowReference::RowReference;
  static const ControllerKind kPid,  ///< p e + i int e dt + d de/dt, with e = setpoint - input
      kPdGravity,  ///< p e + d de/dt + the load that holds the joint against gravity
      /// inverse dynamics of the tree at the acceleration setpoint'' + d de/dt + p e
      kComputedTorque,
      kStateFeedback,  ///< feedforward - sum gain (signal - reference)
      kBasis,          ///< a shaped input, a function of time only
      kObserver;       ///< the innovation of an observer of a joint
};

/// The library's control laws, by name.
std::vector<ControllerKind> control_laws();

}  // namespace codesign
