// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/lu_schedule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {
namespace {

constexpr int kWidest = 8;

}  // namespace

LuSchedule::LuSchedule(const LuPattern& pattern, const std::vector<int>& column_start,
                       const std::vector<int>& row_index, bool machine_code)
    : n_(pattern.row_of.size()),
      row_of_(pattern.row_of),
      column_of_(pattern.column_of),
      work_(n_ * kWidest),
      elimination_(machine_code),
      solution_(machine_code) {
  for (double scale : pattern.row_scale) inverse_scale_.push_back(1.0 / scale);
  lay_out(pattern);
  place_sources(column_start, row_index);
  list_targets();
}

bool LuSchedule::rescale(const LuPattern& pattern) {
  if (pattern.row_of != row_of_ || pattern.column_of != column_of_) return false;
  // Each entry of A is in a slot of the row of one pivot; source_scale_ has the scale of that row.
  for (std::size_t k = 0; k < n_; ++k) inverse_scale_[k] = 1.0 / pattern.row_scale[k];
  for (std::size_t e = 0; e < source_slot_.size(); ++e) {
    const auto row =
        std::upper_bound(start_.begin(), start_.end(), source_slot_[e]) - start_.begin() - 1;
    source_scale_[e] = inverse_scale_[to_index(static_cast<int>(row))];
  }
  return true;
}

// Columns are visited in ascending order, so that column indices ascend within each row.
void LuSchedule::lay_out(const LuPattern& pattern) {
  std::vector<std::vector<int>> lower(n_), upper(n_);
  for (std::size_t k = 0; k < n_; ++k) {
    for (int row : pattern.L[k]) lower[to_index(row)].push_back(static_cast<int>(k));
    for (int row : pattern.U[k]) upper[to_index(row)].push_back(static_cast<int>(k));
  }
  start_.push_back(0);
  for (std::size_t k = 0; k < n_; ++k) {
    for (int column : lower[k]) {
      multiplier_.push_back(static_cast<int>(column_.size()));
      column_.push_back(column);
    }
    diagonal_.push_back(static_cast<int>(column_.size()));
    column_.push_back(static_cast<int>(k));
    column_.insert(column_.end(), upper[k].begin(), upper[k].end());
    start_.push_back(static_cast<int>(column_.size()));
  }
  factors_.resize(column_.size());
}

void LuSchedule::place_sources(const std::vector<int>& column_start,
                               const std::vector<int>& row_index) {
  std::vector<int> pivot_of_row(n_);
  for (std::size_t k = 0; k < n_; ++k) pivot_of_row[to_index(row_of_[k])] = static_cast<int>(k);
  source_slot_.resize(row_index.size());
  source_scale_.resize(row_index.size());
  for (std::size_t k = 0; k < n_; ++k) {
    const std::size_t column = to_index(column_of_[k]);
    for (int e = column_start[column]; e < column_start[column + 1]; ++e) {
      const std::size_t pivot = to_index(pivot_of_row[to_index(row_index[to_index(e)])]);
      const auto first = column_.begin() + start_[pivot],
                 last = column_.begin() + start_[pivot + 1];
      source_slot_[to_index(e)] =
          static_cast<int>(std::lower_bound(first, last, static_cast<int>(k)) - column_.begin());
      source_scale_[to_index(e)] = inverse_scale_[pivot];
    }
  }
}

void LuSchedule::list_targets() {
  constexpr std::size_t kMostListed = 4'000'000;  // 16 MB
  std::vector<int> slot(n_);
  std::size_t products = 0;
  for (int l : multiplier_)
    products += to_index(start_[to_index(column_[to_index(l)]) + 1] -
                         diagonal_[to_index(column_[to_index(l)])] - 1);
  // Lists that are certainly too long for machine code are not even generated.
  if (products > StraightLine::kMostProducts) elimination_ = LazyStraightLine(false);
  if (column_.size() > StraightLine::kMostProducts) solution_ = LazyStraightLine(false);
  if (products > kMostListed) {
    entry_of_ = std::move(slot);
    return;
  }
  target_.reserve(products);
  for (std::size_t k = 0; k < n_; ++k) {
    for (int e = start_[k]; e < start_[k + 1]; ++e) slot[to_index(column_[to_index(e)])] = e;
    for (int l = start_[k]; l < diagonal_[k]; ++l) {
      const std::size_t j = to_index(column_[to_index(l)]);
      for (int u = diagonal_[j] + 1; u < start_[j + 1]; ++u)
        target_.push_back(slot[to_index(column_[to_index(u)])]);
    }
  }
}

namespace {

// Indices of the arrays that the compiled code works on.
constexpr int kValues = 0, kRightHandSides = 0, kFactors = 1, kScales = 2, kWork = 3;

}  // namespace

