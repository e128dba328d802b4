// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation_engine.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/serial_engine.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"
#include "paths.h"

namespace codesign {
namespace {

std::vector<EvaluationTask> tasks(const Problem& problem, int count) {
  std::vector<EvaluationTask> result;
  for (int k = 0; k < count; ++k)
    result.push_back({problem.system(), problem.parameters(Eigen::Vector2d(10.0 + k, 3.0)), gradient_if(k % 3 != 0)});
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

/// The shipped slider-crank, whose loops and frictions make the last bits depend on pivots, for a short time.
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
      order.push_back({problem.system(), problem.parameters(rho), gradient_if(kp > 0.5)});
    }
    SerialEngine forward, backward;
    const std::vector<Evaluation> expected = forward.evaluate(order, nullptr);
    for (std::size_t k = order.size(); k-- > 0;) {
      const Evaluation again = backward.evaluate({order[k]}, nullptr).front();
      EXPECT_EQ(again.status.code, expected[k].status.code) << solver;
      EXPECT_EQ(again.objective, expected[k].objective) << solver << ", task " << k;
      EXPECT_EQ(again.gradient, expected[k].gradient) << solver << ", task " << k;
      EXPECT_EQ(again.statistics.constraint_drift, expected[k].statistics.constraint_drift) << solver << ", task " << k;
    }
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
