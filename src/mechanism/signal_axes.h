// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/robot.h"
#include "description/signal.h"

namespace codesign {

/// Checks what stands behind the @ of `NAME/QUANTITY/x@LINK`, and that a sum or difference adds
/// components of vectors in the same axes: of forces that two joints exert on two links that turn
/// against each other, no sum of components is a component of the sum. In an expression, the sums
/// and differences of signals and of their multiples are checked; products, as in the square of a
/// magnitude, and functions are not. Quantities of different units are no parts of one vector.
/// @throws InputError naming the axes and what to write.
void check_axes(const SignalDescription& signal, const RobotDescription& robot,
                const std::string& element);

/// The index of the link that a term names behind its @. @param term checked by check_axes().
int link_of_axes(const SignalTerm& term, const RobotDescription& robot);

}  // namespace codesign
