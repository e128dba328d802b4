// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "description/ensemble.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/warning.h"
#include "sensitivity/run_steps.h"

namespace codesign {

class CompiledSystem;

/// One requested evaluation: a run of a compiled study at one design.
struct EvaluationTask {
  std::shared_ptr<const CompiledSystem> system;
  std::vector<double> parameters;  ///< all named parameters (order of Study::parameters)
  Derivatives derivatives = Derivatives::kNone;
  /// Called with the result as soon as it is available; other tasks may still run. The call is in
  /// the thread that computed the result or, if another process computed it, in the thread that
  /// called evaluate(). Must not throw.
  std::function<void(const Evaluation&)> finished = nullptr;
  /// The run takes these steps in place of the study's; `stepped` is then `system` with them.
  RunSteps steps{};
  std::shared_ptr<const CompiledSystem> stepped = nullptr;
};

/// Runs evaluations on one or several workers. Each result depends only on its task, so that any
/// number of workers gives the same results to the last bit. Thread-safe: several threads may wait
/// for their evaluations at the same time.
class EvaluationEngine {
 public:
  virtual ~EvaluationEngine() = default;
  /// Runs all tasks and returns their results in the same order. @param cancel once set, the
  /// remaining tasks end with kCancelled; null: never.
  virtual std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks,
                                           const std::atomic<bool>* cancel) = 0;
  /// Number of evaluations that can run at the same time.
  virtual int workers() const = 0;
  /// Of the workers themselves.
  virtual Warnings warnings() const { return {}; }
};

class Dispatcher;

/// Checks that the engine of a study is available. @param ranks the processes of the job; null: the
/// program is built without MPI.
/// @throws InputError for kMpi without `ranks`, and, in a job of several processes, for any other
/// engine that the study names.
void require_engine(const EngineOptions& options, const Dispatcher* ranks);

/// Calls require_engine() and makes the engine for a problem: on all ranks if there are several,
/// else within this process as below.
std::unique_ptr<EvaluationEngine> make_engine(const Problem& problem, std::int64_t most_useful,
                                              Dispatcher* ranks);

/// Makes the engine within one process that `engine:` of a study requests. @param most_useful the
/// largest number of evaluations that wait at the same time; the engine has no more workers than
/// that.
std::unique_ptr<EvaluationEngine> make_engine(const EngineOptions& options,
                                              std::int64_t most_useful);

/// Keeps the results of finished tasks, so that they are not computed again; an earlier process may
/// have computed them. It is not asked for runs with other steps than the study's. Thread-safe.
class EvaluationMemory {
 public:
  virtual ~EvaluationMemory() = default;
  /// The result of a task with the same system, the same bits of all parameters, and the same
  /// derivatives; std::nullopt if there is none.
  virtual std::optional<Evaluation> find(const EvaluationTask& task) = 0;
  /// Called with each result as soon as it is available, in the thread that computed it. Must not
  /// throw.
  virtual void keep(const EvaluationTask& task, const Evaluation& evaluation) = 0;
};

/// What a job adds to its engine. All members may be null.
struct EngineRecords {
  std::shared_ptr<EvaluationMemory> memory;
  /// Called for each finished evaluation, from any thread: true if it was computed, false if the
  /// memory had its result.
  std::function<void(bool)> counted = nullptr;
  Dispatcher* ranks = nullptr;  ///< the processes of the job, as in require_engine()
};

/// An engine with a memory: it computes only the evaluations that the memory does not have, and
/// stores each new result in the memory as soon as it is available. Cancelled evaluations are
/// neither stored nor counted.
class RememberingEngine final : public EvaluationEngine {
 public:
  RememberingEngine(std::unique_ptr<EvaluationEngine> engine, EngineRecords records);

  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks,
                                   const std::atomic<bool>* cancel) override;
  int workers() const override { return engine_->workers(); }
  Warnings warnings() const override { return engine_->warnings(); }

 private:
  void note(const EvaluationTask& task, const Evaluation& evaluation) const;

  std::unique_ptr<EvaluationEngine> engine_;
  EngineRecords records_;
};

/// The engine itself if there is nothing to record.
std::unique_ptr<EvaluationEngine> with_records(std::unique_ptr<EvaluationEngine> engine,
                                               EngineRecords records);

}  // namespace codesign
