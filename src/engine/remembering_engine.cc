// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/remembering_engine.h"

#include <utility>

#include "text/cancel.h"

namespace codesign {

RememberingEngine::RememberingEngine(std::unique_ptr<EvaluationEngine> engine, EngineRecords records)
    : engine_(std::move(engine)), records_(std::move(records)) {}

std::vector<Evaluation> RememberingEngine::evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) {
  std::vector<Evaluation> results(tasks.size());
  std::vector<EvaluationTask> unknown;
  std::vector<std::size_t> places;
  // A cancelled job ends even if its memory has results for further tasks.
  const bool looks_up = records_.memory && !is_set(cancel);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    if (std::optional<Evaluation> known = looks_up ? records_.memory->find(tasks[k]) : std::nullopt) {
      results[k] = std::move(*known);
      if (records_.counted) records_.counted(false);
      continue;
    }
    unknown.push_back(tasks[k]);
    unknown.back().finished = [this, &task = tasks[k]](const Evaluation& evaluation) { note(task, evaluation); };
    places.push_back(k);
  }
  std::vector<Evaluation> computed = engine_->evaluate(unknown, cancel);
  for (std::size_t k = 0; k < computed.size(); ++k) results[places[k]] = std::move(computed[k]);
  return results;
}

void RememberingEngine::note(const EvaluationTask& task, const Evaluation& evaluation) const {
  if (evaluation.status.is_interrupted()) return;
  if (records_.memory) records_.memory->keep(task, evaluation);
  if (records_.counted) records_.counted(true);
}

std::unique_ptr<EvaluationEngine> with_records(std::unique_ptr<EvaluationEngine> engine, EngineRecords records) {
  if (!records.memory && !records.counted) return engine;
  return std::make_unique<RememberingEngine>(std::move(engine), std::move(records));
}

}  // namespace codesign
