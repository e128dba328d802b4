// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace codesign {

class CompiledSystem;
struct StartWorkspace;

/// The time [s] of the first singular position that a given motion passes in which several motions
/// of its loops meet, as of a parallelogram that lies flat: where the determinant of the Jacobian
/// of loops and given motions changes its sign. Nothing if there is none up to the study's
/// duration, if the given motions do not determine that of the loops, or if these have more than 40
/// coordinates.
/// @param start the assembled start; overwritten.
std::optional<double> first_change_point(const CompiledSystem& system, StartWorkspace* start);

}  // namespace codesign
