// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "engine/evaluation_engine.h"
#include "engine/rank_fixture.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"
#include "ensemble/scenario.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::vector<EvaluationTask> tasks(const Problem& problem, int count) {
  std::vector<EvaluationTask> result;
  for (int k = 0; k < count; ++k)
    result.push_back({system_of(problem), problem.parameters(Eigen::Vector2d(10.0 + k, 3.0)),
                      gradient_if(k % 3 != 0)});
  return result;
}

void expect_same_bits(const std::vector<Evaluation>& a, const std::vector<Evaluation>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(a[k].status.ok());
    EXPECT_EQ(a[k].objective, b[k].objective);
    EXPECT_EQ(a[k].gradient, b[k].gradient);
    EXPECT_EQ(a[k].statistics.steps, b[k].statistics.steps);
  }
}

TEST(Engine, AnyNumberOfWorkersGivesTheSameBits) {
  const Problem problem = block("");
  const std::vector<EvaluationTask> all = tasks(problem, 11);
  SerialEngine serial;
  const std::vector<Evaluation> expected = serial.evaluate(all, nullptr);
  EXPECT_NE(expected[1].objective, expected[2].objective);
  EXPECT_EQ(expected[0].gradient.size(), 0) << "no gradient was asked for";
  for (int workers : {1, 2, 5}) {
    ThreadEngine threads(workers);
    EXPECT_EQ(threads.workers(), workers);
    expect_same_bits(threads.evaluate(all, nullptr), expected);
    expect_same_bits(threads.evaluate(all, nullptr), expected);
  }
}

/// The shipped slider-crank, whose loops and frictions make the last bits depend on pivots, for a
/// short time.
Problem slider_crank(const std::string& solver) {
  SourceText study = read_source(source_dir() + "/config/slider_crank.yaml");
  study.text.replace(study.text.find("duration: 2.0"), 13, "duration: 0.05");
  const std::string own = "integrator: rosenbrock, method: rodas5p";
  study.text.replace(study.text.find(own), own.size(), solver);
  study.text.erase(study.text.find(", sensitivity_tolerance: 1.0e-5"), 31);
  return load_problem(read_source(source_dir() + "/urdf/slider_crank.urdf"), {}, study);
}

TEST(Engine, AResultDoesNotDependOnWhatItsWorkerDidBefore) {
  for (const char* solver : {"method: rodas5p", "gradient: adjoint", "integrator: idas"}) {
    const Problem problem = slider_crank(solver);
    std::vector<EvaluationTask> order;
    for (const double kp : {-4.0, 1.0, 3.0, 0.1}) {
      Eigen::VectorXd rho = problem.start();
      rho[0] += 0.003 * kp;
      rho[4] = kp;
      order.push_back({system_of(problem), problem.parameters(rho), gradient_if(kp > 0.5)});
    }
    SerialEngine forward, backward;
    const std::vector<Evaluation> expected = forward.evaluate(order, nullptr);
    for (std::size_t k = order.size(); k-- > 0;) {
      const Evaluation again = backward.evaluate({order[k]}, nullptr).front();
      EXPECT_EQ(again.status.code, expected[k].status.code) << solver;
      EXPECT_EQ(again.objective, expected[k].objective) << solver << ", task " << k;
      EXPECT_EQ(again.gradient, expected[k].gradient) << solver << ", task " << k;
      EXPECT_EQ(again.statistics.constraint_drift, expected[k].statistics.constraint_drift)
          << solver << ", task " << k;
    }
  }
}

TEST(Engine, WhatSwitchesDoesNotDependOnWhatItsWorkerDidBefore) {
  const Problem problem = block(kRunsAndLaws);
  std::vector<EvaluationTask> all;
  for (const Scenario& scenario : make_scenarios(problem))
    all.push_back({scenario.system, scenario.parameters(problem.start()), gradient_if(true)});
  SerialEngine one;
  for (int round = 0; round < 2; ++round) {
    if (round == 1) std::reverse(all.begin(), all.end());
    for (const EvaluationTask& task : all)
      expect_same_bits(one.evaluate({task}, nullptr), SerialEngine().evaluate({task}, nullptr));
  }
}

TEST(Engine, SeveralCallersShareTheWorkers) {
  const Problem problem = block("");
  const std::vector<EvaluationTask> all = tasks(problem, 6);
  SerialEngine serial;
  const std::vector<Evaluation> expected = serial.evaluate(all, nullptr);
  ThreadEngine engine(2);
  std::vector<std::vector<Evaluation>> results(4);
  std::vector<std::thread> callers;
  for (auto& result : results)
    callers.emplace_back([&] { result = engine.evaluate(all, nullptr); });
  for (std::thread& caller : callers) caller.join();
  for (const auto& result : results) expect_same_bits(result, expected);
}

TEST(Engine, CancelledTasksEndAsCancelled) {
  const Problem problem = block("");
  const std::atomic<bool> cancel{true};
  ThreadEngine engine(2);
  for (const Evaluation& evaluation : engine.evaluate(tasks(problem, 4), &cancel))
    EXPECT_EQ(evaluation.status.code, StatusCode::kCancelled);
  EXPECT_TRUE(engine.evaluate({}, nullptr).empty());
}

TEST(Engine, MakesNoMoreWorkersThanAreUseful) {
  EXPECT_EQ(make_engine({EngineKind::kThreads, 7}, 3)->workers(), 3);
  EXPECT_EQ(make_engine({EngineKind::kThreads, 2}, 3)->workers(), 2);
  EXPECT_EQ(make_engine({EngineKind::kThreads, 8}, 1)->workers(), 1);
  EXPECT_EQ(make_engine({EngineKind::kSerial, 0}, 9)->workers(), 1);
  EXPECT_GE(make_engine({EngineKind::kThreads, 0}, 99)->workers(), 1);
}

