// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_RECORD_ASSEMBLY_H_
#define MECHANISM_CODESIGN_EQUATIONS_RECORD_ASSEMBLY_H_

#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

/// Assembles the derivatives once and records where they go. Rows: Layout::columns() equations, then the integrand g. Columns:
/// Layout::position_column() for positions, coordinates for velocities, Layout::columns() for rates.
AssemblyPlan record_assembly(const System& system);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_RECORD_ASSEMBLY_H_
