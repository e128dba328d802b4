// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "integration/watch_layout.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

/// One smooth constraint on a watched signal in one scenario, theory (24d). With x the value at an instant or the extreme value in a
/// window:
///   sign x - sign bound <= 0, or = 0 for an equality    of `path:` and `final:`
///   sign x - p <= 0                                      of a peak, p its slack variable
struct SignalRow {
  std::size_t watched = 0;  ///< index in Study::watched
  int place = 0;            ///< index of x among the numbers of WatchLayout
  double sign = 1.0;
  int peak = -1;  ///< number of the peak among the study's peaks; -1: a constraint
};

/// The rows of all watched signals of a study, which are the same at every design.
class SignalRows {
 public:
  explicit SignalRows(const Study& study);

  const std::vector<SignalRow>& inequalities() const { return inequalities_; }
  const std::vector<SignalRow>& equalities() const { return equalities_; }
  /// Indices in Study::watched of the peaks.
  const std::vector<std::size_t>& peaks() const { return peaks_; }
  const WatchLayout& layout() const { return layout_; }

  /// The left side of the row of a constraint, or of a peak's row without p. @param parameters all named parameters of the scenario.
  double value(const SignalRow& row, const Extremes& extremes, const std::vector<double>& parameters) const;
  /// Derivative of value() by the k-th tuned parameter.
  double derivative(const SignalRow& row, std::size_t k, const Extremes& extremes, const std::vector<double>& parameters) const;
  /// The largest violation of the bounds of one watched signal; 0 if they are met.
  double violation(std::size_t watched, const Extremes& extremes, const std::vector<double>& parameters) const;

 private:
  void add(std::size_t watched, double sign, int peak);
  const Quantity& bound(const SignalRow& row) const;

  const Study& study_;
  const WatchLayout layout_;
  std::vector<SignalRow> inequalities_, equalities_;
  std::vector<std::size_t> peaks_;
};

}  // namespace codesign
