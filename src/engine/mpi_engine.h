// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <thread>

#include "engine/dispatcher.h"

namespace codesign {

/// Runs the evaluations of one problem on all ranks of a job.
class MpiEngine final : public EvaluationEngine {
 public:
  /// @param dispatcher must outlive it.
  MpiEngine(Dispatcher* dispatcher, const Problem& problem);
  ~MpiEngine() override;
  MpiEngine(const MpiEngine&) = delete;
  MpiEngine& operator=(const MpiEngine&) = delete;

  /// @param tasks their systems must belong to the problem. Tasks that a lost rank leaves unfinished end with kWorkerLost.
  /// An exception of a task is thrown again here after the other tasks of the call have ended.
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) override;
  int workers() const override;

 private:
  void compute();

  Dispatcher* const dispatcher_;
  const std::uint32_t problem_;
  std::vector<std::shared_ptr<const CompiledSystem>> systems_;
  std::map<const CompiledSystem*, std::uint32_t> numbers_;
  std::thread local_;
};

}  // namespace codesign
