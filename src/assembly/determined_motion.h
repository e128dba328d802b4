// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/assembly.h"

namespace codesign {

/// Refuses a mechanism whose accelerations are not determined. Bodies may lack mass, or inertia about some axes, as long as v^T M v > 0 for
/// every velocity v that the constraints allow, Phi_q v = 0; doc/theory.md (14a). The check uses the last positions of `assembly` and does
/// nothing if every body has mass and inertia.
/// @param equations must hold the design at `parameters`.
/// @throws InputError that names the link, the axis and the joint rates of a motion without inertia.
void require_determined_motion(const CompiledSystem& system, const std::vector<double>& parameters, const Assembly& assembly,
                               Equations<double>* equations);

}  // namespace codesign
