// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_PROGRESS_METER_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_PROGRESS_METER_H_

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

namespace codesign {

/// What a search is doing.
enum class SearchStage { kScreening, kSearching, kValidating };

/// How far a job is.
struct Progress {
  SearchStage stage = SearchStage::kSearching;
  /// Of screening: points. Of several searches: searches that have ended. Of one search: evaluations, and their largest number. Of
  /// validating: runs.
  std::int64_t done = 0, of = 0;
  std::int64_t starts = 0;       ///< number of searches; 0: one from the study's start
  std::int64_t runs = 0;         ///< runs at one design that are finished, those remembered from an earlier process included
  std::int64_t remembered = 0;   ///< runs that were not computed, but remembered
  double runs_per_second = 0.0;  ///< computed since the stage began; 0 while none is
  /// Until the end of the stage [s]; nothing while no run has been computed.
  std::optional<double> seconds_left;
  bool is_bound = false;  ///< seconds_left is what is left at most, since a search may end before its last evaluation
};

/// Called from any thread, by one at a time.
using ProgressObserver = std::function<void(const Progress&)>;

/// Counts what a job has done and tells an observer, at most once per `period` and at the end of screening. Thread-safe.
class ProgressMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param most_evaluations of one search. @param observer may be empty.
  ProgressMeter(std::int64_t most_evaluations, ProgressObserver observer, Clock::duration period = std::chrono::seconds(1));

  /// @param of number of points, of searches (0: one search), or of designs to validate. @param scenarios runs per evaluation.
  void begin(SearchStage stage, std::int64_t of, std::size_t scenarios);
  /// A run has been computed, or remembered.
  void count_run(bool computed);
  void count_trial();
  void count_point();
  /// @param trials of the search.
  void end_search(std::int64_t trials);

  Progress now() const;

 private:
  Progress measure() const;
  std::int64_t runs_left() const;
  void tell(bool at_once);

  const std::int64_t most_evaluations_;
  const ProgressObserver observer_;
  const Clock::duration period_;
  mutable std::mutex mutex_;  // guards all that follows
  SearchStage stage_ = SearchStage::kSearching;
  std::int64_t scenarios_ = 1, done_ = 0, of_ = 0, runs_ = 0, remembered_ = 0, runs_before_ = 0, computed_ = 0, trials_ = 0,
               ended_trials_ = 0;
  Clock::time_point began_, told_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_PROGRESS_METER_H_
