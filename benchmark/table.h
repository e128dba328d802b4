// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign {

/// A table of a report. `name` marks its place in doc/performance.md.
struct Table {
  std::string name, title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// The table as text for a terminal, with aligned columns; the first column is aligned left.
std::string to_text(const Table& table);

/// The table in Markdown for doc/performance.md, where it stands between the markers `<!-- table:
/// NAME -->` and `<!-- end: NAME -->`.
std::string to_markdown(const Table& table);

/// `value` with three significant digits and no exponent between 0.01 and 100000; "-" if it is not
/// a number.
std::string three_digits(double value);

/// `value` as a power of ten with one digit, as errors and tolerances are written: "3e-07"; "-" if
/// it is not a number.
std::string one_digit(double value);

}  // namespace codesign
