// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "codegen/traced.h"
#include "control/waypoint_piece.h"
#include "description/reference.h"
#include "math/scalar.h"

namespace codesign {

/// A function of time and its first three time derivatives at one instant.
template <class T>
struct ReferenceMotion {
  T value{0.0}, rate{0.0}, acceleration{0.0}, jerk{0.0};
};

/// A prescribed function of time for one design; doc/theory.md (C1), (C2), or a commanded function, which is read at each call. T: double,
/// std::complex<double>, Lanes<N>, Traced.
template <class T>
class Reference {
 public:
  Reference() = default;
  Reference(const ReferenceDescription& description, const std::vector<T>& parameters) { set(description, parameters); }
  /// Becomes what the constructor makes. Uses its memory again, so that the same description at other parameters allocates nothing, unless
  /// it is commanded.
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
  static ReferenceMotion<T> along(const Piece& piece, double t);
  ReferenceMotion<T> sampled_at(double t) const;
  void set_waypoints(const WaypointsDescription& description, const std::vector<T>& parameters);
  static Piece hold(double start, const T& value);

  ReferenceDescription::Kind kind_ = ReferenceDescription::Kind::kConstant;
  T offset_{0.0}, amplitude_{0.0}, angular_frequency_{0.0}, phase_{0.0};
  std::shared_ptr<const SampledFunction> samples_;  ///< scaled by amplitude_, early by phase_, minus offset_
  std::shared_ptr<const LiveFunction> live_;
  std::shared_ptr<const Reference<T>> planned_;  ///< in effect until a command sets live_
  std::vector<Knot<T>> knots_;                   ///< workspace of set()
  std::vector<Piece> pieces_;                    ///< by ascending start; the first begins at minus infinity, the last never ends
};

/// For recorded equations: a constant, or inputs that are supplied for each instant (Recording::timed()).
template <>
class Reference<Traced> {
 public:
  Reference() = default;
  Reference(const ReferenceDescription& description, const std::vector<Traced>& parameters) { set(description, parameters); }
  void set(const ReferenceDescription& description, const std::vector<Traced>& parameters);

  ReferenceMotion<Traced> at(double) const { return motion_; }

 private:
  ReferenceMotion<Traced> motion_;
};

}  // namespace codesign
