// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/initial_gains.h"
#include "description/robot.h"
#include "description/study.h"

namespace codesign {

/// Gains of a state feedback about the posture of its references, theory (71): the controller
/// without its limits, lag and samples, all others as they are. One per signal.
/// @param study with the values of all parameters at which the gains are those.
/// @throws InputError if the posture is none at rest, with the acceleration that is left, if the
/// signals are not as many as the states and independent, and if no such gains exist.
std::vector<double> find_initial_gains(const RobotDescription& robot, const Study& study,
                                       const InitialGains& of);

}  // namespace codesign
