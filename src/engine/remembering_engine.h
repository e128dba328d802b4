// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_REMEMBERING_ENGINE_H_
#define MECHANISM_CODESIGN_ENGINE_REMEMBERING_ENGINE_H_

#include <functional>
#include <memory>
#include <vector>

#include "engine/evaluation_memory.h"

namespace codesign {

/// What the engine of a job has from it. All may be null.
struct EngineRecords {
  std::shared_ptr<EvaluationMemory> memory;
  /// Told of each finished evaluation, from any thread: whether it was computed (true) or remembered.
  std::function<void(bool)> counted = nullptr;
  Dispatcher* ranks = nullptr;  ///< the processes of the job, as in require_engine()
};

/// An engine with a memory: it does what the memory does not know, and tells the memory each result as soon as it is there. Cancelled
/// evaluations are neither remembered nor counted.
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

#endif  // MECHANISM_CODESIGN_ENGINE_REMEMBERING_ENGINE_H_
