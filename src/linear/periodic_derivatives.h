// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/linear_measure.h"
#include "linear/linear_derivatives.h"
#include "linear/loop_margins.h"

namespace codesign {

/// The derivative of a margin of PeriodicLoop, theory (70c): of a crossing by the pole on the unit
/// circle, which stays there, of a peak at a fixed frequency. Arguments as those of derivative_of()
/// for a loop.
double periodic_derivative_of(const AtFrequency& margin, LinearMeasure::Kind kind, double rest,
                              const ComplexSpace& closed, double period);

}  // namespace codesign
