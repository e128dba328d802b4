// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/thread_engine.h"

#include "engine/worker.h"

namespace codesign {

ThreadEngine::ThreadEngine(int workers) {
  threads_.reserve(static_cast<std::size_t>(workers));
  for (int k = 0; k < workers; ++k) threads_.emplace_back([this] { work(); });
}

ThreadEngine::~ThreadEngine() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  has_work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::vector<Evaluation> ThreadEngine::evaluate(const std::vector<EvaluationTask>& tasks, const std::atomic<bool>* cancel) {
  if (tasks.empty()) return {};
  Batch batch{tasks, cancel, std::vector<Evaluation>(tasks.size()), 0, 0, nullptr};
  std::unique_lock<std::mutex> lock(mutex_);
  batches_.push_back(&batch);
  has_work_.notify_all();
  is_done_.wait(lock, [&batch] { return batch.done == batch.tasks.size(); });
  if (batch.error) std::rethrow_exception(batch.error);
  return std::move(batch.results);
}

void ThreadEngine::work() {
  EvaluationWorker worker;
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    has_work_.wait(lock, [this] { return ends_ || !batches_.empty(); });
    if (ends_) return;
    Batch& batch = *batches_.front();
    const std::size_t k = batch.next++;
    if (batch.next == batch.tasks.size()) batches_.pop_front();
    lock.unlock();
    Evaluation result;
    std::exception_ptr error;
    try {
      result = worker.evaluate(batch.tasks[k], batch.cancel);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    batch.results[k] = std::move(result);
    if (error && !batch.error) batch.error = error;
    // The batch is a local variable of evaluate(), which may return as soon as the last task is counted.
    if (++batch.done == batch.tasks.size()) is_done_.notify_all();
  }
}

}  // namespace codesign
