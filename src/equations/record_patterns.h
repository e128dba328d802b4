// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

/// The patterns of the derivatives of G and, in one more row, of the integrand g: entry (row, column) is there if the recorded row depends
/// on the column's variable in some branch. Columns: Layout::positions() of (q, s),
/// Layout::n of v, Layout::columns() of z.
ByVariable<Sparsity> record_patterns(const System& system);

}  // namespace codesign
