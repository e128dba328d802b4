// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_CONTROLLER_CONSTANTS_H_
#define MECHANISM_CODESIGN_CONTROL_CONTROLLER_CONSTANTS_H_

#include <string>
#include <vector>

#include "control/pid.h"
#include "control/reference.h"
#include "control/shaped_input.h"
#include "description/study.h"

namespace codesign {

/// The numbers of one controller at one design.
template <class T>
struct ControllerConstants {
  Reference<T> setpoint, feedforward;
  Pid<T> pid;
  std::vector<T> gains;                  ///< kStateFeedback: one per term
  std::vector<Reference<T>> references;  ///< kStateFeedback: one per term
  ShapedInput<T> shape;                  ///< kBasis
  /// Numbers of ControlRealization; zero if absent.
  T i_clamp{0.0}, derivative_filter{0.0}, output_limit{0.0}, time_constant{0.0};
};

/// Evaluates a description at `parameters`, all named parameters. The description must outlive the result.
template <class T>
ControllerConstants<T> controller_constants(const ControllerDescription& description, const std::vector<T>& parameters) {
  ControllerConstants<T> c;
  c.setpoint = Reference<T>(description.setpoint, parameters);
  c.feedforward = Reference<T>(description.feedforward, parameters);
  c.pid.p = description.p.at(parameters);
  c.pid.i = description.i.at(parameters);
  c.pid.d = description.d.at(parameters);
  for (const FeedbackTerm& term : description.feedback) {
    c.gains.push_back(term.gain.at(parameters));
    c.references.emplace_back(term.reference, parameters);
  }
  const ControlRealization& realization = description.realization;
  if (realization.i_clamp) c.i_clamp = realization.i_clamp->at(parameters);
  if (realization.derivative_filter) c.derivative_filter = realization.derivative_filter->at(parameters);
  if (realization.output_limit) c.output_limit = realization.output_limit->at(parameters);
  if (realization.time_constant) c.time_constant = realization.time_constant->at(parameters);
  if (description.kind == ControllerKind::kBasis) c.shape = ShapedInput<T>(description.basis, parameters);
  return c;
}

/// A sentence about a number of a controller that is impossible at this design; empty if there is none. Gains may be anything.
std::string find_impossible(const ControllerDescription& description, const ControllerConstants<double>& constants);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_CONTROLLER_CONSTANTS_H_
