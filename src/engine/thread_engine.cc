// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/thread_engine.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "math/arrays.h"

namespace codesign {
namespace {

/// Starts `count` threads that run `loop`, or as many of them as the system makes.
template <class Loop>
void start_threads(std::size_t count, const Loop& loop, std::vector<std::thread>* threads) {
  threads->reserve(count);
  try {
    while (threads->size() < count) threads->emplace_back(loop);
  } catch (const std::system_error&) {  // a limit of processes or of memory
  }
}

}  // namespace

void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const std::size_t most = std::min(count, to_index(std::max(1, threads)));
  if (most <= 1) {
    for (std::size_t k = 0; k < count; ++k) work(k);
    return;
  }
  std::mutex mutex;  // guards next and error
  std::size_t next = 0;
  std::exception_ptr error;
  const auto loop = [&] {
    std::unique_lock<std::mutex> lock(mutex);
    while (next < count && !error) {
      const std::size_t k = next++;
      lock.unlock();
      std::exception_ptr caught;
      try {
        work(k);
      } catch (...) {
        caught = std::current_exception();
      }
      lock.lock();
      if (caught && !error) error = caught;
    }
  };
  std::vector<std::thread> pool;
  start_threads(most, loop, &pool);
  if (pool.size() < most) loop();
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

int worker_threads(const EngineOptions& engine) {
  if (engine.kind == EngineKind::kSerial) return 1;
  return engine.workers > 0 ? engine.workers
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ThreadEngine::ThreadEngine(int workers) : wanted_(workers) {
  start_threads(
      to_index(workers), [this] { work(); }, &threads_);
}

Warnings ThreadEngine::warnings() const {
  if (workers() == wanted_) return {};
  return {
      {"fewer_workers",
       "the system makes no more threads than " + std::to_string(threads_.size()) + " of the " +
           std::to_string(wanted_) +
           " wanted, so that the work takes longer, with the same results; `engine: {workers: " +
           std::to_string(workers()) + "}` asks for no more",
       {}}};
}

ThreadEngine::~ThreadEngine() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  has_work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::vector<Evaluation> ThreadEngine::evaluate(const std::vector<EvaluationTask>& tasks,
                                               const std::atomic<bool>* cancel) {
  if (tasks.empty()) return {};
  if (threads_.empty()) return alone_.evaluate(tasks, cancel);
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
    // The batch is a local variable of evaluate(), which may return as soon as the last task is
    // counted.
    if (++batch.done == batch.tasks.size()) is_done_.notify_all();
  }
}

}  // namespace codesign
