// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What follows from the numbers of a SignalWatch.
#include <cmath>

#include "sensitivity/signal_watch.h"

namespace codesign {

Peak find_peak(const WatchLayout::Entry& entry, const Eigen::VectorXd& values) {
  const RangePlaces range = find_range(entry, values);
  if (std::abs(values[range.smallest]) > std::abs(values[range.largest]))
    return {range.smallest, -1.0};
  return {range.largest, values[range.largest] < 0.0 ? -1.0 : 1.0};
}

// Where the value at an instant between two windows is also one of theirs, that of a window counts:
// its derivatives are those of a number that may move with a guard.
RangePlaces find_range(const WatchLayout::Entry& entry, const Eigen::VectorXd& values) {
  const int windows = entry.windows() > 0 ? entry.largest(0) : entry.first;
  RangePlaces range{windows, windows};
  const auto look = [&](int from, int to) {
    for (int k = from; k < to; ++k) {
      if (values[k] > values[range.largest]) range.largest = k;
      if (values[k] < values[range.smallest]) range.smallest = k;
    }
  };
  look(windows, entry.measure());
  look(entry.first, windows);
  return range;
}

double watched_term(const WatchedSignal& watched, const WatchLayout::Entry& entry,
                    const Extremes& extremes, Eigen::VectorXd* gradient) {
  if (!is_term(watched)) return 0.0;
  const Peak number = watched.role == WatchedSignal::Role::kPeak ? find_peak(entry, extremes.values)
                                                                 : Peak{entry.measure(), 1.0};
  const double factor = watched.weight * number.sign;
  if (gradient) *gradient += factor * extremes.gradients.col(number.place);
  return factor * extremes.values[number.place];
}

double watched_terms(const MotionStudy& study, const WatchLayout& layout, const Extremes& extremes,
                     Eigen::VectorXd* gradient) {
  double sum = 0.0;
  for (std::size_t k = 0; k < study.watched.size(); ++k)
    sum += watched_term(study.watched[k], layout.entries()[k], extremes, gradient);
  return sum;
}

void set_measure(const WatchedSignal& watched, const WatchLayout::Entry& entry,
                 Extremes* extremes) {
  const RangePlaces range = find_range(entry, extremes->values);
  const bool minimum = watched.measure == WatchedSignal::Measure::kMinimum,
             stroke = watched.measure == WatchedSignal::Measure::kStroke;
  const int from = minimum ? range.smallest : range.largest, place = entry.measure();
  extremes->times[place] = extremes->times[from];
  extremes->values[place] =
      extremes->values[from] - (stroke ? extremes->values[range.smallest] : 0.0);
  if (extremes->gradients.rows() == 0) return;
  extremes->gradients.col(place) = extremes->gradients.col(from);
  if (stroke) extremes->gradients.col(place) -= extremes->gradients.col(range.smallest);
}

}  // namespace codesign
