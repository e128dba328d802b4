// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "edited_text.h"
#include "paths.h"

namespace codesign {

inline std::vector<std::string> split_at(const std::string& text, const std::string& separator) {
  return matches_in(text, separator, -1);
}

/// The texts in backticks.
inline std::vector<std::string> quoted_in(const std::string& cell) {
  return matches_in(cell, "`([^`]+)`", 1);
}

/// A row of a table of keys in doc/: "| `solver.initial_step`, `.maximum_step` | sentence | 0 |".
struct PageRow {
  std::vector<std::string> keys;   ///< in full
  std::vector<std::string> cells;  ///< the others

  /// What a cell says of the k-th key. A cell has one part for each key, or one for all.
  std::string part(std::size_t cell, std::size_t k) const {
    const std::vector<std::string> parts = split_at(cells.at(cell), "[,;] ");
    return parts.size() == keys.size() ? parts[k] : cells[cell];
  }
};

/// The rows of the tables of a page of doc/ that begin with a key and have this many cells beside
/// it.
inline std::vector<PageRow> page_rows(const std::string& page, std::size_t cells) {
  std::vector<PageRow> rows;
  std::ifstream file(source_dir() + "/doc/" + page);
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> all = split_at(line, " \\| |^\\| | \\|$");
    if (all.size() != cells + 2) continue;
    PageRow row{{}, {all.begin() + 2, all.end()}};
    for (const std::string& key : quoted_in(all[1]))
      row.keys.push_back(key[0] == '.' && !row.keys.empty()
                             ? row.keys[0].substr(0, row.keys[0].rfind('.')) + key
                             : key);
    if (!row.keys.empty()) rows.push_back(row);
  }
  return rows;
}

/// The rows of the tables of keys of the study: key, value and default.
inline std::vector<PageRow> study_rows() {
  std::vector<PageRow> rows;
  for (const auto& page : std::filesystem::directory_iterator(source_dir() + "/doc/study"))
    for (PageRow& row : page_rows("study/" + page.path().filename().string(), 2))
      rows.push_back(std::move(row));
  return rows;
}

}  // namespace codesign
