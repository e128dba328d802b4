// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparsity.h"

#include <algorithm>

namespace codesign {

Sparsity PatternRecorder::build(const Calls& calls, int rows, int columns, std::vector<int>* slots) {
  Calls entries = calls;
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  Sparsity pattern;
  pattern.rows = rows;
  pattern.columns = columns;
  pattern.row_start.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const auto& [row, column] : entries) {
    ++pattern.row_start[static_cast<std::size_t>(row) + 1];
    pattern.column_index.push_back(column);
  }
  for (std::size_t k = 1; k < pattern.row_start.size(); ++k) pattern.row_start[k] += pattern.row_start[k - 1];
  slots->clear();
  std::vector<bool> touched(entries.size(), false);
  for (const auto& call : calls) {
    const auto slot = std::lower_bound(entries.begin(), entries.end(), call) - entries.begin();
    slots->push_back(touched[static_cast<std::size_t>(slot)] ? static_cast<int>(slot) : ~static_cast<int>(slot));
    touched[static_cast<std::size_t>(slot)] = true;
  }
  return pattern;
}

}  // namespace codesign
