// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "control/reference.h"
#include "control/shaped_input.h"
#include "description/study.h"
#include "forces/pid.h"

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
/// @param result new, or of the same description at other parameters; overwritten, its memory is used again.
template <class T>
void controller_constants(const ControllerDescription& description, const std::vector<T>& parameters, ControllerConstants<T>* result) {
  ControllerConstants<T>& c = *result;
  c.setpoint.set(description.setpoint, parameters);
  c.feedforward.set(description.feedforward, parameters);
  c.pid.p = description.p.at(parameters);
  c.pid.i = description.i.at(parameters);
  c.pid.d = description.d.at(parameters);
  c.gains.resize(description.feedback.size());
  c.references.resize(description.feedback.size());
  for (std::size_t k = 0; k < description.feedback.size(); ++k) {
    c.gains[k] = description.feedback[k].gain.at(parameters);
    c.references[k].set(description.feedback[k].reference, parameters);
  }
  const ControlRealization& realization = description.realization;
  if (realization.i_clamp) c.i_clamp = realization.i_clamp->at(parameters);
  if (realization.derivative_filter) c.derivative_filter = realization.derivative_filter->at(parameters);
  if (realization.output_limit) c.output_limit = realization.output_limit->at(parameters);
  if (realization.time_constant) c.time_constant = realization.time_constant->at(parameters);
  if (description.kind->input == ControlInput::kShape) c.shape.set(description.basis, parameters);
}
template <class T>
ControllerConstants<T> controller_constants(const ControllerDescription& description, const std::vector<T>& parameters) {
  ControllerConstants<T> constants;
  controller_constants(description, parameters, &constants);
  return constants;
}

/// A sentence about a number of a controller that is impossible at this design; empty if there is none. Gains may be anything.
std::string find_impossible(const ControllerDescription& description, const ControllerConstants<double>& constants);

}  // namespace codesign
