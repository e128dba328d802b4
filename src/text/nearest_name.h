// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// The name in `known` that a misspelt `name` most likely stands for: the one with the fewest
/// letters inserted, dropped, replaced or swapped with their neighbour, ignoring case; the first of
/// several equally near ones.
///
/// Returns "" if every known name differs in more than two letters and in more than a third of the
/// longer name. To bound the time, names of more than 100 letters are not compared, and the search
/// stops after 2e7 pairs of letters.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// `, did you mean "near"?`, or "" if `near` is empty.
std::string did_you_mean(const std::string& near);

/// `a, b, c`; only the first 24 names, followed by `...`, if there are more; `there are none` for
/// an empty list.
std::string list_names(const std::vector<std::string>& names);

/// The error for a name that is not in `known`. Its message is `unknown <kind>`, with the nearest
/// known name if there is one: `unknown joint, did you mean "crank_joint"?`; its allowed values are
/// list_names(known).
/// @param kind what the name should denote: "joint", "key", ...
InputError unknown_name(const SourceLocation& where, const std::string& element,
                        const std::string& kind, const std::string& name,
                        const std::vector<std::string>& known);

}  // namespace codesign
