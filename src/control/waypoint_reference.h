// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "control/time_polynomial.h"
#include "description/reference.h"

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

/// A function of time through way-points; doc/theory.md (C2).
template <class T>
class WaypointReference {
 public:
  void set(const WaypointsDescription& waypoints, const std::vector<T>& parameters);
  /// At a way-point the derivatives of the following piece hold.
  ReferenceMotion<T> at(double t) const;
  void prepare_integral(double duration);
  ReferenceMotion<T> integral_at(double t) const;

 private:
  std::size_t piece_at(double t) const;
  T area_to(double t) const;

  std::vector<Knot<T>> knots_;  ///< workspace of set()
  /// by ascending start; the first begins at minus infinity, the last never ends
  std::vector<TimePolynomial<T>> pieces_;
  std::vector<T> areas_;  ///< per piece but the first: the integral from 0 to its start
};

}  // namespace codesign
