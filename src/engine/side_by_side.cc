// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/side_by_side.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace codesign {

void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const std::size_t most = std::min(count, static_cast<std::size_t>(std::max(1, threads)));
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
  for (std::size_t k = 0; k < most; ++k) pool.emplace_back(loop);
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

int worker_threads(const EngineOptions& engine) {
  if (engine.kind == EngineKind::kSerial) return 1;
  return engine.workers > 0 ? engine.workers : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace codesign
