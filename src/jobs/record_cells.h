// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "jobs/fields.h"
#include "text/number_text.h"

namespace codesign {

namespace internal {

inline std::string cell_of(const std::string& text) { return text; }
inline std::string cell_of(const char* text) { return text; }
inline std::string cell_of(double value) { return to_decimal(value); }
inline std::string cell_of(int value) { return std::to_string(value); }
inline std::string cell_of(const UnlessEmpty<std::string>& text) { return text.value; }
inline std::string cell_of(bool value) { return value ? "1" : "0"; }

}  // namespace internal

/// The columns of CSV for results of this type: the names of their fields.
template <class Record>
std::vector<std::string> columns_of() {
  std::vector<std::string> columns;
  for_each_field<Record>([&columns](const auto& row) { columns.emplace_back(row.name); });
  return columns;
}

/// Their values.
template <class Record>
std::vector<std::string> cells_of(const Record& record) {
  std::vector<std::string> cells;
  for_each_field<Record>(
      [&](const auto& row) { cells.push_back(internal::cell_of(row.of(record))); });
  return cells;
}

}  // namespace codesign
