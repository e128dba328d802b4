// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/status.h"

namespace codesign {

/// Code, time and cause of a status: "step_size_too_small at t = 0.5 s: the step size fell below ...".
std::string describe(const Status& status);

/// Cause and time of a status, for replies that have the code in a field of its own: "the step size fell below ... (at t = 0.5 s)".
std::string reason(const Status& status);

}  // namespace codesign
