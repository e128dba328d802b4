// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/worker.h"

#include <utility>

namespace codesign {

Worker::Worker() : thread_([this] { run(); }) {}

void Worker::finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    cancel_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool Worker::try_start(Job job, std::function<void()> done) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (job_ || ending_) return false;
    cancel_ = false;
    job_ = std::move(job);
    done_ = std::move(done);
  }
  changed_.notify_all();
  return true;
}

bool Worker::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return job_ && !cancel_.exchange(true);
}

bool Worker::busy() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<bool>(job_);
}

void Worker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || job_; });
    if (!job_) return;
    lock.unlock();
    job_(cancel_);
    lock.lock();
    job_ = nullptr;
    const std::function<void()> done = std::move(done_);
    lock.unlock();
    done();
    lock.lock();
  }
}

}  // namespace codesign
