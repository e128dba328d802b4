// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/study.h"

namespace codesign {

/// The instants [s] at which a study's functions of time have a kink or begin to move, doc/theory.md (C1). Integrators end a step there: a
/// step across a kink loses its order, and a long step from rest could skip a motion that begins within it. For a function through samples
/// these are the instants of all samples, since its second derivative jumps there; they are shifted by the start value of its delay.
class BreakTimes {
 public:
  explicit BreakTimes(const Study& study);

  /// The first break time after `t` if it is before `limit`, else `limit`; all in [s].
  double next(double t, double limit) const;
  /// All break times [s], ascending.
  const std::vector<double>& times() const { return times_; }

 private:
  void add(const ReferenceDescription& reference);

  std::vector<double> times_;  ///< ascending
  double apart_;               ///< [s] a break time less than this after t counts as reached
};

}  // namespace codesign
