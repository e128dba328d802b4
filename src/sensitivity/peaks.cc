// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/peaks.h"

#include <algorithm>
#include <cmath>

namespace codesign {

Peak find_peak(const WatchLayout::Entry& entry, const Eigen::VectorXd& values) {
  Peak peak{entry.first, values[entry.first] < 0.0 ? -1.0 : 1.0};
  for (int k = entry.first; k < entry.first + entry.size(); ++k)
    if (std::abs(values[k]) > std::abs(values[peak.place])) peak = {k, values[k] < 0.0 ? -1.0 : 1.0};
  return peak;
}

double peak_terms(const Study& study, const Extremes& extremes, Eigen::VectorXd* gradient) {
  return peak_terms(study, WatchLayout(study), extremes, gradient);
}

double peak_terms(const Study& study, const WatchLayout& layout, const Extremes& extremes, Eigen::VectorXd* gradient) {
  const auto is_peak = [](const WatchedSignal& watched) { return watched.role == WatchedSignal::Role::kPeak; };
  if (std::none_of(study.watched.begin(), study.watched.end(), is_peak)) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < study.watched.size(); ++k) {
    if (!is_peak(study.watched[k])) continue;
    const Peak peak = find_peak(layout.entries()[k], extremes.values);
    const double factor = study.watched[k].weight * peak.sign;
    sum += factor * extremes.values[peak.place];
    if (gradient) *gradient += factor * extremes.gradients.col(peak.place);
  }
  return sum;
}

}  // namespace codesign
