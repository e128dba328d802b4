// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace codesign {

/// A change of the formulas within a run: a comparison changes its outcome, `sign`, `abs`, `min`,
/// `max`, `floor` or `ceil` passes to another branch, or a law of the mechanism does; doc/theory.md
/// (17d). A step ends there. Switches that change at the same instant are one event, named after
/// the first of them.
struct Event {
  double time = 0.0;  ///< [s]
  /// its place in the study, such as `loads[0].effort` or `objective.integral[1].signal`, or `joint
  /// "slide"`
  std::string element;
  std::string object;  ///< joint or link on which the element acts; empty: none
  /// the comparison or function as the user wrote it, or the law's guard in words: "touch of the
  /// upper stop"
  std::string expression;
  /// Whether the comparison becomes true, the argument of `sign`, `abs`, `floor` or `ceil` rises
  /// through the value at which they switch, a later argument of `min` or `max` takes over, or a
  /// stop is touched; else the opposite.
  bool rising = false;
  /// Whether accelerations, multipliers, rates of states or the integrand jump; else they have a
  /// kink.
  bool jump = false;
};

/// Element, expression, direction and kind: "loads[0].effort, \"t < 0.8\", falling, a jump".
std::string describe(const Event& event);

/// The events of a run in the order of their times.
struct Events {
  std::vector<Event> list;  ///< the first ones, at most 500
  std::int64_t count = 0;   ///< of all
  /// Differs where elements, expressions, directions or the order of the listed events differ;
  /// their times do not count, nor does the order within 1e-9 of the duration. Empty: none.
  std::string order;
};

}  // namespace codesign
