// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// A warning `waypoint_overshoot` for each function of time of the study and its runs that leaves the range of its way-points by more than
/// a tenth of this range, at the start values of the parameters.
Warnings waypoint_overshoots(const Study& study);

}  // namespace codesign
