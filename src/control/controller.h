// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_CONTROLLER_H_
#define MECHANISM_CODESIGN_CONTROL_CONTROLLER_H_

#include <vector>

#include "control/signal.h"
#include "mechanism/driven_tree.h"

namespace codesign {

/// Indices among the extra states of what a robot's controller remembers, theory (50)-(53), or -1.
struct ControllerStates {
  int filter = -1;  ///< the filtered error; of a sampled controller the filtered rate of the error
  int last = -1;    ///< sampled: the error at the last sample
  int held = -1;    ///< sampled: the output in effect
  int queue = -1;   ///< sampled: the first of the outputs that wait, as many as ControlRealization::queued()
  int lag = -1;     ///< the effort behind the drive's lag
};

/// A controller with its names resolved to indices; ControllerKind lists the laws.
struct Controller {
  ControllerKind kind = ControllerKind::kPid;
  Signal input, input_rate;      ///< only if has_error(kind); input_rate is empty if it is not needed
  std::vector<Signal> feedback;  ///< kStateFeedback: one signal per term
  int pair = -1, element = -1;   ///< the coordinate it drives: index in Topology::pairs and in the pair's chain
  int state = -1;                ///< index of its integral among the extra states, or -1
  ControllerStates states;       ///< the others
  /// The rates of the signals that its output's rate needs, theory (54): of `input` and then of that rate, or of `feedback`.
  std::vector<Signal> output_rate;
  bool has_output_rate = false;
  DrivenTree tree;  ///< kPdGravity and kComputedTorque only
};

/// Resolves all controllers of a study, in its order.
/// @param observed other signals that may read controllers: those of the objective.
/// @param states number of extra states; grows by one for each integral that is needed.
/// @throws InputError for unknown names, signals that a controller cannot read, and joints that it cannot drive.
std::vector<Controller> resolve_controllers(const Study& study, const RobotDescription& robot, const Topology& topology,
                                            const std::vector<Signal>& observed, int* states);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_CONTROLLER_H_
