// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_CONTROLLER_H_
#define MECHANISM_CODESIGN_CONTROL_CONTROLLER_H_

#include <vector>

#include "control/signal.h"
#include "mechanism/driven_tree.h"

namespace codesign {

/// A controller with its names resolved; the laws: ControllerKind.
struct Controller {
  ControllerKind kind = ControllerKind::kPid;
  Signal input, input_rate;      ///< input_rate is empty where nobody asks for it
  std::vector<Signal> feedback;  ///< state feedback, one per term
  int pair = -1, element = -1;
  int state = -1;   ///< index of its integral among the extra states, or -1
  DrivenTree tree;  ///< of laws that know the model
};

/// Resolves all controllers of a study, in its order.
/// @param observed signals beside the controllers' own that may read them: the objective's.
/// @param states grows by one for each integral that is needed.
/// @throws InputError for what does not exist, cannot be read, or cannot be driven.
std::vector<Controller> resolve_controllers(const Study& study, const RobotDescription& robot, const Topology& topology,
                                            const std::vector<Signal>& observed, int* states);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_CONTROLLER_H_