TEST(Engine, MpiNeedsAProgramThatHasIt) {
  const EngineOptions mpi{EngineKind::kMpi, 0, {"study.yaml", 9}};
  try {
    require_engine(mpi, nullptr);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("study.yaml:9: engine.type: the engine mpi is not in this program"),
              std::string::npos);
  }
  Dispatcher alone(nullptr);
  EXPECT_NO_THROW(require_engine(mpi, &alone));
  EXPECT_EQ(make_engine(block("engine: {type: mpi}"), 100, &alone)->workers(), 1);
}

TEST(Engine, SeveralProcessesTakeMpiOrNothingElse) {
  RankJob job(3);
  EXPECT_NO_THROW(require_engine({}, job.ranks())) << "a study that says nothing";
  EXPECT_NO_THROW(require_engine({EngineKind::kMpi, 0, {"study.yaml", 9}}, job.ranks()));
  for (const EngineKind kind : {EngineKind::kSerial, EngineKind::kThreads})
    EXPECT_THROW(require_engine({kind, 0, {"study.yaml", 9}}, job.ranks()), InputError);
  EXPECT_EQ(make_engine(block(""), 100, job.ranks())->workers(), 3);
  EXPECT_EQ(make_engine(block(""), 1, job.ranks())->workers(), 1) << "one evaluation at a time";
}

class MapMemory final : public EvaluationMemory {
 public:
  std::optional<Evaluation> find(const EvaluationTask& task) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto place = known_.find({task.parameters, task.derivatives});
    return place == known_.end() ? std::nullopt : std::optional<Evaluation>(place->second);
  }
  void keep(const EvaluationTask& task, const Evaluation& evaluation) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_TRUE(
        known_.emplace(std::make_pair(task.parameters, task.derivatives), evaluation).second)
        << "computed twice";
    if (known_.size() == cancel_at) cancel = true;
  }
  std::size_t size() const { return known_.size(); }

  std::size_t cancel_at = 0;
  std::atomic<bool> cancel{false};

 private:
  std::mutex mutex_;
  std::map<std::pair<std::vector<double>, Derivatives>, Evaluation> known_;
};

std::vector<EvaluationTask> designs(const Problem& problem, int first, int count) {
  std::vector<EvaluationTask> result;
  for (int k = first; k < first + count; ++k)
    result.push_back({system_of(problem), problem.parameters(Eigen::Vector2d(10.0 + k, 3.0)),
                      gradient_if(k % 2 == 0)});
  return result;
}

struct RunCounts {
  std::atomic<int> computed{0}, remembered{0};
};

EngineRecords records_with(const std::shared_ptr<MapMemory>& memory, RunCounts* counts) {
  return {memory,
          [counts](bool computed) { ++(computed ? counts->computed : counts->remembered); }};
}

TEST(RememberingEngine, ComputesOnlyWhatIsNotKnown) {
  const Problem problem = block("");
  const auto memory = std::make_shared<MapMemory>();
  RunCounts counts;
  const EngineRecords records = records_with(memory, &counts);
  const auto engine = with_records(std::make_unique<ThreadEngine>(2), records);
  EXPECT_EQ(engine->workers(), 2);
  engine->evaluate(designs(problem, 0, 4), nullptr);
  EXPECT_EQ(memory->size(), 4u);
  const std::vector<EvaluationTask> all = designs(problem, 2, 5);
  const std::vector<Evaluation> results = engine->evaluate(all, nullptr),
                                expected = SerialEngine().evaluate(all, nullptr);
  EXPECT_EQ(counts.computed, 7);
  EXPECT_EQ(counts.remembered, 2);
  ASSERT_EQ(results.size(), 5u);
  for (std::size_t k = 0; k < results.size(); ++k) {
    EXPECT_EQ(results[k].objective, expected[k].objective) << k;
    EXPECT_EQ(results[k].gradient, expected[k].gradient) << k;
  }
}

TEST(RememberingEngine, KeepsEachResultAtOnceAndNoneThatWasCancelled) {
  const Problem problem = block("");
  const auto memory = std::make_shared<MapMemory>();
  memory->cancel_at = 2;
  RunCounts counts;
  const EngineRecords records = records_with(memory, &counts);
  const auto engine = with_records(std::make_unique<SerialEngine>(), records);
  const std::vector<Evaluation> results = engine->evaluate(designs(problem, 0, 4), &memory->cancel);
  EXPECT_EQ(memory->size(), 2u);
  EXPECT_EQ(counts.computed, 2);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(results[k].status.code == StatusCode::kCancelled, k >= 2) << k;
}

TEST(RememberingEngine, ACancelledJobIsNotCarriedOnByItsMemory) {
  const Problem problem = block("");
  const auto memory = std::make_shared<MapMemory>();
  RunCounts counts;
  const auto engine = with_records(std::make_unique<SerialEngine>(), records_with(memory, &counts));
  engine->evaluate(designs(problem, 0, 1), nullptr);
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(engine->evaluate(designs(problem, 0, 1), &cancel)[0].status.code,
            StatusCode::kCancelled);
}

TEST(RememberingEngine, WithoutRecordsIsTheEngineItself) {
  auto serial = std::make_unique<SerialEngine>();
  const EvaluationEngine* const address = serial.get();
  EXPECT_EQ(with_records(std::move(serial), {}).get(), address);
}

}  // namespace

}  // namespace codesign
