// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_FINITE_FRAME_H_
#define MECHANISM_CODESIGN_INTEGRATION_FINITE_FRAME_H_

#include <string>

#include "mechanism_codesign/frame.h"

namespace codesign {

/// A sentence that names the first joint, friction, controller, link or signal of a frame with a value that is not finite; empty if there
/// is none.
std::string find_not_finite(const FrameNames& names, const Frame& frame);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_FINITE_FRAME_H_
