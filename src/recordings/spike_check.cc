// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "recordings/recording_check.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr std::size_t kReach = 5, kLongest = 3;  // samples beside one that its median takes; samples of a spike
constexpr double kSteps = 20.0;                  // usual steps between neighbours by which a spike leaves them

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median of the steps between neighbours that are not zero; 0 if there are none.
double usual_step(const std::vector<double>& column) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < column.size(); ++k)
    if (column[k] != column[k - 1]) steps.push_back(std::abs(column[k] - column[k - 1]));
  return steps.empty() ? 0.0 : median_of(std::move(steps));
}

/// Samples that leave the median of their neighbours, which follows ramps and jumps, by many usual steps.
std::vector<bool> suspects_of(const std::vector<double>& column) {
  const double most = kSteps * usual_step(column);
  std::vector<bool> suspects(column.size(), false);
  for (std::size_t k = 0; k < column.size(); ++k) {
    const std::size_t begin = k < kReach ? 0 : k - kReach, end = std::min(column.size(), k + kReach + 1);
    const auto at = [&column](std::size_t i) { return column.begin() + static_cast<std::ptrdiff_t>(i); };
    suspects[k] = std::abs(column[k] - median_of({at(begin), at(end)})) > most;
  }
  return suspects;
}

/// The samples of spikes: short runs of suspects that leave the range of all other samples by more than this range.
std::vector<std::size_t> spikes_of(const std::vector<double>& column) {
  const std::vector<bool> suspects = suspects_of(column);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t k = 0; k < column.size(); ++k)
    if (!suspects[k]) {
      least = std::min(least, column[k]);
      most = std::max(most, column[k]);
    }
  std::vector<std::size_t> spikes;
  for (std::size_t begin = 0; begin < column.size(); ++begin) {
    std::size_t end = begin;
    while (end < column.size() && suspects[end]) ++end;
    const bool is_short = end - begin <= kLongest;
    for (std::size_t k = begin; k < end; ++k)
      if (is_short && std::max(column[k] - most, least - column[k]) > most - least) spikes.push_back(k);
    begin = end;
  }
  return spikes;
}

}  // namespace

void check_spikes(const JointRecording& recording, Warnings* warnings) {
  for (const JointSamples& samples : recording.joints)
    for (std::size_t q = 0; q < kMeasuredQuantityNames.size(); ++q) {
      const std::vector<double>& column = samples.of(static_cast<MeasuredQuantity>(q));
      const std::vector<std::size_t> spikes = spikes_of(column);
      if (spikes.empty()) continue;
      const std::size_t first = spikes.front();
      warnings->push_back(
          warn("recording_spike", {recording.location_of(first), recording.element,
                                   "the " + std::string(kMeasuredQuantityNames[q]) + " of " + samples.joint + " jumps to " +
                                       readable(column[first], 6) + " and back (" + recording.place_of(first) + ")" +
                                       (spikes.size() > 1 ? ", one of " + std::to_string(spikes.size()) + " such samples" : ""),
                                   "", "a recording without it: `from` and `to`; or `loss: {type: huber}`, which lets it count less"}));
    }
}

}  // namespace codesign
