// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_RECORD_ASSEMBLY_H_
#define MECHANISM_CODESIGN_EQUATIONS_RECORD_ASSEMBLY_H_

#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

/// Assembles the derivatives once, Formulas::assemble(), and records which entry each call adds to. The patterns have Layout::columns()
/// rows of G and one of the integrand g. Columns: Layout::positions() of (q, s), Layout::n of v, Layout::columns() of z.
AssemblyPlan record_assembly(const System& system);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_RECORD_ASSEMBLY_H_
