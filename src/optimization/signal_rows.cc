// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/signal_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "description/motion_study.h"
#include "math/arrays.h"

namespace codesign {

SlackForm::SlackForm(const RobustOptions& options, Eigen::VectorXd weights)
    : measure_(options.measure), level_(options.level), weights_(std::move(weights)) {}

int SlackForm::variables() const {
  if (weights_.size() <= 1) return 0;
  if (measure_ == RobustMeasure::kWorst) return 1;
  return measure_ == RobustMeasure::kCvar ? 1 + static_cast<int>(weights_.size()) : 0;
}

double SlackForm::lower(int k) const {
  return k == 0 ? -std::numeric_limits<double>::infinity() : 0.0;
}

Eigen::VectorXd SlackForm::start(const Eigen::VectorXd& psi, double threshold) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(variables());
  y[0] = threshold;
  for (int k = 1; k < y.size(); ++k) y[k] = std::max(0.0, psi[k - 1] - threshold);
  return y;
}

Eigen::VectorXd SlackForm::gradient() const {
  Eigen::VectorXd gradient(variables());
  gradient[0] = 1.0;
  if (gradient.size() > 1) gradient.tail(weights_.size()) = weights_ / (1.0 - level_);
  return gradient;
}

double SlackForm::constraint(int i, double psi, const Eigen::VectorXd& y) const {
  return psi - y[0] - (y.size() > 1 ? y[i + 1] : 0.0);
}

SignalRows::SignalRows(const MotionStudy& study) : study_(study), layout_(study) {
  for (std::size_t k = 0; k < study.watched.size(); ++k) {
    const WatchedSignal& watched = study.watched[k];
    if (watched.role == WatchedSignal::Role::kPeak) {
      const int peak = static_cast<int>(peaks_.size());
      peaks_.push_back(k);
      add(k, 1.0, peak);
      add(k, -1.0, peak);
    } else if (is_equality(watched)) {
      equalities_.push_back({k, layout_.entries()[k].first, 1.0, -1});
    } else {
      if (watched.upper) add(k, 1.0, -1);
      if (watched.lower) add(k, -1.0, -1);
    }
  }
}

/// Rows for every instant and window of a signal. The extreme value between two instants has its
/// own row beside the rows of the instants, so that each row stays smooth when the extremum moves
/// from one place to another.
void SignalRows::add(std::size_t watched, double sign, int peak) {
  const WatchLayout::Entry& entry = layout_.entries()[watched];
  for (int k = 0; k < static_cast<int>(entry.instants.size()); ++k)
    inequalities_.push_back({watched, entry.at_instant(k), sign, peak});
  for (int k = 0; k < entry.windows(); ++k)
    inequalities_.push_back(
        {watched, sign > 0.0 ? entry.largest(k) : entry.smallest(k), sign, peak});
}

const Quantity& SignalRows::bound(const SignalRow& row) const {
  const WatchedSignal& watched = study_.watched[row.watched];
  return row.sign > 0.0 ? *watched.upper : *watched.lower;
}

double SignalRows::value(const SignalRow& row, const Extremes& extremes,
                         const std::vector<double>& parameters) const {
  const double x = row.sign * extremes.values[row.place];
  return row.peak >= 0 ? x : x - row.sign * bound(row).at(parameters);
}

double SignalRows::derivative(const SignalRow& row, std::size_t k, const Extremes& extremes,
                              const std::vector<double>& parameters) const {
  const double x = row.sign * extremes.gradients(to_signed(k), row.place);
  if (row.peak >= 0 || bound(row).is_constant()) return x;
  return x - row.sign * bound(row).expression()->derivative(study_.tuned[k], parameters);
}

double SignalRows::violation(std::size_t watched, const Extremes& extremes,
                             const std::vector<double>& parameters) const {
  double largest = 0.0;
  for (const SignalRow& row : inequalities_)
    if (row.watched == watched && row.peak < 0)
      largest = std::max(largest, value(row, extremes, parameters));
  for (const SignalRow& row : equalities_)
    if (row.watched == watched)
      largest = std::max(largest, std::abs(value(row, extremes, parameters)));
  return largest;
}

}  // namespace codesign
