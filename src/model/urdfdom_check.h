// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MODEL_URDFDOM_CHECK_H_
#define MECHANISM_CODESIGN_MODEL_URDFDOM_CHECK_H_

#include <string>

namespace codesign {

/// Lets urdfdom, the parser of robot_state_publisher and rviz, read the text. @throws InputError with urdfdom's own words if it refuses.
void check_with_urdfdom(const std::string& file, const std::string& text);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MODEL_URDFDOM_CHECK_H_
