// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/math/sparse_lu.h"

#include <suitesparse/klu.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/lu_schedule.h"

namespace codesign {
namespace {

constexpr double kLargestMultiplier = 1e6;
// Ratio of pivots below which the matrix is singular to working precision.
constexpr double kSingular = 1e-17;

}  // namespace

struct SparseLu::Implementation {
  int n = 0;
  std::vector<int> starts, rows;
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  std::optional<LuSchedule> schedule;
  std::int64_t full_factorizations = 0;

  ~Implementation() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  LuPattern pattern();

  bool refactor(const double* values) {
    if (!schedule) return false;
    const LuSchedule::Quality quality = schedule->refactor(values);
    return quality.growth <= kLargestMultiplier && quality.pivot_ratio > kSingular;
  }

  bool factor(const double* values) {
    ++full_factorizations;
    schedule.reset();
    klu_free_numeric(&numeric, &common);
    // KLU only reads the values.
    numeric = klu_factor(starts.data(), rows.data(), const_cast<double*>(values), symbolic, &common);
    if (!numeric || common.status != KLU_OK) return false;
    schedule.emplace(pattern(), starts, rows);
    const double ratio = schedule->refactor(values).pivot_ratio;
    return std::isfinite(ratio) && ratio > kSingular;
  }
};

LuPattern SparseLu::Implementation::pattern() {
  const auto size = static_cast<std::size_t>(n);
  LuPattern p;
  p.row_of.resize(size);
  p.column_of.resize(size);
  p.row_scale.resize(size);
  const auto lower = static_cast<std::size_t>(numeric->lnz), upper = static_cast<std::size_t>(numeric->unz);
  std::vector<int> l_start(size + 1), l_row(lower), u_start(size + 1), u_row(upper);
  std::vector<double> l_value(lower), u_value(upper);
  klu_extract(numeric, symbolic, l_start.data(), l_row.data(), l_value.data(), u_start.data(), u_row.data(), u_value.data(), nullptr,
              nullptr, nullptr, p.row_of.data(), p.column_of.data(), p.row_scale.data(), nullptr, &common);
  const auto columns = [size](const std::vector<int>& start, const std::vector<int>& row, std::vector<std::vector<int>>* result) {
    result->resize(size);
    for (std::size_t k = 0; k < size; ++k) {
      std::vector<int>& entries = (*result)[k];
      for (int e = start[k]; e < start[k + 1]; ++e)
        if (row[static_cast<std::size_t>(e)] != static_cast<int>(k)) entries.push_back(row[static_cast<std::size_t>(e)]);
      std::sort(entries.begin(), entries.end());
    }
  };
  columns(l_start, l_row, &p.L);
  columns(u_start, u_row, &p.U);
  return p;
}

SparseLu::SparseLu(int n, const std::vector<int>& column_start, const std::vector<int>& row_index)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->n = n;
  implementation_->starts = column_start;
  implementation_->rows = row_index;
  klu_defaults(&implementation_->common);
  // One block: the schedule knows no other.
  implementation_->common.btf = 0;
  implementation_->symbolic = klu_analyze(n, implementation_->starts.data(), implementation_->rows.data(), &implementation_->common);
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factor(const double* values) {
  // A structurally singular pattern has no analysis.
  if (!implementation_->symbolic) return false;
  return implementation_->refactor(values) || implementation_->factor(values);
}

template <int N>
void SparseLu::solve_rows(double* x) const {
  implementation_->schedule->solve<N>(x);
}

template <int N>
void SparseLu::solve_transposed_rows(double* x) const {
  implementation_->schedule->solve_transposed<N>(x);
}

std::int64_t SparseLu::full_factorizations() const { return implementation_->full_factorizations; }

#define CODESIGN_INSTANTIATE(N)                         \
  template void SparseLu::solve_rows<N>(double*) const; \
  template void SparseLu::solve_transposed_rows<N>(double*) const;
CODESIGN_INSTANTIATE(1)
CODESIGN_INSTANTIATE(4)
CODESIGN_INSTANTIATE(8)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