// Entry (k, c) of L or U is a scaled entry of A minus the products of the entries of L to its left
// in row k with the entries of U above it in column c; entries of L are then divided by the pivot
// of their column.
std::vector<Sum> LuSchedule::elimination_sums() const {
  std::vector<Sum> sums(factors_.size());
  for (std::size_t e = 0; e < source_slot_.size(); ++e)
    sums[to_index(source_slot_[e])].start = {kValues, static_cast<int>(e)};
  std::size_t next = 0;
  for (std::size_t k = 0; k < n_; ++k) {
    const Place row_scale{kScales, static_cast<int>(k)};
    for (int e = start_[k]; e < start_[k + 1]; ++e) {
      sums[to_index(e)].target = {kFactors, e};
      if (sums[to_index(e)].start.array >= 0) sums[to_index(e)].start_scale = row_scale;
      if (e < diagonal_[k])
        sums[to_index(e)].scale = {kFactors, diagonal_[to_index(column_[to_index(e)])]};
    }
    for (int l = start_[k]; l < diagonal_[k]; ++l) {
      const std::size_t j = to_index(column_[to_index(l)]);
      for (int u = diagonal_[j] + 1; u < start_[j + 1]; ++u)
        sums[to_index(target_[next++])].products.push_back({{kFactors, l}, {kFactors, u}});
    }
    sums[to_index(diagonal_[k])].reciprocal = true;
  }
  return sums;
}

std::vector<Sum> LuSchedule::solution_sums() const {
  std::vector<Sum> sums;
  for (std::size_t k = 0; k < n_; ++k) {
    Sum sum{{kWork, static_cast<int>(k)},
            {kRightHandSides, row_of_[k]},
            {kScales, static_cast<int>(k)},
            {},
            false,
            {}};
    for (int e = start_[k]; e < diagonal_[k]; ++e)
      sum.products.push_back({{kWork, column_[to_index(e)]}, {kFactors, e}});
    sums.push_back(std::move(sum));
  }
  for (std::size_t k = n_; k-- > 0;) {
    Sum sum{{kRightHandSides, column_of_[k]},
            {kWork, static_cast<int>(k)},
            {},
            {kFactors, diagonal_[k]},
            false,
            {}};
    // Descending: the component that was computed last is needed last, so that the sum need not
    // wait for it.
    for (int e = start_[k + 1]; e-- > diagonal_[k] + 1;)
      sum.products.push_back(
          {{kRightHandSides, column_of_[to_index(column_[to_index(e)])]}, {kFactors, e}});
    sums.push_back(std::move(sum));
  }
  return sums;
}

LuSchedule::Quality LuSchedule::refactor(In<double> values) {
  assert(values.size() == to_signed(source_slot_.size()));
  if (const StraightLine* const code = elimination_.get([this] { return elimination_sums(); }, 1))
    code->run({values.data(), factors_.data(), inverse_scale_.data(), nullptr, nullptr});
  else
    eliminate(values);
  return quality();
}

LuSchedule::Quality LuSchedule::quality() const {
  Quality quality;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (int place : multiplier_)
    quality.growth = std::max(quality.growth, std::abs(factors_[to_index(place)]));
  for (int diagonal : diagonal_) {
    const double inverse = std::abs(factors_[to_index(diagonal)]);
    // A vanished pivot has an infinite inverse; inf - inf and NaN - NaN make the growth NaN.
    smallest = std::min(smallest, inverse);
    largest = std::max(largest, inverse);
    quality.growth += inverse - inverse;
  }
  quality.pivot_ratio = smallest / largest;
  return quality;
}

// The terms of pivot k are the products of L left of it with U above it, and an entry of A, which
// is at most as large as these and the pivot together.
double LuSchedule::cancellation() const {
  double least = 1.0;
  for (std::size_t k = 0; k < n_; ++k) {
    const double pivot = std::abs(1.0 / factors_[to_index(diagonal_[k])]);
    double largest = pivot;
    for (int l = start_[k]; l < diagonal_[k]; ++l) {
      const std::size_t row = to_index(column_[to_index(l)]);
      const auto first = column_.begin() + diagonal_[row], last = column_.begin() + start_[row + 1];
      const auto above = std::lower_bound(first, last, static_cast<int>(k));
      if (above == last || *above != static_cast<int>(k)) continue;
      const double product = factors_[to_index(l)] * factors_[to_index(above - column_.begin())];
      largest = std::max(largest, std::abs(product));
    }
    if (!(pivot > 0.0) || !std::isfinite(largest)) return 0.0;
    least = std::min(least, pivot / largest);
  }
  return least;
}

/// Eliminates row by row: for each entry of L in a row, that multiple of the pivot's row of U is
/// subtracted.
/// @param begin_row (row), called before a row is eliminated. @param target (entry of U) -> the
/// entry that its product is subtracted from; called in the order of the products.
template <class BeginRow, class Target>
void LuSchedule::eliminate_rows(const BeginRow& begin_row, Target target) {
  double* const w = factors_.data();
  const int *const column = column_.data(), *const diagonal = diagonal_.data(),
                   *const start = start_.data();
  for (std::size_t k = 0; k < n_; ++k) {
    begin_row(k);
    for (int l = start[k]; l < diagonal[k]; ++l) {
      const int j = column[l], pivot = diagonal[j], end = start[j + 1];
      const double factor = w[l] * w[pivot];
      w[l] = factor;
      for (int u = pivot + 1; u < end; ++u) w[target(u)] -= factor * w[u];
    }
    w[diagonal[k]] = 1.0 / w[diagonal[k]];
  }
}

