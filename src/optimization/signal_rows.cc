// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/signal_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "description/motion_study.h"
#include "math/arrays.h"
#include "sampling/measure.h"
#include "sensitivity/signal_watch.h"

namespace codesign {

SlackForm::SlackForm(const RobustOptions& options, Eigen::VectorXd weights)
    : measure_(options.measure), level_(options.level), weights_(std::move(weights)) {
  grouped(options, Eigen::VectorXd::Zero(weights_.size()), weights_, &shares_);
}

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
    if (is_term(watched)) {
      if (is_largest_of_many(watched)) add_term(k);
    } else if (watched.role == WatchedSignal::Role::kBounded) {
      add_measure(k);
    } else if (is_equality(watched)) {
      equalities_.push_back({k, layout_.entries()[k].first});
    } else {
      if (watched.upper) add(k, 1.0, -1);
      if (watched.lower) add(k, -1.0, -1);
    }
  }
}

/// Rows for every instant and window of a signal. The extreme value between two instants has its
/// own row beside the rows of the instants, so that each row stays smooth when the extremum moves
/// from one place to another.
void SignalRows::add(std::size_t watched, double sign, int peak, int centre) {
  const WatchLayout::Entry& entry = layout_.entries()[watched];
  for (int k = 0; k < static_cast<int>(entry.instants.size()); ++k)
    inequalities_.push_back({watched, entry.at_instant(k), sign, peak, centre});
  for (int k = 0; k < entry.windows(); ++k)
    inequalities_.push_back(
        {watched, sign > 0.0 ? entry.largest(k) : entry.smallest(k), sign, peak, centre});
}

/// A stroke is twice the peak about its centre.
void SignalRows::add_term(std::size_t watched) {
  const WatchedSignal::Measure measure = study_.watched[watched].measure;
  const int peak = static_cast<int>(peaks_.size()), centre = static_cast<int>(centres_.size());
  const bool is_stroke = measure == WatchedSignal::Measure::kStroke;
  peaks_.push_back(watched);
  if (is_stroke) centres_.push_back(watched);
  if (measure != WatchedSignal::Measure::kMinimum) add(watched, 1.0, peak, is_stroke ? centre : -1);
  if (measure != WatchedSignal::Measure::kMaximum)
    add(watched, -1.0, peak, is_stroke ? centre : -1);
}

/// Bounds that all values must keep get a row for each value. Where it is enough that one value
/// reaches a bound, and for times, the measure has one row.
void SignalRows::add_measure(std::size_t watched) {
  const WatchedSignal& signal = study_.watched[watched];
  const int place = layout_.entries()[watched].measure();
  const auto add_bound = [&](double sign) {
    const int centre = static_cast<int>(centres_.size());
    switch (signal.measure) {
      case WatchedSignal::Measure::kMaximum:
        return sign > 0.0 ? add(watched, sign, -1)
                          : inequalities_.push_back({watched, place, sign});
      case WatchedSignal::Measure::kMinimum:
        return sign < 0.0 ? add(watched, sign, -1)
                          : inequalities_.push_back({watched, place, sign});
      case WatchedSignal::Measure::kStroke:
        if (sign < 0.0) return inequalities_.push_back({watched, place, sign});
        centres_.push_back(watched);
        add(watched, 1.0, -1, centre);
        return add(watched, -1.0, -1, centre);
      default:
        return inequalities_.push_back({watched, place, sign});
    }
  };
  if (signal.upper) add_bound(1.0);
  if (signal.lower) add_bound(-1.0);
}

double SignalRows::peak(int peak, const Extremes& extremes) const {
  const std::size_t watched = peaks_[to_index(peak)];
  const WatchLayout::Entry& entry = layout_.entries()[watched];
  const RangePlaces range = find_range(entry, extremes.values);
  const double largest = extremes.values[range.largest], smallest = extremes.values[range.smallest];
  switch (study_.watched[watched].measure) {
    case WatchedSignal::Measure::kMaximum:
      return largest;
    case WatchedSignal::Measure::kMinimum:
      return -smallest;
    case WatchedSignal::Measure::kStroke:
      return 0.5 * (largest - smallest);
    default:
      return std::max(std::abs(largest), std::abs(smallest));
  }
}

SignalRows::Centre SignalRows::centre(int centre, const Extremes& extremes) const {
  const RangePlaces range =
      find_range(layout_.entries()[centres_[to_index(centre)]], extremes.values);
  const double largest = extremes.values[range.largest], smallest = extremes.values[range.smallest];
  return {0.5 * (largest + smallest), 0.5 * (largest - smallest)};
}

const Quantity& SignalRows::bound(const SignalRow& row) const {
  const WatchedSignal& watched = study_.watched[row.watched];
  return row.sign > 0.0 || row.centre >= 0 ? *watched.upper : *watched.lower;
}

/// The factor of the bound in the row of a constraint.
double SignalRows::bound_factor(const SignalRow& row) { return row.centre >= 0 ? -0.5 : -row.sign; }

double SignalRows::value(const SignalRow& row, const Extremes& extremes,
                         const std::vector<double>& parameters) const {
  const double x = row.sign * extremes.values[row.place];
  return row.peak >= 0 ? x : x + bound_factor(row) * bound(row).at(parameters);
}

double SignalRows::derivative(const SignalRow& row, std::size_t k, const Extremes& extremes,
                              const std::vector<double>& parameters) const {
  const double x = row.sign * extremes.gradients(to_signed(k), row.place);
  if (row.peak >= 0 || bound(row).is_constant()) return x;
  return x + bound_factor(row) * bound(row).expression()->derivative(study_.tuned[k], parameters);
}

double SignalRows::violation(std::size_t watched, const Extremes& extremes,
                             const std::vector<double>& parameters) const {
  double largest = 0.0;
  const WatchedSignal& signal = study_.watched[watched];
  if (signal.role == WatchedSignal::Role::kBounded) {
    const double number = extremes.values[layout_.entries()[watched].measure()];
    if (signal.upper) largest = std::max(largest, number - signal.upper->at(parameters));
    if (signal.lower) largest = std::max(largest, signal.lower->at(parameters) - number);
    return largest;
  }
  for (const SignalRow& row : inequalities_)
    if (row.watched == watched && row.peak < 0)
      largest = std::max(largest, value(row, extremes, parameters));
  for (const SignalRow& row : equalities_)
    if (row.watched == watched)
      largest = std::max(largest, std::abs(value(row, extremes, parameters)));
  return largest;
}

}  // namespace codesign
