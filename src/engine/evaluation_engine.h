// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "description/ensemble.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

/// One requested evaluation: a run of a compiled study at one design.
struct EvaluationTask {
  std::shared_ptr<const CompiledSystem> system;
  std::vector<double> parameters;  ///< all named parameters (order of Study::parameters)
  Derivatives derivatives = Derivatives::kNone;
  /// Called with the result as soon as it is available; other tasks may still run. The call is in the thread that computed the result or,
  /// if another process computed it, in the thread that called evaluate(). Must not throw.
  std::function<void(const Evaluation&)> finished = nullptr;
};

/// Runs evaluations on one or several workers. Each result depends only on its task, so that any number of workers gives the same results
/// to the last bit. Thread-safe: several threads may wait for their evaluations at the same time.
class EvaluationEngine {
 public:
  virtual ~EvaluationEngine() = default;
  /// Runs all tasks and returns their results in the same order. @param cancel once set, the remaining tasks end with kCancelled; null:
  /// never.
  virtual std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) = 0;
  /// Number of evaluations that can run at the same time.
  virtual int workers() const = 0;
};

class Dispatcher;

/// Checks that the engine of a study is available. @param ranks the processes of the job; null: the program is built without MPI.
/// @throws InputError for kMpi without `ranks`, and, in a job of several processes, for any other engine that the study names.
void require_engine(const EngineOptions& options, const Dispatcher* ranks);

/// Calls require_engine() and makes the engine for a problem: on all ranks if there are several, else within this process as below.
std::unique_ptr<EvaluationEngine> make_engine(const Problem& problem, std::int64_t most_useful, Dispatcher* ranks);

/// Makes the engine within one process that `engine:` of a study requests. @param most_useful the largest number of evaluations that wait
/// at the same time; the engine has no more workers than that.
std::unique_ptr<EvaluationEngine> make_engine(const EngineOptions& options, std::int64_t most_useful);

}  // namespace codesign
