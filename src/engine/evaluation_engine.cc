// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation_engine.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "description/study.h"
#include "engine/mpi_engine.h"
#include "engine/thread_engine.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "text/cancel.h"

namespace codesign {

void require_engine(const EngineOptions& options, const Dispatcher* ranks) {
  const char* const kElement = "engine.type";
  if (options.kind == EngineKind::kMpi && ranks == nullptr)
    throw InputError({options.where, kElement, "the engine mpi is not in this program",
                      kEngineNames[2],
                      "serial or threads; codesign and the node optimization have it where they "
                      "are built with libopenmpi-dev installed"});
  if (ranks == nullptr || ranks->ranks() == 1 || options.kind == EngineKind::kMpi ||
      options.where.file.empty())
    return;
  throw InputError({options.where, kElement,
                    "mpirun has started " + std::to_string(ranks->ranks()) +
                        " processes, and the study asks for an engine of one",
                    kEngineNames[to_index(options.kind)],
                    "mpi, no engine at all, or the same command without mpirun"});
}

std::unique_ptr<EvaluationEngine> make_engine(const Problem& problem, std::int64_t most_useful,
                                              Dispatcher* ranks) {
  const EngineOptions& options = study_of(problem).ensemble.engine;
  require_engine(options, ranks);
  if (most_useful > 1 && ranks != nullptr && ranks->ranks() > 1)
    return std::make_unique<MpiEngine>(ranks, problem);
  return make_engine(options, most_useful);
}

std::unique_ptr<EvaluationEngine> make_engine(const EngineOptions& options,
                                              std::int64_t most_useful) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto workers = static_cast<int>(
      std::min<std::int64_t>(options.workers > 0 ? options.workers : processors, most_useful));
  if (options.kind != EngineKind::kThreads || workers <= 1) return std::make_unique<SerialEngine>();
  return std::make_unique<ThreadEngine>(workers);
}

RememberingEngine::RememberingEngine(std::unique_ptr<EvaluationEngine> engine,
                                     EngineRecords records)
    : engine_(std::move(engine)), records_(std::move(records)) {}

std::vector<Evaluation> RememberingEngine::evaluate(const std::vector<EvaluationTask>& tasks,
                                                    const std::atomic<bool>* cancel) {
  std::vector<Evaluation> results(tasks.size());
  std::vector<EvaluationTask> unknown;
  std::vector<std::size_t> places;
  // A cancelled job ends even if its memory has results for further tasks.
  const bool looks_up = records_.memory && !is_set(cancel);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    if (std::optional<Evaluation> known =
            looks_up && !tasks[k].stepped ? records_.memory->find(tasks[k]) : std::nullopt) {
      results[k] = std::move(*known);
      if (records_.counted) records_.counted(false);
      continue;
    }
    unknown.push_back(tasks[k]);
    unknown.back().finished = [this, &task = tasks[k]](const Evaluation& evaluation) {
      note(task, evaluation);
    };
    places.push_back(k);
  }
  std::vector<Evaluation> computed = engine_->evaluate(unknown, cancel);
  for (std::size_t k = 0; k < computed.size(); ++k) results[places[k]] = std::move(computed[k]);
  return results;
}

void RememberingEngine::note(const EvaluationTask& task, const Evaluation& evaluation) const {
  if (evaluation.status.is_interrupted() || task.stepped) return;
  if (records_.memory) records_.memory->keep(task, evaluation);
  if (records_.counted) records_.counted(true);
}

std::unique_ptr<EvaluationEngine> with_records(std::unique_ptr<EvaluationEngine> engine,
                                               EngineRecords records) {
  if (!records.memory && !records.counted) return engine;
  return std::make_unique<RememberingEngine>(std::move(engine), std::move(records));
}

}  // namespace codesign
