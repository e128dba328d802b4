// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/mpi_engine.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <thread>
#include <utility>

#include "engine/thread_engine.h"
#include "mechanism_codesign/version.h"

namespace codesign {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

MpiEngine::MpiEngine(Dispatcher* dispatcher, const Problem& problem)
    : dispatcher_(dispatcher),
      problem_(dispatcher->add(make_portable(problem))),
      systems_(distinct_systems(problem)) {
  for (const auto& system : systems_)
    numbers_.emplace(system.get(), static_cast<std::uint32_t>(numbers_.size()));
  if (dispatcher_->ranks() <= kMostRanksWithLocal) local_ = std::thread([this] { compute(); });
}

MpiEngine::~MpiEngine() {
  dispatcher_->remove(problem_);
  if (local_.joinable()) local_.join();
}

int MpiEngine::workers() const { return dispatcher_->ranks() - (local_.joinable() ? 0 : 1); }

std::vector<Evaluation> MpiEngine::evaluate(const std::vector<EvaluationTask>& tasks,
                                            const std::atomic<bool>* cancel) {
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
      evaluation = worker.compute(task.stepped ? task.stepped : task.system, task.parameters,
                                  task.derivatives, batch->cancel);
    } catch (...) {
      error = std::current_exception();
    }
    dispatcher_->give_local(batch, index, std::move(evaluation), error);
  }
}

RankWorker::RankWorker(Transport* transport, const RankTimes& times)
    : transport_(transport), times_(times) {}

std::string RankWorker::run() {
  transport_->send(0, write_hello({kMessageFormat, version(), host_name()}));
  std::thread computing([this] { compute(); });
  std::string fault = listen();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
    cancel_ = true;
  }
  has_items_.notify_all();
  computing.join();
  return fault;
}

std::string RankWorker::listen() {
  PollPause pause;
  Clock::time_point heard = times_.now(), sent = heard, looked = heard;
  for (;;) {
    bool is_quiet = true;
    const Clock::time_point now = times_.now();
    while (std::optional<Envelope> envelope = transport_->receive()) {
      heard = now;
      is_quiet = false;
      if (!take(std::move(*envelope))) return "";
    }
    // If this process itself was stopped, it has not received messages meanwhile; that time is not
    // the silence of rank 0.
    const Clock::duration away = now - std::exchange(looked, now);
    if (away > std::chrono::seconds(1)) heard += away;
    if (!transport_->failure().empty()) return transport_->failure();
    if (now - heard > times_.orphaned) return "rank 0 has said nothing for too long";
    std::unique_lock<std::mutex> lock(mutex_);
    std::vector<std::string> answers = std::exchange(answers_, {});
    if (answers.empty() && now - sent > times_.sign)
      answers.push_back(write_numbered(MessageKind::kSign));
    if (!answers.empty()) {
      lock.unlock();
      for (std::string& answer : answers) transport_->send(0, std::move(answer));
      sent = now;
      pause.restart(now);
      continue;
    }
    if (!is_quiet) {
      pause.restart(now);
      continue;
    }
    // During a computation only a cancel or a second task can arrive.
    const auto most = is_computing_ ? std::chrono::milliseconds(10) : std::chrono::milliseconds(20);
    has_answer_.wait_for(lock, pause.next(now, most), [this] { return !answers_.empty(); });
  }
}

bool RankWorker::take(Envelope envelope) {
  ByteReader reader(envelope.bytes);
  const auto kind = reader.get<MessageKind>();
  const auto number = reader.get<std::uint64_t>();
  switch (kind) {
    case MessageKind::kEnd:
      transport_->send(0, write_numbered(MessageKind::kGoodbye));
      return false;
    case MessageKind::kPing:
      transport_->send(0, write_numbered(MessageKind::kPong, number));
      return true;
    case MessageKind::kCancel:
      cancel_task(number);
      return true;
    case MessageKind::kProblem:
    case MessageKind::kTask:
    case MessageKind::kForget: {
      const std::lock_guard<std::mutex> lock(mutex_);
      items_.push_back({kind, number, std::move(envelope.bytes)});
      has_items_.notify_all();
      return true;
    }
    default:
      return true;
  }
}

void RankWorker::cancel_task(std::uint64_t number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (running_ == number) cancel_ = true;
  const auto is_it = [number](const Item& item) {
    return item.kind == MessageKind::kTask && item.number == number;
  };
  items_.erase(std::remove_if(items_.begin(), items_.end(), is_it), items_.end());
}

void RankWorker::compute() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    has_items_.wait(lock, [this] { return ends_ || !items_.empty(); });
    if (ends_) return;
    const Item item = std::move(items_.front());
    items_.pop_front();
    is_computing_ = true;
    running_ = item.kind == MessageKind::kTask ? item.number : 0;
    cancel_ = false;
    lock.unlock();
    std::string answer = do_item(item);
    lock.lock();
    is_computing_ = false;
    running_ = 0;
    if (answer.empty()) continue;
    answers_.push_back(std::move(answer));
    has_answer_.notify_all();
  }
}

/// @returns the answer; empty if there is none.
std::string RankWorker::do_item(const Item& item) {
  ByteReader reader(item.bytes);
  reader.get<MessageKind>();
  reader.get<std::uint64_t>();
  if (item.kind == MessageKind::kForget) {
    problems_.erase(static_cast<std::uint32_t>(item.number));
    return "";
  }
  if (item.kind == MessageKind::kProblem) {
    Known& known = problems_[static_cast<std::uint32_t>(item.number)];
    try {
      known.systems = distinct_systems(load_portable(read_problem(&reader)));
    } catch (...) {
      known.error = std::current_exception();
    }
    return "";
  }
  try {
    return write_result(item.number, evaluate(read_task(item.number, &reader)));
  } catch (...) {
    return write_error(item.number, std::current_exception());
  }
}

Evaluation RankWorker::evaluate(const TaskMessage& task) {
  Known& known = problems_.at(task.problem);
  if (known.error) std::rethrow_exception(known.error);
  const auto& own = known.systems.at(task.system);
  if (task.steps.method == RunSteps::Method::kOwn)
    return known.worker.compute(own, task.parameters, task.derivatives, &cancel_);
  std::shared_ptr<const CompiledSystem>& stepped = known.stepped[{task.system, task.steps}];
  if (!stepped) stepped = with_steps(*own, task.steps);
  return known.worker.compute(stepped, task.parameters, task.derivatives, &cancel_);
}

}  // namespace codesign
