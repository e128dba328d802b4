// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/lu_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  void subtract(double factor, const Row& other) {
    for (int k = 0; k < kBlocks; ++k) block[k] -= factor * other.block[k];
  }
};

template <>
struct Row<1> {
  double value;

  explicit Row(const double* from) : value(*from) {}
  void store(double* to) const { *to = value; }
  void subtract(double factor, const Row& other) { value -= factor * other.value; }
};

/// y[row of e] -= factors[e] y[k] for the entries from `first` to `last`.
template <int N>
void subtract_column(const double* factors, const int* row, int first, int last, const double* pivot_row, double* y) {
  const Row<N> x(pivot_row);
  for (int e = first; e < last; ++e) {
    double* const target = y + N * row[e];
    Row<N> t(target);
    t.subtract(factors[e], x);
    t.store(target);
  }
}

/// y[k] -= sum of factors[e] y[row of e].
template <int N>
void subtract_products(const double* factors, const int* row, int first, int last, double* pivot_row, const double* y) {
  Row<N> x(pivot_row);
  for (int e = first; e < last; ++e) x.subtract(factors[e], Row<N>(y + N * row[e]));
  x.store(pivot_row);
}

}  // namespace

template <int N>
void LuSchedule::solve(double* x) const {
  double* const y = work_.data();
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) y[N * k + c] = inverse_scale_[k] * x[N * at(row_of_[k]) + c];
  for (std::size_t k = 0; k < n_; ++k) subtract_column<N>(factors_.data(), row_.data(), diagonal_[k] + 1, start_[k + 1], y + N * k, y);
  for (std::size_t k = n_; k-- > 0;) {
    for (std::size_t c = 0; c < N; ++c) y[N * k + c] *= factors_[at(diagonal_[k])];
    subtract_column<N>(factors_.data(), row_.data(), start_[k], diagonal_[k], y + N * k, y);
  }
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) x[N * at(column_of_[k]) + c] = y[N * k + c];
}

// A^T = Q U^T L^T P R^-T: the same lists, read by columns where solve() scatters.
template <int N>
void LuSchedule::solve_transposed(double* x) const {
  double* const y = work_.data();
  for (std::size_t k = 0; k < n_; ++k)
    for (std::size_t c = 0; c < N; ++c) y[N * k + c] = x[N * at(column_of_[k]) + c];
  for (std::size_t k = 0; k < n_; ++k) {
    subtract_products<N>(factors_.data(), row_.data(), start_[k], diagonal_[k], y + N * k, y);
    for (std::size_t c = 0; c < N; ++c) y[N * k + c] *= factors_[at(diagonal_[k])];
  }
  for (std::size_t k = n_; k-- > 0;) subtract_products<N>(factors_.data(), row_.data(), diagonal_[k] + 1, start_[k + 1], y + N * k, y);
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
