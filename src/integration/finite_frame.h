// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/frame.h"

namespace codesign {

/// A sentence that names the first joint, friction, controller, link or signal of a frame with a value that is not finite; empty if there
/// is none.
std::string find_not_finite(const FrameNames& names, const Frame& frame);

}  // namespace codesign
