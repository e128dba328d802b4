// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_DETERMINED_MOTION_H_
#define MECHANISM_CODESIGN_ASSEMBLY_DETERMINED_MOTION_H_

#include "assembly/assembly.h"

namespace codesign {

/// Bodies may lack mass, or inertia about some axes, as long as the mass matrix M is positive definite on every motion that the constraints
/// allow, {v: Phi_q v = 0}; doc/theory.md (14a). Decided at the configuration that `assembly` found last, and only where a body lacks
/// something.
/// @param equations hold the design at `parameters`.
/// @throws InputError naming the link and the direction of a motion without inertia.
void require_determined_motion(const CompiledSystem& system, const std::vector<double>& parameters, const Assembly& assembly,
                               Equations<double>* equations);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_DETERMINED_MOTION_H_
