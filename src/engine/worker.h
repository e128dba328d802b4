// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "engine/evaluation_engine.h"
#include "text/cancel.h"

namespace codesign {

/// Runs one evaluation after another. Keeps the workspace of each system, so that it is allocated only once. Not thread-safe: use one
/// worker per thread.
class EvaluationWorker {
 public:
  Evaluation evaluate(const EvaluationTask& task, const std::atomic<bool>* cancel) {
    // After a cancel, tasks that still wait are not begun.
    if (is_set(cancel)) return cancelled();
    Evaluation result = compute(task.system, task.parameters, task.derivatives, cancel);
    if (task.finished) task.finished(result);
    return result;
  }
  Evaluation compute(const std::shared_ptr<const CompiledSystem>& system, const std::vector<double>& parameters, Derivatives derivatives,
                     const std::atomic<bool>* cancel) {
    const auto [place, is_new] = evaluators_.try_emplace(system.get(), system);
    return place->second.evaluate_design(parameters, derivatives, cancel);
  }

 private:
  static Evaluation cancelled() {
    Evaluation evaluation;
    evaluation.status = {StatusCode::kCancelled, 0.0, "cancelled"};
    return evaluation;
  }

  std::map<const CompiledSystem*, Evaluator> evaluators_;  // an Evaluator keeps its system alive, so that its address is not reused
};

}  // namespace codesign
