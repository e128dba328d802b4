// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/mpi_engine.h"

#include "engine/thread_engine.h"

namespace codesign {

MpiEngine::MpiEngine(Dispatcher* dispatcher, const Problem& problem)
    : dispatcher_(dispatcher), problem_(dispatcher->add(make_portable(problem))), systems_(distinct_systems(problem)) {
  for (const auto& system : systems_) numbers_.emplace(system.get(), static_cast<std::uint32_t>(numbers_.size()));
  if (dispatcher_->ranks() <= kMostRanksWithLocal) local_ = std::thread([this] { compute(); });
}

MpiEngine::~MpiEngine() {
  dispatcher_->remove(problem_);
  if (local_.joinable()) local_.join();
}

int MpiEngine::workers() const { return dispatcher_->ranks() - (local_.joinable() ? 0 : 1); }

std::vector<Evaluation> MpiEngine::evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) {
  if (tasks.empty()) return {};
  std::vector<std::uint32_t> systems;
  systems.reserve(tasks.size());
  for (const EvaluationTask& task : tasks) systems.push_back(numbers_.at(task.system.get()));
  RankBatch batch{tasks, std::move(systems), problem_, cancel};
  std::vector<Evaluation> results(tasks.size());
  std::vector<bool> has_result(tasks.size(), false);
  dispatcher_->run(&batch, [&](std::size_t index, Evaluation evaluation) {
    results[index] = std::move(evaluation);
    has_result[index] = true;
    if (tasks[index].finished) tasks[index].finished(results[index]);
  });
  if (batch.error) std::rethrow_exception(batch.error);
  for (std::size_t k = 0; k < results.size(); ++k)
    if (!has_result[k]) results[k].status = batch.ended;
  return results;
}

void MpiEngine::compute() {
  EvaluationWorker worker;
  for (;;) {
    const auto [batch, index] = dispatcher_->take_local(problem_);
    if (batch == nullptr) return;
    Evaluation evaluation;
    std::exception_ptr error;
    try {
      const EvaluationTask& task = batch->tasks[index];
      evaluation = worker.compute(task.system, task.parameters, task.derivatives, batch->cancel);
    } catch (...) {
      error = std::current_exception();
    }
    dispatcher_->give_local(batch, index, std::move(evaluation), error);
  }
}

}  // namespace codesign
