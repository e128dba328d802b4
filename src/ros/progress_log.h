// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/OptimizationProgress.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace codesign {

/// The trial points of a job in bounded memory: beyond `capacity` points, only every second, then every fourth, ... point is kept, and
/// always the last one.
class ProgressLog {
 public:
  /// @param capacity even, at least 2.
  explicit ProgressLog(std::size_t capacity = 10000) : capacity_(capacity) {}

  void add(mechanism_codesign::OptimizationProgress progress);
  const mechanism_codesign::OptimizationProgress& last() const { return last_; }

  /// Moves out the kept points, in order. The log must not be used afterwards.
  std::vector<mechanism_codesign::OptimizationProgress> take();

 private:
  std::size_t capacity_, stride_ = 1, count_ = 0;
  std::vector<mechanism_codesign::OptimizationProgress> kept_;
  mechanism_codesign::OptimizationProgress last_;
};

}  // namespace codesign
