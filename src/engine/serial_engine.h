// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

#include "engine/worker.h"

namespace codesign {

/// Runs evaluations one after another in the thread of the caller.
class SerialEngine final : public EvaluationEngine {
 public:
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Evaluation> results;
    results.reserve(tasks.size());
    for (const EvaluationTask& task : tasks) results.push_back(worker_.evaluate(task, cancel));
    return results;
  }
  int workers() const override { return 1; }

 private:
  std::mutex mutex_;
  EvaluationWorker worker_;
};

}  // namespace codesign
