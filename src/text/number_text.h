// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEXT_NUMBER_TEXT_H_
#define MECHANISM_CODESIGN_TEXT_NUMBER_TEXT_H_

#include <optional>
#include <string>
#include <vector>

namespace codesign {

/// The whole of `text` as a number, whatever the locale; nothing if it is none. `inf` and `nan` parse, and are left to the caller.
std::optional<double> parse_number(const std::string& text);

/// Space-separated, each the shortest decimal that reads back as the same double.
std::string format_numbers(const std::vector<double>& values);

/// Whether `text` ends with `tail`.
bool ends_with(const std::string& text, const std::string& tail);

/// The words of `text` between white space.
std::vector<std::string> split_words(const std::string& text);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_TEXT_NUMBER_TEXT_H_
