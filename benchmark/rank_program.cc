// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/rank_program.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <thread>

#include "benchmark/slider_crank.h"
#include "engine/mpi_engine.h"
#include "ensemble/ensemble.h"
#include "mechanism_codesign/version.h"
#include "mpi/mpi_transport.h"
#include "mpi/run_on_ranks.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr int kSamples = 32;
using RankClock = std::chrono::steady_clock;

double seconds_since(RankClock::time_point begin) {
  return std::chrono::duration<double>(RankClock::now() - begin).count();
}

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int measure_gradient(Dispatcher* ranks) {
  constexpr int kRepetitions = 7;
  const Problem problem = with_uncertain_masses(load_slider_crank(), kSamples, "{type: mpi}");
  const Ensemble ensemble(problem, 1, {nullptr, nullptr, ranks});
  double wall = std::numeric_limits<double>::infinity(), cpu = wall, evaluations = wall;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const RankClock::time_point begin = RankClock::now();
    const double before = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    const EnsembleEvaluation evaluation = ensemble.evaluate(problem.start(), true);
    if (!evaluation.total.status.ok()) throw std::runtime_error(evaluation.total.status.cause);
    wall = std::min(wall, seconds_since(begin));
    cpu = std::min(cpu, seconds_of(CLOCK_PROCESS_CPUTIME_ID) - before);
    evaluations = std::min(evaluations, evaluation.total.statistics.cpu_seconds);
  }
  std::printf("%.9g %.9g %.9g\n", wall, cpu, evaluations);
  return 0;
}

/// Answers every task at once with the same evaluation.
void echo(MpiTransport* transport, const Evaluation& evaluation) {
  transport->send(0, write_hello({kMessageFormat, version(), "echo"}));
  for (;;) {
    const std::optional<Envelope> envelope = transport->receive();
    if (!envelope) {
      std::this_thread::yield();
      continue;
    }
    ByteReader reader(envelope->bytes);
    const auto kind = reader.get<MessageKind>();
    const auto number = reader.get<std::uint64_t>();
    if (kind == MessageKind::kTask) transport->send(0, write_result(number, evaluation));
    if (kind != MessageKind::kEnd) continue;
    transport->send(0, write_numbered(MessageKind::kGoodbye));
    return;
  }
}

/// Sends tasks of one problem; returns how many were answered.
class MessageBench {
 public:
  MessageBench(Dispatcher* dispatcher, const Problem& problem)
      : dispatcher_(*dispatcher),
        task_{system_of(problem), problem.parameters(), Derivatives::kGradient},
        problem_(dispatcher->add(make_portable(problem))) {}

  void run(std::size_t count) {
    const std::vector<EvaluationTask> tasks(count, task_);
    RankBatch batch{tasks, std::vector<std::uint32_t>(count, 0), problem_, nullptr};
    std::size_t answered = 0;
    dispatcher_.run(&batch, [&answered](std::size_t, const Evaluation&) { ++answered; });
    if (answered != count)
      throw std::runtime_error("not every task was answered: " + batch.ended.cause);
  }

 private:
  Dispatcher& dispatcher_;
  const EvaluationTask task_;
  const std::uint32_t problem_;
};

void measure_messages(MpiTransport* transport, const Problem& problem,
                      const Evaluation& evaluation) {
  constexpr int kTasks = 50000, kAlone = 2000;
  Dispatcher dispatcher(transport);
  MessageBench bench(&dispatcher, problem);
  bench.run(1000);
  const double before = seconds_of(CLOCK_PROCESS_CPUTIME_ID),
               caller_before = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  bench.run(kTasks);
  const double caller = seconds_of(CLOCK_THREAD_CPUTIME_ID) - caller_before,
               all = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - before;
  std::vector<double> alone;
  for (int k = 0; k < kAlone; ++k) {
    const RankClock::time_point begin = RankClock::now();
    bench.run(1);
    alone.push_back(seconds_since(begin));
  }
  std::nth_element(alone.begin(), alone.begin() + kAlone / 2, alone.end());
  if (!dispatcher.finish()) throw std::runtime_error("a rank did not end");
  std::printf("%.9g %.9g %.9g %zu %zu %zu\n", (all - caller) / kTasks, caller / kTasks,
              alone[kAlone / 2],
              write_task(1, 1, 0, Derivatives::kGradient, problem.parameters()).size(),
              write_result(1, evaluation).size(), write_problem(1, make_portable(problem)).size());
}

int run_messages() {
  MpiTransport transport;
  const Problem problem = with_uncertain_masses(load_slider_crank(), kSamples, "{type: mpi}");
  const Evaluation evaluation = Evaluator(problem).evaluate(problem.start(), true);
  if (transport.rank() == 0)
    measure_messages(&transport, problem, evaluation);
  else
    echo(&transport, evaluation);
  if (!transport.flush(std::chrono::seconds(2))) transport.abort(1);
  transport.finish();
  return 0;
}

}  // namespace

int run_rank_program(const std::string& what) {
  if (what == "gradient") return run_on_ranks("benchmarks", measure_gradient);
  if (what == "messages") return run_messages();
  return 2;
}

}  // namespace codesign
