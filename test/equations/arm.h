// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// A crane's tree: a trolley that slides, a mast that turns on it, a boom that slides out, a
/// gripper on a hinge, with skew frames and centres of mass; and a bob that hangs on the boom by a
/// ball joint. @param more further elements.
std::string crane(const std::string& more = "");

}  // namespace codesign
