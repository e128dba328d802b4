// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ENGINE_EVALUATION_ENGINE_H_
#define MECHANISM_CODESIGN_ENGINE_EVALUATION_ENGINE_H_

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "description/ensemble.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

/// One evaluation to do: a run of a compiled study at one design.
struct EvaluationTask {
  std::shared_ptr<const CompiledSystem> system;
  std::vector<double> parameters;  ///< all named parameters (order of Study::parameters)
  Derivatives derivatives = Derivatives::kNone;
  /// Told of the result as soon as it is there, in the thread that computed it, or, if another process did, in that of the caller, while
  /// other tasks may still run. Must not throw.
  std::function<void(const Evaluation&)> finished = nullptr;
};

/// Does evaluations, on one or on several workers. Each result depends on its task alone, so the results are the same bits for any number
/// of workers. Thread-safe: several threads may wait for their evaluations at the same time.
class EvaluationEngine {
 public:
  virtual ~EvaluationEngine() = default;
  /// Does all tasks and returns their results in the same order. @param cancel once set, the tasks left end with kCancelled; null: never.
  virtual std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) = 0;
  /// How many evaluations run at the same time.
  virtual int workers() const = 0;
};

class Dispatcher;

/// Checks that the engine a study asks for is there. @param ranks the processes of the job; null: this program is not built for several.
/// @throws InputError for kMpi without `ranks`, and for another engine that a study names in a job of several processes.
void require_engine(const EngineOptions& options, const Dispatcher* ranks);

/// The engine for a problem: on all ranks if there are several, else the one below. @param ranks as in require_engine(), which it calls.
std::unique_ptr<EvaluationEngine> make_engine(const Problem& problem, std::int64_t most_useful, Dispatcher* ranks);

/// The engine of one process that a study asks for by `engine:`. @param most_useful the largest number of evaluations that will wait at the
/// same time; more workers are not made.
std::unique_ptr<EvaluationEngine> make_engine(const EngineOptions& options, std::int64_t most_useful);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ENGINE_EVALUATION_ENGINE_H_
