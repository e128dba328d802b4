// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/progress_log.h"

namespace codesign {

void ProgressLog::add(mechanism_codesign::OptimizationProgress progress) {
  last_ = std::move(progress);
  if (count_++ % stride_ != 0) return;
  if (kept_.size() == capacity_) {
    for (std::size_t k = 1; 2 * k < kept_.size(); ++k) kept_[k] = std::move(kept_[2 * k]);
    kept_.resize(capacity_ / 2);
    stride_ *= 2;
  }
  kept_.push_back(last_);
}

std::vector<mechanism_codesign::OptimizationProgress> ProgressLog::take() {
  if (!kept_.empty() && kept_.back().evaluation != last_.evaluation) kept_.push_back(last_);
  return std::move(kept_);
}

}  // namespace codesign
