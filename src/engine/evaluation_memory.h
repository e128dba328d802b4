// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_EVALUATION_MEMORY_H_
#define MECHANISM_CODESIGN_ENGINE_EVALUATION_MEMORY_H_

#include <optional>

#include "engine/evaluation_engine.h"

namespace codesign {

/// Results of tasks that are finished already, perhaps by an earlier process. Thread-safe.
class EvaluationMemory {
 public:
  virtual ~EvaluationMemory() = default;
  /// The result of a task with the same system, the same bits of all parameters, and the same derivatives; nothing if it is not known.
  virtual std::optional<Evaluation> find(const EvaluationTask& task) = 0;
  /// Told of each result as soon as it is there, in the thread that computed it. Must not throw.
  virtual void keep(const EvaluationTask& task, const Evaluation& evaluation) = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_EVALUATION_MEMORY_H_
