// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace codesign {

/// The work of IDAS since its last restart.
struct IdasCounts {
  std::int64_t steps = 0;
  std::int64_t rejected = 0;  ///< failed error tests and solutions, sensitivities included
};

/// @param ida memory of IDAS. @param with_sensitivities whether it integrates any
IdasCounts count_idas(void* ida, bool with_sensitivities);

}  // namespace codesign
