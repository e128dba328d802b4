// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/evaluation_memory.h"

namespace codesign {

/// What a job adds to its engine. All members may be null.
struct EngineRecords {
  std::shared_ptr<EvaluationMemory> memory;
  /// Called for each finished evaluation, from any thread: true if it was computed, false if the memory had its result.
  std::function<void(bool)> counted = nullptr;
  Dispatcher* ranks = nullptr;  ///< the processes of the job, as in require_engine()
};

/// An engine with a memory: it computes only the evaluations that the memory does not have, and stores each new result in the memory as
/// soon as it is available. Cancelled evaluations are neither stored nor counted.
class RememberingEngine final : public EvaluationEngine {
 public:
  RememberingEngine(std::unique_ptr<EvaluationEngine> engine, EngineRecords records);

  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) override;
  int workers() const override { return engine_->workers(); }

 private:
  void note(const EvaluationTask& task, const Evaluation& evaluation) const;

  std::unique_ptr<EvaluationEngine> engine_;
  EngineRecords records_;
};

/// The engine itself if there is nothing to record.
std::unique_ptr<EvaluationEngine> with_records(std::unique_ptr<EvaluationEngine> engine, EngineRecords records);

}  // namespace codesign
