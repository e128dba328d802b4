// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/progress_meter.h"

#include <algorithm>
#include <utility>

namespace codesign {

ProgressMeter::ProgressMeter(std::int64_t most_evaluations, ProgressObserver observer,
                             Clock::duration period, std::function<Clock::time_point()> read_clock)
    : most_evaluations_(most_evaluations),
      observer_(std::move(observer)),
      period_(period),
      read_clock_(std::move(read_clock)),
      began_(read_clock_()),
      notified_(began_) {}

void ProgressMeter::begin(SearchStage stage, std::int64_t of, std::size_t scenarios) {
  const std::lock_guard<std::mutex> lock(mutex_);
  stage_ = stage;
  of_ = of;
  scenarios_ = static_cast<std::int64_t>(scenarios);
  done_ = computed_ = trials_ = ended_trials_ = 0;
  runs_before_ = runs_;
  began_ = read_clock_();
}

void ProgressMeter::count_run(bool computed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++runs_;
  ++(computed ? computed_ : remembered_);
  notify(false);
}

void ProgressMeter::count_trial() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++trials_;
}

void ProgressMeter::count_point() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  notify(done_ == of_);
}

void ProgressMeter::end_search(std::int64_t trials) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  ended_trials_ += trials;
  notify(false);
}

Progress ProgressMeter::now() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return measure();
}

/// Runs until the end of the stage. A running search is expected to take as many trials as the
/// finished searches on average, or up to its limit if no search has finished.
std::int64_t ProgressMeter::runs_left() const {
  if (stage_ == SearchStage::kScreening) return (of_ - done_) * scenarios_;
  if (stage_ == SearchStage::kValidating) return of_ * scenarios_ - (runs_ - runs_before_);
  const std::int64_t expected =
      done_ > 0 ? ended_trials_ * of_ / done_ : std::max<std::int64_t>(1, of_) * most_evaluations_;
  return (expected - trials_) * scenarios_;
}

Progress ProgressMeter::measure() const {
  Progress progress;
  progress.stage = stage_;
  progress.done = done_;
  progress.of = of_;
  progress.runs = runs_;
  progress.remembered = remembered_;
  if (stage_ == SearchStage::kValidating) {
    progress.done = runs_ - runs_before_;
    progress.of = of_ * scenarios_;
  }
  if (stage_ == SearchStage::kSearching) {
    progress.starts = of_;
    progress.is_bound = done_ == 0;
    if (of_ == 0) {
      progress.done = trials_;
      progress.of = most_evaluations_;
    }
  }
  const double seconds = std::chrono::duration<double>(read_clock_() - began_).count();
  if (computed_ == 0 || seconds <= 0.0) return progress;
  progress.runs_per_second = static_cast<double>(computed_) / seconds;
  progress.seconds_left =
      static_cast<double>(std::max<std::int64_t>(0, runs_left())) / progress.runs_per_second;
  return progress;
}

void ProgressMeter::notify(bool at_once) {
  if (!observer_ || (!at_once && read_clock_() - notified_ < period_)) return;
  observer_(measure());
  notified_ = read_clock_();
}

}  // namespace codesign
