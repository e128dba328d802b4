// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEXT_NEAREST_NAME_H_
#define MECHANISM_CODESIGN_TEXT_NEAREST_NAME_H_

#include <string>
#include <vector>

namespace codesign {

/// The known name a misspelt one most likely meant: the fewest letters inserted, dropped, replaced or swapped, whatever their case.
/// Names over 100 letters, and names behind the first tens of thousands, are not compared, so that the search takes milliseconds.
/// Returns "" if none is near (more than a third of the longer name differs, at least two letters allowed).
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// `, did you mean "near"?`, or nothing where `near` is empty.
std::string did_you_mean(const std::string& near);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_TEXT_NEAREST_NAME_H_
