// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "codegen/traced.h"
#include "description/reference.h"
#include "math/scalar.h"
#include "math/taylor.h"

namespace codesign {

/// A way-point: value, rate and second rate.
template <class T>
struct Knot {
  T position{0.0}, velocity{0.0}, acceleration{0.0};
};

/// Coefficients c_k of the polynomial sum c_k tau^k from one way-point to the next, `duration` [s]
/// later; theory (C2).
template <class T>
std::array<T, 6> waypoint_polynomial(Interpolation interpolation, const Knot<T>& from,
                                     const Knot<T>& to, double duration) {
  const T h(duration), zero(0.0), rise = to.position - from.position;
  if (interpolation == Interpolation::kLinear)
    return {from.position, rise / h, zero, zero, zero, zero};
  if (interpolation == Interpolation::kCubic)
    return {from.position,
            from.velocity,
            (T(3.0) * rise / h - T(2.0) * from.velocity - to.velocity) / h,
            (from.velocity + to.velocity - T(2.0) * rise / h) / (h * h),
            zero,
            zero};
  // D, V, A of theory (C2): the errors of the Taylor polynomial of the start at the end, in
  // position, velocity and acceleration.
  const T half = T(0.5) * from.acceleration;
  const T D = rise - h * (from.velocity + h * half),
          V = h * (to.velocity - from.velocity - h * from.acceleration),
          A = T(0.5) * h * h * (to.acceleration - from.acceleration), h3 = h * h * h;
  return {from.position,
          from.velocity,
          half,
          (T(10.0) * D - T(4.0) * V + A) / h3,
          (T(7.0) * V - T(15.0) * D - T(2.0) * A) / (h3 * h),
          (T(6.0) * D - T(3.0) * V + A) / (h3 * h * h)};
}

/// A function of time and its first three time derivatives at one instant.
template <class T>
struct ReferenceMotion {
  T value{0.0}, rate{0.0}, acceleration{0.0}, jerk{0.0};
};

/// A prescribed function of time for one design; doc/theory.md (C1), (C2), or a commanded function,
/// which is read at each call. T: double, std::complex<double>, Lanes<N>, Traced.
template <class T>
class Reference {
 public:
  Reference() = default;
  Reference(const ReferenceDescription& description, const std::vector<T>& parameters) {
    set(description, parameters);
  }
  /// Becomes what the constructor makes. Uses its memory again, so that the same description at
  /// other parameters allocates nothing, unless it is commanded. @param description must outlive
  /// this if it is an expression.
  void set(const ReferenceDescription& description, const std::vector<T>& parameters);

  /// The function at time t [s]. At a way-point the derivatives of the following piece hold.
  ReferenceMotion<T> at(double t) const;

  /// What a function that is commanded prescribes at time t [s].
  static ReferenceMotion<T> commanded_at(const LiveFunction& function, double t);

 private:
  /// The polynomial sum c_k (t - start)^k for t >= start.
  struct Piece {
    double start;
    std::array<T, 6> c;
  };
  /// An instant up to which an expression is integrated, and its Taylor polynomial there.
  struct Panel {
    double begin;
    Taylor<T> series;
    T area;  ///< from 0 to `begin`
  };
  static ReferenceMotion<T> along(const Piece& piece, double t);
  ReferenceMotion<T> sampled_at(double t) const;
  /// The integral from 0 to t, theory (C2b), but of an expression; of way-points after sum_areas().
  T integral_at(double t) const;
  /// @param duration panels of an expression are prepared up to here [s].
  void sum_areas(double duration);
  void set_panels(double duration);
  /// The same of an expression, after sum_areas(). @param there series_at(t)
  T integral_by_panels(double t, const Taylor<T>& there) const;
  Taylor<T> series_at(double t) const;
  std::size_t piece_at(double t) const;
  static T area(const Piece& piece, double duration);
  void set_waypoints(const WaypointsDescription& description, const std::vector<T>& parameters);
  static Piece hold(double start, const T& value);

  ReferenceDescription::Kind kind_ = ReferenceDescription::Kind::kConstant;
  T offset_{0.0}, amplitude_{0.0}, angular_frequency_{0.0}, phase_{0.0};
  /// scaled by amplitude_, early by phase_, minus offset_
  std::shared_ptr<const SampledFunction> samples_;
  std::shared_ptr<const LiveFunction> live_;
  std::shared_ptr<const Reference<T>> planned_;  ///< in effect until a command sets live_
  std::vector<Knot<T>> knots_;                   ///< workspace of set()
  /// by ascending start; the first begins at minus infinity, the last never ends
  std::vector<Piece> pieces_;
  std::vector<Panel> panels_;       ///< kExpression that is integrated: by ascending begin, from 0
  std::vector<T> areas_;            ///< per piece but the first: the integral from 0 to its start
  std::vector<Reference<T>> rate_;  ///< kIntegral: one entry, the rate
  const TimeExpression* expression_ = nullptr;
  std::vector<T> used_;  ///< kExpression: the numbers of its formula's dependencies; of the time: 0
};

/// For recorded equations: a constant, inputs that are supplied for each instant
/// (Recording::timed()), or an expression with kinks or jumps, which is recorded where it is read.
template <>
class Reference<Traced> {
 public:
  Reference() = default;
  Reference(const ReferenceDescription& description, const std::vector<Traced>& parameters) {
    set(description, parameters);
  }
  void set(const ReferenceDescription& description, const std::vector<Traced>& parameters);

  ReferenceMotion<Traced> at(double) const { return switching_ ? recorded() : motion_; }

 private:
  ReferenceMotion<Traced> recorded() const;

  ReferenceMotion<Traced> motion_;
  const Expression* switching_ = nullptr;  ///< the expression that is recorded
  std::vector<Taylor<Traced>> variables_;  ///< its dependencies
};

/// A shaped input u(t) = sum_k c_k B_k(t) for one design; theory (C8). T as for Reference.
template <class T>
class ShapedInput {
 public:
  ShapedInput() = default;
  /// @param basis must outlive the object.
  ShapedInput(const BasisDescription& basis, const std::vector<T>& parameters) {
    set(basis, parameters);
  }
  /// Becomes what the constructor makes; uses its memory again.
  void set(const BasisDescription& basis, const std::vector<T>& parameters);

  const std::vector<T>& coefficients() const { return coefficients_; }

  /// u and u' at time t [s]; higher derivatives are not computed (zero).
  ReferenceMotion<T> at(double t) const;

 private:
  const BasisDescription* basis_ = nullptr;
  std::vector<T> coefficients_;
};

/// For recorded equations: inputs that are supplied for each instant (Recording::timed()).
template <>
class ShapedInput<Traced> {
 public:
  ShapedInput() = default;
  ShapedInput(const BasisDescription& basis, const std::vector<Traced>& parameters) {
    set(basis, parameters);
  }
  void set(const BasisDescription& basis, const std::vector<Traced>& parameters);

  ReferenceMotion<Traced> at(double) const { return motion_; }

 private:
  ReferenceMotion<Traced> motion_;
};

}  // namespace codesign
