// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign {

// Regular expressions of the standard library, compiled once: its templates cost seconds in each
// file that uses them.

/// The text with every match of an expression replaced, as std::regex_replace().
std::string replaced_all(const std::string& text, const std::string& expression,
                         const std::string& by);

/// All matches of an expression. @param group 0: the matches, k > 0: their k-th groups, -1: the
/// texts between them.
std::vector<std::string> matches_in(const std::string& text, const std::string& expression,
                                    int group = 0);

/// Whether the whole text is a match.
bool is_match(const std::string& text, const std::string& expression);

}  // namespace codesign
