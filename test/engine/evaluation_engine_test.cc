// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation_engine.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/serial_engine.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

std::vector<EvaluationTask> tasks(const Problem& problem, int count) {
  std::vector<EvaluationTask> result;
  for (int k = 0; k < count; ++k) result.push_back({problem.system(), problem.parameters(Eigen::Vector2d(10.0 + k, 3.0)), k % 3 != 0});
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

TEST(Engine, SeveralCallersShareTheWorkers) {
  const Problem problem = block("");
  const std::vector<EvaluationTask> all = tasks(problem, 6);
  SerialEngine serial;
  const std::vector<Evaluation> expected = serial.evaluate(all, nullptr);
  ThreadEngine engine(2);
  std::vector<std::vector<Evaluation>> results(4);
  std::vector<std::thread> callers;
  for (auto& result : results) callers.emplace_back([&] { result = engine.evaluate(all, nullptr); });
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

}  // namespace
}  // namespace codesign
