// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/dynamics/iteration_matrix.h"

namespace codesign {
namespace {

/// Drops the integrand's row from the pattern.
std::vector<int> equation_entries(const Sparsity& full, std::vector<int>* column_start, std::vector<int>* row_index) {
  std::vector<int> source;
  column_start->assign(1, 0);
  for (int column = 0; column < full.columns; ++column) {
    for (int k = full.column_start[static_cast<std::size_t>(column)]; k < full.column_start[static_cast<std::size_t>(column) + 1]; ++k) {
      const int row = full.row_index[static_cast<std::size_t>(k)];
      if (row >= full.columns) continue;
      row_index->push_back(row);
      source.push_back(k);
    }
    column_start->push_back(static_cast<int>(source.size()));
  }
  return source;
}

}  // namespace

IterationMatrix::IterationMatrix(const System& system)
    : first_state_column_(system.layout().state_column(0)),
      source_(equation_entries(system.sparsity(), &column_start_, &row_index_)),
      state_entries_(column_start_[static_cast<std::size_t>(first_state_column_)]),
      values_(source_.size()),
      lu_(system.layout().columns(), column_start_, row_index_) {}

bool IterationMatrix::factor(const Linearization<double>& d, double c_v, double c_q, double c_s) {
  const auto states = static_cast<std::size_t>(state_entries_);
  for (std::size_t k = 0; k < states; ++k) {
    const auto source = static_cast<std::size_t>(source_[k]);
    values_[k] = d.by_rate[source] + c_v * d.by_velocity[source] + c_q * d.by_position[source];
  }
  for (std::size_t k = states; k < values_.size(); ++k) {
    const auto source = static_cast<std::size_t>(source_[k]);
    values_[k] = d.by_rate[source] + c_s * d.by_position[source];
  }
  return lu_.factor(values_.data());
}

}  // namespace codesign
