// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/sparsity.h"

#include <algorithm>

namespace codesign {

Sparsity PatternRecorder::build(int rows, int columns, std::vector<int>* slots) const {
  std::vector<std::pair<int, int>> entries = calls_;
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  Sparsity pattern;
  pattern.rows = rows;
  pattern.columns = columns;
  pattern.column_start.assign(static_cast<std::size_t>(columns) + 1, 0);
  for (const auto& [column, row] : entries) {
    ++pattern.column_start[static_cast<std::size_t>(column) + 1];
    pattern.row_index.push_back(row);
  }
  for (std::size_t k = 1; k < pattern.column_start.size(); ++k) pattern.column_start[k] += pattern.column_start[k - 1];
  slots->clear();
  for (const auto& call : calls_) slots->push_back(static_cast<int>(std::lower_bound(entries.begin(), entries.end(), call) - entries.begin()));
  return pattern;
}

}  // namespace codesign
