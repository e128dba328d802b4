// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/warning.h"

namespace codesign {

struct RobotDescription;
struct Study;

/// A warning `nominal_differs` if parameters whose distribution an identification has found have
/// other values in the model: samples lie around the identified values, but nominal runs do not.
Warnings differing_nominals(const Study& study);

/// A warning `unused_parameter` for each tuned and each uncertain parameter on which no number of
/// the model, the study and its runs depends.
Warnings unused_parameters(const Study& study);

/// A warning `fixed_base` if the base has mass, which does nothing since the root link is the
/// ground, and neither the study nor the root link's name says that it stands.
Warnings fixed_base(const RobotDescription& robot, const Study& study);

/// A warning `waypoint_overshoot` for each function of time of the study and its runs that leaves
/// the range of its way-points by more than a tenth of this range, at the start values of the
/// parameters.
Warnings waypoint_overshoots(const Study& study);

}  // namespace codesign
