// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linear/linear_model.h"
#include "linear/linear_study.h"

namespace codesign {

/// The model that a linearization about rest counts with, theory (67a): without friction, with all
/// of it, or at given speeds. Then a joint that moves with the speeds of the study's start has in
/// place of its friction a damping, the slope of its steady friction at that speed, with the normal
/// force and the gear's torque of the posture.
/// @param study of the case. @param rest positions.
/// @throws InputError for given speeds, if no joint of the study starts with one.
RobotDescription counted_robot(const LinearCase& of, const LinearStudy& study,
                               const State<double>& rest);

}  // namespace codesign
