// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparse_lu.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/arrays.h"
#include "sparse/lu_schedule.h"
#include "sparse/pivots.h"

namespace codesign {
namespace {

constexpr double kLargestMultiplier = 1e6;
// Smallest over largest pivot at which the matrix counts as singular to working precision.
constexpr double kSingular = 1e-17;
// Of a pivot over its largest term: less is what rounding leaves.
constexpr double kRounding = 1e-13;
// By how much the ratio may fall below that of a choice of pivots whose own ratio is below
// kSingular.
constexpr double kFall = 1e-6;
constexpr std::size_t kMostSchedules = 4;
// Including schedules of earlier runs, which are used again if the same pivots are chosen.
constexpr std::size_t kMostKept = 8;

}  // namespace

struct SparseLu::Implementation {
  struct Kept {
    LuSchedule schedule;
    bool is_settled = false;
    double least_ratio = kSingular;  ///< of pivots, above which the schedule serves
  };

  std::vector<int> starts, rows;
  /// the last one is in use; those before the last `chosen` ones were reset
  std::vector<Kept> schedules;
  std::size_t chosen = 0;  ///< since the last reset_pivots(), at most kMostSchedules
  std::int64_t full_factorizations = 0;

  LuSchedule& schedule() { return schedules.back().schedule; }

  // Earlier pivots are kept since a mechanism that swings returns to positions for which they were
  // chosen.
  bool refactor(In<double> values) {
    const auto first = schedules.end() - to_signed(chosen);
    for (std::size_t tried = 0; tried < chosen; ++tried) {
      const LuSchedule::Quality quality = schedule().refactor(values);
      if (quality.growth <= kLargestMultiplier &&
          quality.pivot_ratio > schedules.back().least_ratio)
        return true;
      std::rotate(first, schedules.end() - 1, schedules.end());
    }
    return false;
  }

  bool factor(In<double> values) {
    ++full_factorizations;
    const std::optional<LuPattern> pattern = choose_pivots(starts, rows, values);
    if (!pattern) return false;
    add(*pattern);
    const double ratio = schedule().refactor(values).pivot_ratio;
    schedules.back().least_ratio = kSingular;
    if (!std::isfinite(ratio) || ratio > kSingular) return std::isfinite(ratio);
    if (!(ratio > 0.0) || !(schedule().cancellation() > kRounding)) return false;
    schedules.back().least_ratio = kFall * ratio;
    return true;
  }

  /// Brings a schedule for these pivots to the end: a earlier one or a new one.
  void add(const LuPattern& pattern) {
    if (chosen == kMostSchedules) --chosen;
    const auto last = schedules.end() - to_signed(chosen);
    const auto known = std::find_if(schedules.begin(), last, [&pattern](Kept& kept) {
      return !kept.is_settled && kept.schedule.rescale(pattern);
    });
    if (known != last) {
      std::rotate(known, known + 1, schedules.end());
    } else {
      if (schedules.size() == kMostKept)
        schedules.erase(schedules.begin() + (schedules.front().is_settled ? 1 : 0));
      schedules.push_back({LuSchedule(pattern, starts, rows)});
    }
    ++chosen;
  }

  /// The distance of the kept schedule from the first one; of the end if there is none.
  std::ptrdiff_t kept() const {
    return std::find_if(schedules.begin(), schedules.end(),
                        [](const Kept& kept) { return kept.is_settled; }) -
           schedules.begin();
  }
  bool has_kept() const { return kept() < to_signed(schedules.size()); }

  void reset_pivots() {
    chosen = has_kept() ? 1 : 0;
    const auto first = schedules.begin() + kept();
    if (chosen > 0) std::rotate(first, first + 1, schedules.end());
  }

  void keep_pivots() {
    for (Kept& kept : schedules) kept.is_settled = false;
    if (chosen > 0) schedules.back().is_settled = true;
  }

  void keep_pivots_of(const Implementation& other) {
    if (has_kept() || !other.has_kept()) return;
    schedules.assign(1, other.schedules[to_index(other.kept())]);
    chosen = 1;
  }
};

SparseLu::SparseLu(const std::vector<int>& column_start, const std::vector<int>& row_index)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->starts = column_start;
  implementation_->rows = row_index;
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factor(In<double> values) {
  return implementation_->refactor(values) || implementation_->factor(values);
}

void SparseLu::reset_pivots() { implementation_->reset_pivots(); }

void SparseLu::keep_pivots() { implementation_->keep_pivots(); }

void SparseLu::keep_pivots_of(const SparseLu& other) {
  implementation_->keep_pivots_of(*other.implementation_);
}

template <int N>
void SparseLu::solve_rows(Out<double> x) const {
  implementation_->schedule().solve<N>(x);
}

template <int N>
void SparseLu::solve_transposed_rows(Out<double> x) const {
  implementation_->schedule().solve_transposed<N>(x);
}

std::int64_t SparseLu::full_factorizations() const { return implementation_->full_factorizations; }

#define CODESIGN_INSTANTIATE(N)                             \
  template void SparseLu::solve_rows<N>(Out<double>) const; \
  template void SparseLu::solve_transposed_rows<N>(Out<double>) const;
CODESIGN_INSTANTIATE(1)
CODESIGN_INSTANTIATE(4)
CODESIGN_INSTANTIATE(8)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
