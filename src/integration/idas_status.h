// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// The Status for a return flag of IDASolve; ok for flags >= 0.
/// @param time reached by the run [s]. @param singular whether the last Newton matrix was singular.
/// @param message of IDAS, or of an exception in a callback; may be empty.
Status idas_status(int flag, double time, bool singular, const std::string& message);

/// The warning that sensitivities were restarted at `time` [s], where the steps had drifted off the constraints. @param drift in
/// tolerances.
Warning sensitivities_restarted(double time, double drift);

}  // namespace codesign
