// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/watch_layout.h"

#include <algorithm>
#include <cmath>

#include "description/linear_measure.h"
#include "integration/step_control.h"

namespace codesign {
namespace {

// Equal windows of an interval, so that two extrema seldom compete within one.
constexpr int kWindows = 16;
// Break times that are instants: each adds rows to the optimizer's problem.
constexpr std::size_t kMost = 200;

std::vector<double> instants_of(const WatchedSignal& watched, const std::vector<double>& breaks) {
  if (!(watched.after < watched.before)) return {watched.before};
  const double span = watched.before - watched.after, apart = 1e-6 * span;
  std::vector<double> all;
  for (int k = 0; k <= kWindows; ++k)
    all.push_back(k < kWindows ? watched.after + span * k / kWindows : watched.before);
  if (breaks.size() <= kMost)
    for (double time : breaks)
      if (time > watched.after + apart && time < watched.before - apart) all.push_back(time);
  std::sort(all.begin(), all.end());
  const auto is_near = [apart](double a, double b) { return b - a < apart; };
  all.erase(std::unique(all.begin(), all.end(), is_near), all.end());
  return all;
}

/// Numbers of a linearization have places in the order of their size in place of instants.
std::vector<double> places_of(const LinearMeasure& measure) {
  std::vector<double> all;
  for (int k = 0; k < measure.places(); ++k) all.push_back(k);
  return all;
}

std::vector<double> postures_of(const WatchedSignal& watched) {
  std::vector<double> all;
  for (double number = std::ceil(watched.after); number <= watched.before; ++number)
    all.push_back(number);
  return all;
}

}  // namespace

WatchLayout::WatchLayout(const MotionStudy& study) {
  if (study.watched.empty()) return;
  breaks_ = BreakTimes(study).times();
  for (const WatchedSignal& watched : study.watched) {
    Entry& entry = entries_.emplace_back();
    entry.first = size_;
    entry.is_list = study.postures > 0 || watched.linear;
    entry.instants = watched.linear  ? places_of(*watched.linear)
                     : entry.is_list ? postures_of(watched)
                                     : instants_of(watched, breaks_);
    entry.is_measured = watched.measure != WatchedSignal::Measure::kNone;
    size_ += entry.size();
  }
}

std::optional<double> WatchLayout::break_near(double time, double slack) const {
  const auto found = std::lower_bound(breaks_.begin(), breaks_.end(), time - slack);
  if (found == breaks_.end() || *found > time + slack) return std::nullopt;
  return *found;
}

}  // namespace codesign
