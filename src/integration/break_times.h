// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_BREAK_TIMES_H_
#define MECHANISM_CODESIGN_INTEGRATION_BREAK_TIMES_H_

#include <vector>

#include "description/study.h"

namespace codesign {

/// The instants at which a study's functions of time have a kink or begin to move. A step across one would lose its order, or, from rest,
/// overlook what happens within it; integrators therefore end steps there.
class BreakTimes {
 public:
  explicit BreakTimes(const Study& study);

  /// The first one after `t`, if it comes before `limit`; else `limit`.
  double next(double t, double limit) const;

 private:
  void add(const ReferenceDescription& reference);

  std::vector<double> times_;  ///< ascending
  double apart_;               ///< nearer ones count as reached [s]
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_BREAK_TIMES_H_
