// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/ensemble.h"

namespace codesign {

/// The value below which a number of this distribution lies with probability u; doc/theory.md (24b).
///
/// kNormal is exact to about 1e-14 of the larger of `deviation` and the distance from the mean, however far out it is truncated. Where
/// nothing of the normal distribution is left between the bounds (38 deviations away), the value is the bound nearest to the mean. kChoice
/// divides (0, 1) into equal parts, in the order of `choices`.
/// @param u in the open interval (0, 1), as unit_points() gives it; 0 and 1 give the bounds, infinite ones where there are none
/// @param distribution kUniform: finite bounds; kNormal: `deviation` 0 or more; kChoice: at least one choice
double quantile(const Distribution& distribution, double u);

}  // namespace codesign
