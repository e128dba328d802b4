// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fuzz/dice.h"

namespace codesign::fuzz {

/// `text` with one random change: of a value, a name, a line, a few bytes, or of its end.
std::string mutate_text(const std::string& text, Dice* dice);

/// An XML text with an element or attribute taken away, doubled, moved or renamed; unchanged if it
/// is not valid XML.
std::string mutate_xml(const std::string& text, Dice* dice);

/// An expression of `names` that is well formed or nearly so.
std::string random_expression(const std::vector<std::string>& names, int depth, Dice* dice);

}  // namespace codesign::fuzz
