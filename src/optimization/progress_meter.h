// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

namespace codesign {

/// What a search is doing.
enum class SearchStage { kScreening, kSearching, kValidating };

/// The progress of a job.
struct Progress {
  SearchStage stage = SearchStage::kSearching;
  /// Finished and total number of points while screening, of searches in a job with several
  /// searches, of evaluations in a single search (the total is their limit), or of runs while
  /// validating.
  std::int64_t done = 0, of = 0;
  std::int64_t starts = 0;  ///< number of searches; 0: a single search from the study's start
  /// finished runs at one design, including runs remembered from an earlier process
  std::int64_t runs = 0;
  std::int64_t remembered = 0;  ///< runs that were remembered instead of computed
  /// rate of computed runs since the stage began; 0 before the first one
  double runs_per_second = 0.0;
  /// Time until the end of the stage [s]; empty before the first run has been computed.
  std::optional<double> seconds_left;
  /// whether seconds_left is an upper limit, since a search may end before its last evaluation
  bool is_bound = false;
};

/// Called from any thread, by one thread at a time.
using ProgressObserver = std::function<void(const Progress&)>;

/// Counts the finished work of a job and calls an observer, at most once per `period` and at the
/// end of screening. Thread-safe.
class ProgressMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param most_evaluations limit of evaluations of one search. @param observer may be empty.
  /// @param read_clock the time; a test gives it.
  ProgressMeter(std::int64_t most_evaluations, ProgressObserver observer,
                Clock::duration period = std::chrono::seconds(1),
                std::function<Clock::time_point()> read_clock = Clock::now);

  /// @param of number of points, of searches (0: one search), or of designs to validate. @param
  /// scenarios runs per evaluation.
  void begin(SearchStage stage, std::int64_t of, std::size_t scenarios);
  /// Counts a finished run. @param computed false: it was remembered.
  void count_run(bool computed);
  void count_trial();
  void count_point();
  /// @param trials number of trial points of the search.
  void end_search(std::int64_t trials);

  Progress now() const;

 private:
  Progress measure() const;
  std::int64_t runs_left() const;
  void notify(bool at_once);

  const std::int64_t most_evaluations_;
  const ProgressObserver observer_;
  const Clock::duration period_;
  const std::function<Clock::time_point()> read_clock_;
  mutable std::mutex mutex_;  // guards all members below
  SearchStage stage_ = SearchStage::kSearching;
  std::int64_t scenarios_ = 1, done_ = 0, of_ = 0, runs_ = 0, remembered_ = 0, runs_before_ = 0,
               computed_ = 0, trials_ = 0, ended_trials_ = 0;
  Clock::time_point began_, notified_;
};

}  // namespace codesign
