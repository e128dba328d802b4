// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/pivots.h"

#include <suitesparse/klu.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <queue>
#include <utility>

#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kAmd = 0, kColamd = 1;

/// Options of one run of KLU. With `blocks` it first permutes the matrix to block triangular form,
/// which also brings nonzeros to the diagonal.
struct Proposal {
  bool blocks;
  int ordering;
  int preference;  ///< of two that cost the same, the lower one is taken
};

// In the order in which they are tried. With COLAMD the fill is bounded for any choice of pivots.
// AMD assumes pivots on the diagonal; where these are zero, as in saddle-point matrices of
// thousands of rows, it may fill the matrix, without blocks even more than with them.
constexpr Proposal kProposals[] = {
    {false, kColamd, 2}, {true, kColamd, 3}, {true, kAmd, 1}, {false, kAmd, 0}};
// Where AMD with blocks is this much costlier than the best so far, AMD without blocks is not
// tried.
constexpr double kHopeless = 4.0;
// A diagonal entry is taken as pivot if it is at least this fraction of the largest of its column.
// KLU's default, 1e-3, saves little fill, and pivots that are small at the start become unusable
// after a few steps.
constexpr double kThreshold = 0.1;

/// One run of KLU; owns its results.
class Run {
 public:
  Run(const Proposal& proposal, const std::vector<int>& column_start,
      const std::vector<int>& row_index, In<double> values)
      : n_(static_cast<int>(column_start.size()) - 1) {
    klu_defaults(&common_);
    common_.btf = proposal.blocks ? 1 : 0;
    common_.ordering = proposal.ordering;
    common_.tol = kThreshold;
    // KLU does not write to the pattern and the values, although its pointers are not const.
    int *const starts = const_cast<int*>(column_start.data()), *const rows = const_cast<int*>(
                                                                   row_index.data());
    symbolic_ = klu_analyze(n_, starts, rows, &common_);
    if (symbolic_)
      numeric_ = klu_factor(starts, rows, const_cast<double*>(values.data()), symbolic_, &common_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  ~Run() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  bool ok() const { return numeric_ && common_.status == KLU_OK; }

  double operations() {
    klu_flops(symbolic_, numeric_, &common_);
    return common_.flops;
  }

  Pivots pivots() {
    const auto size = to_index(n_);
    Pivots pivots{std::vector<int>(size), std::vector<int>(size), std::vector<double>(size)};
    klu_extract(numeric_, symbolic_, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                nullptr, nullptr, pivots.row_of.data(), pivots.column_of.data(),
                pivots.row_scale.data(), nullptr, &common_);
    return pivots;
  }

 private:
  int n_;
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace

// Row by row: eliminating entry (k, c) left of the diagonal adds the pattern of row c of U, all to
// the right of c, to row k.
LuPattern eliminate_pattern(const Pivots& pivots, const std::vector<int>& column_start,
                            const std::vector<int>& row_index) {
  const std::size_t n = pivots.row_of.size();
  LuPattern pattern{pivots.row_of, pivots.column_of, pivots.row_scale, {}, {}};
  pattern.U.resize(n);
  pattern.L.resize(n);
  std::vector<int> pivot_of_row(n);
  for (std::size_t k = 0; k < n; ++k)
    pivot_of_row[to_index(pivots.row_of[k])] = static_cast<int>(k);
  std::vector<std::vector<int>> rows(
      n);  // columns of each row; of eliminated rows only those right of the diagonal, ascending
  for (std::size_t k = 0; k < n; ++k) {
    const auto column = to_index(pivots.column_of[k]);
    for (int e = column_start[column]; e < column_start[column + 1]; ++e)
      rows[to_index(pivot_of_row[to_index(row_index[to_index(e)])])].push_back(static_cast<int>(k));
  }
  std::vector<std::size_t> seen(n, n);  // per column: the last row in which it was found
  for (std::size_t k = 0; k < n; ++k) {
    const int diagonal = static_cast<int>(k);
    std::vector<int>& row = rows[k];
    std::priority_queue<int, std::vector<int>, std::greater<>>
        left;  // entries left of the diagonal that are still to be eliminated
    for (int column : row) {
      seen[to_index(column)] = k;
      if (column < diagonal) left.push(column);
    }
    for (; !left.empty(); left.pop()) {
      for (int column : rows[to_index(left.top())]) {
        if (seen[to_index(column)] == k) continue;
        seen[to_index(column)] = k;
        row.push_back(column);
        if (column < diagonal) left.push(column);
      }
    }
    std::sort(row.begin(), row.end());
    for (int column : row)
      if (column != diagonal)
        (column < diagonal ? pattern.L : pattern.U)[to_index(column)].push_back(diagonal);
    row.erase(row.begin(), std::upper_bound(row.begin(), row.end(), diagonal));
  }
  return pattern;
}

std::int64_t count_products(const LuPattern& pattern) {
  std::vector<std::int64_t> length(pattern.row_of.size(), 0);  // entries per row of U
  for (const std::vector<int>& column : pattern.U)
    for (int row : column) ++length[to_index(row)];
  std::int64_t products = 0;
  for (std::size_t k = 0; k < length.size(); ++k)
    products += length[k] * static_cast<std::int64_t>(pattern.L[k].size());
  return products;
}

std::optional<LuPattern> choose_pivots(const std::vector<int>& column_start,
                                       const std::vector<int>& row_index, In<double> values) {
  assert(values.size() == to_signed(row_index.size()));
  std::optional<LuPattern> best;
  std::pair<std::int64_t, int> least;  // products, preference
  double fewest = 0.0;
  bool hopeless = false;
  for (const Proposal& proposal : kProposals) {
    if (hopeless && proposal.ordering == kAmd) continue;
    Run run(proposal, column_start, row_index, values);
    if (!run.ok()) continue;
    // KLU's own count is accurate enough to exclude proposals that cannot be the cheapest.
    const double operations = run.operations();
    if (proposal.ordering == kAmd) hopeless = best && operations > kHopeless * fewest;
    if (best && operations > 2.0 * fewest) continue;
    fewest = best ? std::min(fewest, operations) : operations;
    LuPattern pattern = eliminate_pattern(run.pivots(), column_start, row_index);
    const std::pair<std::int64_t, int> cost{count_products(pattern), proposal.preference};
    if (best && cost >= least) continue;
    least = cost;
    best = std::move(pattern);
  }
  return best;
}

}  // namespace codesign
