// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fuzz/dice.h"

namespace codesign::fuzz {

/// Reads so many random expressions. One that is refused must be refused by a sentence with a
/// position; one that was made to be right must have the value that plain C++ gives. All scalars
/// must agree on each (description/scalar_agreement.h). Returns the first fault, empty if there is
/// none.
std::string try_expressions(int count, Dice* dice);

}  // namespace codesign::fuzz
