// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "codegen/traced.h"
#include "control/expression_reference.h"
#include "control/live_reference.h"
#include "control/reference_motion.h"
#include "control/sampled_reference.h"
#include "control/sine_reference.h"
#include "control/waypoint_reference.h"
#include "description/reference.h"
#include "math/scalar.h"
#include "math/taylor.h"

namespace codesign {

/// start + the integral of a rate from 0 to t, for a motion whose velocity is given; doc/theory.md
/// (C2b).
template <class T>
class IntegralReference {
 public:
  /// @param integral must outlive this if its rate is an expression. @throws std::logic_error for a
  /// rate that has no integral: of samples, of commands, or an integral itself.
  void set(const IntegralDescription& integral, const std::vector<T>& parameters);
  ReferenceMotion<T> at(double t) const;

 private:
  std::variant<ConstantReference<T>, SineReference<T>, WaypointReference<T>, ExpressionReference<T>>
      rate_;
  T start_{0.0};
};

/// A prescribed function of time for one design, of any kind; doc/theory.md (C1), (C2). T: double,
/// std::complex<double>, Lanes<N>, Traced.
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

  /// The function at time t [s].
  ReferenceMotion<T> at(double t) const;

 private:
  std::variant<ConstantReference<T>, SineReference<T>, WaypointReference<T>, SampledReference<T>,
               LiveReference<T>, IntegralReference<T>, ExpressionReference<T>>
      function_;
};

/// For recorded equations: a constant, inputs that are supplied for each instant
/// (Recording::timed()), or an expression with kinks or jumps, which is recorded where it is read,
/// as is one whose integral this is.
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
  void record(const TimeExpression& expression, const std::vector<Traced>& parameters);
  ReferenceMotion<Traced> recorded() const;

  ReferenceMotion<Traced> motion_;
  bool is_integral_ = false;  ///< whether the recorded expression is the rate, motion_ the value
  const Expression* switching_ = nullptr;  ///< the expression that is recorded
  std::vector<Taylor<Traced>> variables_;  ///< its dependencies
};

}  // namespace codesign
