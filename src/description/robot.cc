// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/robot.h"

namespace codesign {

RobotDescription::RobotDescription() = default;
RobotDescription::RobotDescription(const RobotDescription&) = default;
RobotDescription::RobotDescription(RobotDescription&&) noexcept = default;
RobotDescription& RobotDescription::operator=(const RobotDescription&) = default;
RobotDescription& RobotDescription::operator=(RobotDescription&&) noexcept = default;
RobotDescription::~RobotDescription() = default;

}  // namespace codesign
