// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/iteration_matrix.h"

#include <algorithm>
#include <array>

namespace codesign {
namespace {

struct Entry {
  int column, row, matrix, entry;
  bool operator<(const Entry& other) const { return std::array<int, 2>{column, row} < std::array<int, 2>{other.column, other.row}; }
};

/// Notes the entries of one matrix, the integrand's row left out; `shift` moves its column to that of the rate it is eliminated by.
template <class Shift>
void collect(const Sparsity& pattern, int matrix, const Shift& shift, std::vector<Entry>* entries) {
  for (int row = 0; row + 1 < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) entries->push_back({shift(pattern.column(e)), row, matrix, e});
}

}  // namespace

IterationMatrix::Pattern::Pattern(const System& system) {
  const Layout& layout = system.layout();
  const auto same = [](int column) { return column; };
  const auto position = [&layout](int column) { return column < layout.n ? column : layout.state_column(column - layout.n); };
  std::vector<Entry> entries;
  collect(system.patterns().position, 0, position, &entries);
  collect(system.patterns().velocity, 1, same, &entries);
  collect(system.patterns().rate, 2, same, &entries);
  std::stable_sort(entries.begin(), entries.end());
  column_start.assign(static_cast<std::size_t>(layout.columns()) + 1, 0);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Entry& e = entries[k];
    if (k == 0 || entries[k - 1] < e) {
      row_index.push_back(e.row);
      ++column_start[static_cast<std::size_t>(e.column) + 1];
    }
    std::vector<Source>& list = e.matrix == 2 ? z : e.matrix == 1 ? v : e.column < layout.n ? q : s;
    list.push_back({e.entry, static_cast<int>(row_index.size()) - 1});
  }
  for (std::size_t k = 1; k < column_start.size(); ++k) column_start[k] += column_start[k - 1];
}

IterationMatrix::IterationMatrix(const System& system)
    : pattern_(system), values_(pattern_.row_index.size()), lu_(pattern_.column_start, pattern_.row_index) {}

bool IterationMatrix::factor(const Linearization<double>& d, double c_v, double c_q, double c_s) {
  std::fill(values_.begin(), values_.end(), 0.0);
  const auto add = [this](const std::vector<Pattern::Source>& sources, double c, const std::vector<double>& from) {
    for (const Pattern::Source& source : sources)
      values_[static_cast<std::size_t>(source.slot)] += c * from[static_cast<std::size_t>(source.entry)];
  };
  add(pattern_.z, 1.0, d.rate);
  if (c_v != 0.0) add(pattern_.v, c_v, d.velocity);
  if (c_q != 0.0) add(pattern_.q, c_q, d.position);
  if (c_s != 0.0) add(pattern_.s, c_s, d.position);
  return lu_.factor(values_.data());
}

}  // namespace codesign
