// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "engine/evaluation_engine.h"

namespace codesign {

/// Keeps the results of finished tasks, so that they are not computed again; an earlier process may have computed them. Thread-safe.
class EvaluationMemory {
 public:
  virtual ~EvaluationMemory() = default;
  /// The result of a task with the same system, the same bits of all parameters, and the same derivatives; std::nullopt if there is none.
  virtual std::optional<Evaluation> find(const EvaluationTask& task) = 0;
  /// Called with each result as soon as it is available, in the thread that computed it. Must not throw.
  virtual void keep(const EvaluationTask& task, const Evaluation& evaluation) = 0;
};

}  // namespace codesign
