// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/lu_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "mechanism_codesign/math/lanes.h"

namespace codesign {
namespace {

constexpr int kWidest = 8;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

LuSchedule::LuSchedule(const LuPattern& pattern, const std::vector<int>& column_start, const std::vector<int>& row_index)
    : n_(pattern.row_of.size()), row_of_(pattern.row_of), column_of_(pattern.column_of), work_(n_ * kWidest) {
  for (double scale : pattern.row_scale) inverse_scale_.push_back(1.0 / scale);
  lay_out(pattern);
  std::vector<int> pivot_of_row(n_), slot(n_);
  for (std::size_t k = 0; k < n_; ++k) pivot_of_row[at(row_of_[k])] = static_cast<int>(k);
  source_slot_.resize(row_index.size());
  source_scale_.resize(row_index.size());
  for (std::size_t k = 0; k < n_; ++k) {
    for (int e = start_[k]; e < start_[k + 1]; ++e) slot[at(row_[at(e)])] = e;
    const std::size_t column = at(column_of_[k]);
    for (int e = column_start[column]; e < column_start[column + 1]; ++e) {
      const int pivot = pivot_of_row[at(row_index[at(e)])];
      source_slot_[at(e)] = slot[at(pivot)];
      source_scale_[at(e)] = inverse_scale_[at(pivot)];
    }
    for (int u = start_[k]; u < diagonal_[k]; ++u) {
      const std::size_t j = at(row_[at(u)]);
      for (int l = diagonal_[j] + 1; l < start_[j + 1]; ++l) target_.push_back(slot[at(row_[at(l)])]);
    }
  }
}

void LuSchedule::lay_out(const LuPattern& pattern) {
  start_.push_back(0);
  for (std::size_t k = 0; k < n_; ++k) {
    row_.insert(row_.end(), pattern.U[k].begin(), pattern.U[k].end());
    diagonal_.push_back(static_cast<int>(row_.size()));
    row_.push_back(static_cast<int>(k));
    row_.insert(row_.end(), pattern.L[k].begin(), pattern.L[k].end());
    start_.push_back(static_cast<int>(row_.size()));
  }
  factors_.resize(row_.size());
  own_.resize(row_.size());
  std::iota(own_.begin(), own_.end(), 0);
  lower_ = by_rows(true);
  upper_ = by_rows(false);
}

LuSchedule::Rows LuSchedule::by_rows(bool lower) const {
  std::vector<std::vector<std::pair<int, int>>> rows(n_);
  for (std::size_t k = 0; k < n_; ++k) {
    const int first = lower ? diagonal_[k] + 1 : start_[k], last = lower ? start_[k + 1] : diagonal_[k];
    for (int e = first; e < last; ++e) rows[at(row_[at(e)])].emplace_back(e, static_cast<int>(k));
  }
  Rows result;
  result.start.push_back(0);
  for (const auto& row : rows) {
    for (const auto& [entry, column] : row) {
      result.entry.push_back(entry);
      result.column.push_back(column);
    }
    result.start.push_back(static_cast<int>(result.entry.size()));
  }
  return result;
}

LuSchedule::Quality LuSchedule::refactor(const double* values) {
  std::fill(factors_.begin(), factors_.end(), 0.0);
  for (std::size_t e = 0; e < source_slot_.size(); ++e) factors_[at(source_slot_[e])] = source_scale_[e] * values[e];
  eliminate();
  Quality quality;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (std::size_t k = 0; k < n_; ++k) {
    const double inverse = std::abs(factors_[at(diagonal_[k])]);
    // A vanished pivot has an infinite inverse; a product with NaN stays NaN.
    smallest = std::min(smallest, inverse);
    largest = std::max(largest, inverse);
    quality.growth += inverse - inverse;
    for (int l = diagonal_[k] + 1; l < start_[k + 1]; ++l) quality.growth = std::max(quality.growth, std::abs(factors_[at(l)]));
  }
  quality.pivot_ratio = smallest / largest;
  return quality;
}

void LuSchedule::eliminate() {
  double* const w = factors_.data();
  const int* target = target_.data();
  for (std::size_t k = 0; k < n_; ++k) {
    for (int u = start_[k]; u < diagonal_[k]; ++u) {
      const std::size_t j = at(row_[at(u)]);
      const double factor = w[u];
      for (int l = diagonal_[j] + 1; l < start_[j + 1]; ++l) w[*target++] -= w[l] * factor;
    }
    const double inverse = 1.0 / w[diagonal_[k]];
    w[diagonal_[k]] = inverse;
    for (int l = diagonal_[k] + 1; l < start_[k + 1]; ++l) w[l] *= inverse;
  }
}

namespace {

/// N numbers side by side, in the registers' own type where there are several.
template <int N>
struct Row {
  using Block = typename Lanes<4>::Four;
  static constexpr int kBlocks = N / 4;
  Block block[kBlocks];

