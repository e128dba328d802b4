// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace codesign {

/// The shortest text that reads back as the same double, independent of the locale: `0.07`,
/// `1e-06`, `inf`, `nan`.
std::string to_decimal(double value);

/// The number that the whole of `text` spells, independent of the locale; std::nullopt if it is not
/// a number or too large for a double. A number too small for a double is 0. `inf` and `nan` are
/// accepted: callers that need a finite number must check.
std::optional<double> parse_number(const std::string& text);

/// The values as to_decimal() writes them, separated by spaces.
std::string format_numbers(const std::vector<double>& values);

/// The value with so many significant digits, for output that people read.
std::string readable(double value, int digits = 10);

bool ends_with(const std::string& text, const std::string& tail);

/// The words of `text` between white space.
std::vector<std::string> split_words(const std::string& text);

}  // namespace codesign
