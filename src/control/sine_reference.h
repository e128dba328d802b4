// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "control/reference_motion.h"
#include "description/reference.h"

namespace codesign {

// The kinds of functions of time, each for one design: what they have in common is
//   set(description, parameters)    becomes the function at these values of all named parameters
//   at(t)                           the function at time t [s]
// and of those that may be the rate of an integral, theory (C2b),
//   prepare_integral(duration)      for times up to the duration [s], after each set()
//   integral_at(t)                  the integral from 0 to t [s] and its derivatives.
// T as for Reference.

/// A constant; doc/theory.md (C1).
template <class T>
class ConstantReference {
 public:
  void set(const Quantity& constant, const std::vector<T>& parameters);
  ReferenceMotion<T> at(double t) const;
  void prepare_integral(double /*duration*/) {}
  ReferenceMotion<T> integral_at(double t) const;

 private:
  T value_{0.0};
};

/// offset + amplitude sin(w t + phase); doc/theory.md (C1).
template <class T>
class SineReference {
 public:
  void set(const SineDescription& sine, const std::vector<T>& parameters);
  ReferenceMotion<T> at(double t) const;
  void prepare_integral(double /*duration*/) {}
  ReferenceMotion<T> integral_at(double t) const;

 private:
  T offset_{0.0}, amplitude_{0.0}, angular_frequency_{0.0}, phase_{0.0};
};

}  // namespace codesign
