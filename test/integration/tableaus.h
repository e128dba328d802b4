// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "integration/tableau.h"

namespace codesign {

/// A method that the library does not have, as doc/architecture.md adds one: Rodas3 (Sandu et al.
/// 1997), order 3, 4 stages; its dense output has order 2.
const RosenbrockTableau& rodas3();

/// The methods of the library and the one above.
std::vector<const RosenbrockTableau*> all_tableaus();

/// For tests over all_tableaus().
std::string tableau_name(const ::testing::TestParamInfo<const RosenbrockTableau*>& instance);

}  // namespace codesign
