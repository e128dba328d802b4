// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "integration/mechanisms.h"

namespace codesign {

/// A hinge with everything that may act along a coordinate.
std::string loaded_hinge(const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& xyz);

/// Two bars on such hinges, and a spring-damper from the ground to the lower one.
std::string loaded_arm();

}  // namespace codesign
