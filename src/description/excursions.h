// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "description/motion_study.h"

namespace codesign {

/// Calls visit(reference) for each function of time that a study has.
template <class Visit>
void visit_functions(const MotionStudy& study, const Visit& visit) {
  for (const ControllerDescription& controller : study.controllers) {
    visit(controller.setpoint);
    visit(controller.feedforward);
    for (const FeedbackTerm& term : controller.feedback) visit(term.reference);
  }
  for (const LoadDescription& load : study.loads) {
    visit(load.effort.of_time);
    for (const auto* components : {&load.force, &load.torque})
      for (const LoadFunction& component : *components) visit(component.of_time);
  }
  for (const GivenMotion& motion : study.motion) visit(motion.position);
  for (const ObjectiveTerm& term : study.integral) visit(term.reference);
  for (const WatchedSignal& watched : study.watched) visit(watched.reference);
}

/// Where a function leaves its surroundings for less than a fifth of the interval [0, duration],
/// doc/theory.md (C1): begin, middle and end of each pulse, bump and dip, at half of its height.
/// Those of at least a thousandth of the function's range that last about 1e-4 of the interval or
/// longer are found. @returns instants [s], not in order
std::vector<double> excursions_of(const std::function<double(double)>& function, double duration);

/// The same of all expressions of the time in a study, at the start values of the parameters and
/// beside them, so that a pulse whose height starts at zero counts, too. In ascending order.
std::vector<double> find_excursions(const MotionStudy& study);

}  // namespace codesign