  explicit Row(const double* from) {
    for (int k = 0; k < kBlocks; ++k) block[k] = reinterpret_cast<const Block*>(from)[k];
  }
  void store(double* to) const {
    for (int k = 0; k < kBlocks; ++k) reinterpret_cast<Block*>(to)[k] = block[k];
  }
  void scale(double factor) {
    for (int k = 0; k < kBlocks; ++k) block[k] *= factor;
  }
  void subtract(double factor, const Row& other) {
    for (int k = 0; k < kBlocks; ++k) block[k] -= factor * other.block[k];
  }
};

template <>
struct Row<1> {
  double value;

  explicit Row(const double* from) : value(*from) {}
  void store(double* to) const { *to = value; }
  void scale(double factor) { value *= factor; }
  void subtract(double factor, const Row& other) { value -= factor * other.value; }
};

/// y[k] -= sum of factors[entry of e] y[index of e], times `factor`.
template <int N>
void subtract_products(const double* factors, const int* entry, const int* index, int first, int last, double factor, std::size_t k,
                       double* y) {
  Row<N> x(y + N * k);
  for (int e = first; e < last; ++e) x.subtract(factors[entry[e]], Row<N>(y + std::ptrdiff_t{N} * index[e]));
  x.scale(factor);
  x.store(y + N * k);
}

}  // namespace

template <int N>
void LuSchedule::solve(double* x) const {
  double* const y = work_.data();
  const double* const f = factors_.data();
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) y[N * k + c] = inverse_scale_[k] * x[N * at(row_of_[k]) + c];
  for (std::size_t k = 0; k < n_; ++k)
    subtract_products<N>(f, lower_.entry.data(), lower_.column.data(), lower_.start[k], lower_.start[k + 1], 1.0, k, y);
  for (std::size_t k = n_; k-- > 0;)
    subtract_products<N>(f, upper_.entry.data(), upper_.column.data(), upper_.start[k], upper_.start[k + 1], f[diagonal_[k]], k, y);
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) x[N * at(column_of_[k]) + c] = y[N * k + c];
}

// A^T = Q U^T L^T P R^-T: rows of the transposed factors are the columns as they lie.
template <int N>
void LuSchedule::solve_transposed(double* x) const {
  double* const y = work_.data();
  const double* const f = factors_.data();
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) y[N * k + c] = x[N * at(column_of_[k]) + c];
  for (std::size_t k = 0; k < n_; ++k) subtract_products<N>(f, own_.data(), row_.data(), start_[k], diagonal_[k], f[diagonal_[k]], k, y);
  for (std::size_t k = n_; k-- > 0;) subtract_products<N>(f, own_.data(), row_.data(), diagonal_[k] + 1, start_[k + 1], 1.0, k, y);
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) x[N * at(row_of_[k]) + c] = inverse_scale_[k] * y[N * k + c];
}

#define CODESIGN_INSTANTIATE(N)                      \
  template void LuSchedule::solve<N>(double*) const; \
  template void LuSchedule::solve_transposed<N>(double*) const;
CODESIGN_INSTANTIATE(1)
CODESIGN_INSTANTIATE(4)
CODESIGN_INSTANTIATE(8)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
