// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_CONTROLLER_CONSTANTS_H_
#define MECHANISM_CODESIGN_CONTROL_CONTROLLER_CONSTANTS_H_

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
  if (description.kind == ControllerKind::kBasis) c.shape = ShapedInput<T>(description.basis, parameters);
  return c;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_CONTROLLER_CONSTANTS_H_
