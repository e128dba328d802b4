// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/basis.h"
#include "description/reference.h"

namespace codesign {

/// Indices of the parameters that appear in the numbers of a function of time, ascending, each once.
std::vector<int> dependencies(const ReferenceDescription& description);
std::vector<int> dependencies(const BasisDescription& description);

}  // namespace codesign
