// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "control/signal.h"
#include "mechanism/driven_tree.h"

namespace codesign {

/// Indices of the extra states of a controller as a robot runs it, theory (50)-(53), or -1.
struct ControllerStates {
  int filter = -1;  ///< the filtered error; for a sampled controller the filtered rate of the error
  int last = -1;    ///< sampled: the error at the last sample
  int held = -1;    ///< sampled: the output in effect
  int queue = -1;   ///< sampled: the first of the waiting outputs, whose number is ControlRealization::queued()
  int lag = -1;     ///< the effort after the lag of the drive
};

/// A controller with its names resolved to indices; ControlLaw describes the laws.
struct Controller {
  ControllerKind kind = ControllerKind::kPid;
  Signal input, input_rate;      ///< only if kind->has_error(); input_rate is empty if it is not needed
  std::vector<Signal> feedback;  ///< kStateFeedback: one signal per term
  int pair = -1, element = -1;   ///< the driven coordinate: index in Topology::pairs and in the pair's chain
  int state = -1;                ///< index of its integral among the extra states, or -1
  ControllerStates states;       ///< the other states
  /// The rates of signals that the rate of the output needs, theory (54): the rates of `input` and of `input_rate`, or of `feedback`.
  std::vector<Signal> output_rate;
  bool has_output_rate = false;
  DrivenTree tree;  ///< only of laws with a ControlLoad
};

/// Resolves all controllers of a study, in its order.
/// @param observed other signals that may read controllers: the signals of the objective.
/// @param states number of extra states; grows by one for each integral that is needed.
/// @throws InputError for unknown names, signals that a controller cannot read, and joints that it cannot drive.
std::vector<Controller> resolve_controllers(const Study& study, const RobotDescription& robot, const Topology& topology,
                                            const std::vector<Signal>& observed, int* states);

}  // namespace codesign
