// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/iteration_matrix.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "codegen/straight_line.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "sparse/sparsity.h"

namespace codesign {
namespace {

struct Entry {
  int column, row, matrix, entry;
  bool operator<(const Entry& other) const {
    return std::array<int, 2>{column, row} < std::array<int, 2>{other.column, other.row};
  }
};

/// Appends the entries of one matrix, without the row of the integrand. `shift` maps its column to
/// the column of the rate that the variable is eliminated by, theory (16).
template <class Shift>
void collect(const Sparsity& pattern, int matrix, const Shift& shift, std::vector<Entry>* entries) {
  for (int row = 0; row + 1 < pattern.rows; ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      entries->push_back({shift(pattern.column(e)), row, matrix, e});
}

}  // namespace

IterationMatrix::Pattern::Pattern(const CompiledSystem& system) {
  const Layout& layout = system.layout();
  const auto same = [](int column) { return column; };
  const auto position = [&layout](int column) { return layout.rate_column(column); };
  std::vector<Entry> entries;
  collect(system.patterns().position, 0, position, &entries);
  collect(system.patterns().velocity, 1, same, &entries);
  collect(system.patterns().rate, 2, same, &entries);
  std::stable_sort(entries.begin(), entries.end());
  column_start.assign(to_index(layout.columns()) + 1, 0);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Entry& e = entries[k];
    if (k == 0 || entries[k - 1] < e) {
      row_index.push_back(e.row);
      ++column_start[to_index(e.column) + 1];
    }
    std::vector<Source>& list = e.matrix == 2 ? z : e.matrix == 1 ? v : e.column < layout.n ? q : s;
    list.push_back({e.entry, static_cast<int>(row_index.size()) - 1});
  }
  for (std::size_t k = 1; k < column_start.size(); ++k) column_start[k] += column_start[k - 1];
}

namespace {

// Indices of the arrays of the compiled code, and of the coefficients in kCoefficients. They are
// negative since the code subtracts products.
constexpr int kValues = 0, kPosition = 1, kVelocity = 2, kRate = 3, kCoefficients = 4;
constexpr int kMinusCv = 0, kMinusCq = 1, kMinusCs = 2;

std::vector<Sum> sums(const IterationMatrix::Pattern& pattern) {
  std::vector<Sum> sums(pattern.row_index.size());
  for (std::size_t slot = 0; slot < sums.size(); ++slot)
    sums[slot].target = {kValues, static_cast<int>(slot)};
  for (const auto& source : pattern.z) sums[to_index(source.slot)].start = {kRate, source.entry};
  const auto add = [&sums](const std::vector<IterationMatrix::Pattern::Source>& sources,
                           int coefficient, int matrix) {
    for (const auto& source : sources)
      sums[to_index(source.slot)].products.push_back(
          {{kCoefficients, coefficient}, {matrix, source.entry}});
  };
  add(pattern.v, kMinusCv, kVelocity);
  add(pattern.q, kMinusCq, kPosition);
  add(pattern.s, kMinusCs, kPosition);
  return sums;
}

}  // namespace

IterationMatrix::IterationMatrix(const CompiledSystem& system, bool machine_code)
    : pattern_(system),
      values_(pattern_.row_index.size()),
      code_(std::make_unique<LazyStraightLine>(machine_code)),
      lu_(pattern_.column_start, pattern_.row_index) {}

IterationMatrix::~IterationMatrix() = default;
IterationMatrix::IterationMatrix(IterationMatrix&&) noexcept = default;
IterationMatrix& IterationMatrix::operator=(IterationMatrix&&) noexcept = default;

bool IterationMatrix::factor(const Linearization<double>& d, double c_v, double c_q, double c_s) {
  // G_z alone is a copy, which needs no code.
  if (c_v == 0.0 && c_q == 0.0 && c_s == 0.0) {
    add_up(d, c_v, c_q, c_s);
  } else if (const StraightLine* const code = code_->get([this] { return sums(pattern_); }, 1)) {
    const double coefficients[] = {-c_v, -c_q, -c_s};
    code->run({values_.data(), d.position.data(), d.velocity.data(), d.rate.data(), coefficients});
  } else {
    add_up(d, c_v, c_q, c_s);
  }
  return lu_.factor(values_);
}

void IterationMatrix::add_up(const Linearization<double>& d, double c_v, double c_q, double c_s) {
  std::fill(values_.begin(), values_.end(), 0.0);
  const auto add = [this](const std::vector<Pattern::Source>& sources, double c,
                          const std::vector<double>& from) {
    for (const Pattern::Source& source : sources)
      values_[to_index(source.slot)] += c * from[to_index(source.entry)];
  };
  add(pattern_.z, 1.0, d.rate);
  if (c_v != 0.0) add(pattern_.v, c_v, d.velocity);
  if (c_q != 0.0) add(pattern_.q, c_q, d.position);
  if (c_s != 0.0) add(pattern_.s, c_s, d.position);
}

void directional_derivative(const CompiledSystem& system, const Linearization<double>& d,
                            const State<double>& direction, VectorX<double>* result) {
  const ByVariable<Sparsity>& patterns = system.patterns();
  const Layout& layout = system.layout();
  result->resize(patterns.rate.rows);
  // Columns of `position` are (q, s), which State keeps in two vectors, so row_product() does not
  // serve.
  for (int row = 0; row < patterns.rate.rows; ++row) {
    double sum = row_product(patterns.velocity, d.velocity, row, direction.v) +
                 row_product(patterns.rate, d.rate, row, direction.z);
    for (int e = patterns.position.first(row); e < patterns.position.first(row + 1); ++e) {
      const int column = patterns.position.column(e);
      sum += d.position[to_index(e)] *
             (column < layout.n ? direction.q[column] : direction.s[column - layout.n]);
    }
    (*result)[row] = sum;
  }
}

void subtract_position_product(const CompiledSystem& system, const Linearization<double>& d,
                               In<double> q, double factor, Out<double> result) {
  assert(q.size() == system.layout().n && result.size() == system.layout().columns());
  const double* const direction = q.data();
  double* const sum = result.data();
  const Sparsity& pattern = system.patterns().position;
  for (int row = 0; row < system.layout().columns(); ++row)
    for (int e = pattern.first(row); e < pattern.first(row + 1); ++e)
      if (pattern.column(e) < system.layout().n)
        sum[row] -= d.position[to_index(e)] * factor * direction[pattern.column(e)];
}

}  // namespace codesign