void LuSchedule::eliminate(In<double> values) {
  const double* const value = values.data();
  std::fill(factors_.begin(), factors_.end(), 0.0);
  for (std::size_t e = 0; e < source_slot_.size(); ++e)
    factors_[to_index(source_slot_[e])] = source_scale_[e] * value[e];
  if (entry_of_.empty()) {
    eliminate_rows([](std::size_t) {}, [next = target_.data()](int) mutable { return *next++; });
    return;
  }
  const auto note_row = [this](std::size_t k) {
    for (int e = start_[k]; e < start_[k + 1]; ++e) entry_of_[to_index(column_[to_index(e)])] = e;
  };
  eliminate_rows(note_row, [entry = entry_of_.data(), column = column_.data()](int u) {
    return entry[column[u]];
  });
}

namespace {

/// N numbers side by side, in vector registers if N is above 1.
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

/// x -= sum of factors[e] y[column[e]].
template <int N>
void subtract_products(const double* factors, const int* column, int first, int last,
                       const double* y, Row<N>* x) {
  for (int e = first; e < last; ++e)
    x->subtract(factors[e], Row<N>(y + std::ptrdiff_t{N} * column[e]));
}

/// The same for N = 1, with two partial sums, since each addition must wait for the one before it.
template <>
void subtract_products<1>(const double* factors, const int* column, int first, int last,
                          const double* y, Row<1>* x) {
  double odd = 0.0;
  int e = first;
  for (; e + 1 < last; e += 2) {
    x->value -= factors[e] * y[column[e]];
    odd += factors[e + 1] * y[column[e + 1]];
  }
  if (e < last) odd += factors[e] * y[column[e]];
  x->value -= odd;
}

/// y[column[e]] -= factors[e] x.
template <int N>
void spread_products(const double* factors, const int* column, int first, int last, const Row<N>& x,
                     double* y) {
  for (int e = first; e < last; ++e) {
    double* const to = y + std::ptrdiff_t{N} * column[e];
    Row<N> sum(to);
    sum.subtract(factors[e], x);
    sum.store(to);
  }
}

}  // namespace

template <int N>
void LuSchedule::solve(Out<double> x) const {
  assert(x.size() == to_signed(N * n_));
  if (const StraightLine* const code = solution_.get([this] { return solution_sums(); }, N))
    code->run({x.data(), factors_.data(), inverse_scale_.data(), work_.data(), nullptr});
  else
    solve_by_lists<N>(x);
}

template <int N>
void LuSchedule::solve_by_lists(Out<double> in_place) const {
  double *const x = in_place.data(), *const y = work_.data();
  const double* const f = factors_.data();
  const int *const column = column_.data(), *const start = start_.data(),
                   *const diagonal = diagonal_.data();
  for (std::size_t k = 0; k < n_; ++k) {
    Row<N> sum(x + N * to_index(row_of_[k]));
    sum.scale(inverse_scale_[k]);
    subtract_products<N>(f, column, start[k], diagonal[k], y, &sum);
    sum.store(y + N * k);
  }
  for (std::size_t k = n_; k-- > 0;) {
    Row<N> sum(y + N * k);
    subtract_products<N>(f, column, diagonal[k] + 1, start[k + 1], y, &sum);
    sum.scale(f[diagonal[k]]);
    sum.store(y + N * k);
    sum.store(x + N * to_index(column_of_[k]));
  }
}

// R^-1 A = P^T L U Q^T, so A^T x = b is solved with U^T first, then L^T. Their columns are the rows
// of the stored factors.
template <int N>
void LuSchedule::solve_transposed(Out<double> in_place) const {
  assert(in_place.size() == to_signed(N * n_));
  double *const x = in_place.data(), *const y = work_.data();
  const double* const f = factors_.data();
  const int *const column = column_.data(), *const start = start_.data(),
                   *const diagonal = diagonal_.data();
  for (std::size_t k = 0; k < n_; ++k) Row<N>(x + N * to_index(column_of_[k])).store(y + N * k);
  for (std::size_t k = 0; k < n_; ++k) {
    Row<N> own(y + N * k);
    own.scale(f[diagonal[k]]);
    own.store(y + N * k);
    spread_products<N>(f, column, diagonal[k] + 1, start[k + 1], own, y);
  }
  for (std::size_t k = n_; k-- > 0;) {
    Row<N> own(y + N * k);
    spread_products<N>(f, column, start[k], diagonal[k], own, y);
    own.scale(inverse_scale_[k]);
    own.store(x + N * to_index(row_of_[k]));
  }
}

#define CODESIGN_INSTANTIATE(N)                          \
  template void LuSchedule::solve<N>(Out<double>) const; \
  template void LuSchedule::solve_transposed<N>(Out<double>) const;
CODESIGN_INSTANTIATE(1)
CODESIGN_INSTANTIATE(4)
CODESIGN_INSTANTIATE(8)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
