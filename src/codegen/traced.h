// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "codegen/recording.h"
#include "math/scalar.h"

namespace codesign {

/// A scalar that records the operations applied to it, so that a formula written as a template over
/// the scalar can be compiled for one mechanism. It is a literal (a constant known while recording)
/// or a node of a Recording. Operations among literals, products by zero and one and sums with zero
/// are simplified at once and record nothing.
class Traced {
 public:
  Traced() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): numbers mix with traces in every formula.
  Traced(double literal) : value_(literal) {}
  /// @param value of a node that does not vary: its value for the design for which the recording is
  /// made.
  Traced(Recording* recording, int node, double value = 0.0)
      : recording_(recording), node_(node), value_(value) {}

  bool is_literal() const { return recording_ == nullptr; }
  /// Whether it is the literal x.
  bool is(double x) const { return is_literal() && value_ == x; }
  /// Meaningful for literals and for nodes that do not vary only.
  double value() const { return value_; }
  Recording* recording() const { return recording_; }
  /// The node; -1 for a literal.
  int node() const { return node_; }
  /// The node; a literal gets one in `recording`.
  int node_in(Recording* recording) const {
    return is_literal() ? recording->literal(value_) : node_;
  }

  Traced& operator+=(const Traced& y) { return *this = *this + y; }
  Traced& operator-=(const Traced& y) { return *this = *this - y; }
  Traced& operator*=(const Traced& y) { return *this = *this * y; }
  Traced& operator/=(const Traced& y) { return *this = *this / y; }

  friend Traced operator+(const Traced& x) { return x; }
  friend Traced operator-(const Traced& x);
  friend Traced operator+(const Traced& x, const Traced& y);
  friend Traced operator-(const Traced& x, const Traced& y);
  friend Traced operator*(const Traced& x, const Traced& y);
  friend Traced operator/(const Traced& x, const Traced& y);

 private:
  Recording* recording_ = nullptr;
  int node_ = -1;
  double value_ = 0.0;
};

// The functions that also exist for lanes; angles in radians.
Traced sqrt(const Traced& x);
Traced sin(const Traced& x);
Traced cos(const Traced& x);
Traced asin(const Traced& x);
Traced tanh(const Traced& x);
Traced exp(const Traced& x);
Traced log(const Traced& x);
Traced atan2(const Traced& y, const Traced& x);
Traced round(const Traced& x);
inline Traced arc_tangent(const Traced& y, const Traced& x) { return atan2(y, x); }
inline Traced nearest_integer(const Traced& x) { return round(x); }
/// As in math/scalar.h. Decisions find the number, a literal: one recording holds one number.
Traced whole_below(const Traced& x);
/// As in math/scalar.h: Recording::note().
inline void note_expression(const Traced& x) {
  if (!x.is_literal()) x.recording()->note(x.node());
}
/// As in math/scalar.h: Recording::name_switches().
template <>
struct NamedSwitches<Traced> {
  template <class Source>
  NamedSwitches(const Traced& x, const Source& source) : recording_(x.recording()) {
    if (recording_) recording_->name_switches(SourceId(source));
  }
  ~NamedSwitches() {
    if (recording_) recording_->name_switches(std::nullopt);
  }
  NamedSwitches(const NamedSwitches&) = delete;
  NamedSwitches& operator=(const NamedSwitches&) = delete;

 private:
  Recording* const recording_;
};
/// As in math/scalar.h: Recording::take_all_branches().
inline bool takes_all_branches(const Traced& x) {
  return !x.is_literal() && x.recording()->takes_all_branches();
}
inline void name_part(const Traced& x, int part) {
  if (!x.is_literal()) x.recording()->name_part(part);
}
/// As nearest_turns() in math/scalar.h, also for a reference that varies.
inline Traced nearest_turns(const Traced& reference, const Traced& angle) {
  return 2.0 * M_PI * round((reference - angle) / (2.0 * M_PI));
}

/// The value of a literal. For a node it returns 0 and makes the recording refused(): a branch on
/// the value of a node can only be recorded by is_less().
double value_of(const Traced& x);

/// x < y for literals. Otherwise records a guard and returns its outcome: x < y at the present
/// design if neither varies, else `likely`.
bool is_less(const Traced& x, const Traced& y, bool likely,
             unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE()));
/// The same for a switch, whose guard may be held; see Recording::record_switches().
bool is_below(const Traced& x, const Traced& y, bool likely,
              unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE()));
/// The same for a switch at a kink: SwitchOrigin::is_kink.
bool is_below_kink(const Traced& x, const Traced& y, bool likely,
                   unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE()));

}  // namespace codesign

namespace Eigen {

template <>
struct NumTraits<codesign::Traced> : GenericNumTraits<double> {
  using Real = codesign::Traced;
  using NonInteger = codesign::Traced;
  using Nested = codesign::Traced;
  using Literal = codesign::Traced;
  static Real dummy_precision() { return Real(1e-12); }
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

template <class Operation>
struct ScalarBinaryOpTraits<codesign::Traced, double, Operation> {
  using ReturnType = codesign::Traced;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, codesign::Traced, Operation> {
  using ReturnType = codesign::Traced;
};

}  // namespace Eigen
