// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/multistart.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

OptimizationResult search(const std::string& engine) {
  return optimize(block(
      "multistart: {starts: 4, screen: 12, seed: 3, cluster: 1.0e-3}\nengine: {" + engine + "}\n",
      "{algorithm: lbfgs, relative_tolerance: 1.0e-9}"));
}

TEST(Multistart, SearchesFromTheBestPointsAndListsTheOptima) {
  const OptimizationResult result = search("type: serial");
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.multistart.screened, 12);
  ASSERT_EQ(result.multistart.starts.size(), 4u);
  for (std::size_t k = 1; k < 4; ++k)
    EXPECT_LE(result.multistart.starts[k - 1].start_objective,
              result.multistart.starts[k].start_objective);
  ASSERT_FALSE(result.multistart.optima.empty());
  EXPECT_EQ(result.best.objective, result.multistart.optima[0].objective);
  EXPECT_EQ(result.best.rho, result.multistart.optima[0].rho);
  int found = 0, evaluations = result.multistart.screened;
  for (const Optimum& optimum : result.multistart.optima) found += optimum.found;
  for (const StartResult& start : result.multistart.starts) {
    EXPECT_LE(start.objective, start.start_objective);
    evaluations += start.evaluations;
  }
  EXPECT_EQ(found, 4);
  EXPECT_EQ(result.cost.evaluations, evaluations);
  EXPECT_EQ(result.initial.rho, Eigen::Vector2d(20.0, 5.0))
      << "compared with the study's own start";
}

TEST(Multistart, AnyNumberOfWorkersGivesTheSameBits) {
  const OptimizationResult one = search("type: serial"), two = search("workers: 2"),
                           five = search("workers: 5");
  for (const OptimizationResult* other : {&two, &five}) {
    EXPECT_EQ(one.best.rho, other->best.rho);
    EXPECT_EQ(one.best.objective, other->best.objective);
    EXPECT_EQ(one.cost.evaluations, other->cost.evaluations);
    ASSERT_EQ(one.multistart.starts.size(), other->multistart.starts.size());
    for (std::size_t k = 0; k < one.multistart.starts.size(); ++k) {
      EXPECT_EQ(one.multistart.starts[k].rho, other->multistart.starts[k].rho);
      EXPECT_EQ(one.multistart.starts[k].optimum, other->multistart.starts[k].optimum);
    }
  }
}

// A part has 1024 points, or 16 per worker: here two parts, and one.
TEST(Multistart, PartsOfTheScreeningMakeNoDifference) {
  const auto screen = [](const std::string& engine) {
    const std::string ensemble =
        "multistart: {starts: 3, screen: 1200, seed: 3, sampler: latin_hypercube}\nengine: {" +
        engine + "}\n";
    return optimize(block(ensemble, "{algorithm: lbfgs, max_evaluations: 1}"));
  };
  const OptimizationResult two = screen("type: serial"), one = screen("workers: 80");
  EXPECT_EQ(two.multistart.screened, 1200);
  ASSERT_EQ(two.multistart.starts.size(), 3u);
  ASSERT_EQ(one.multistart.starts.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(one.multistart.starts[k].start, two.multistart.starts[k].start);
  EXPECT_EQ(one.best.objective, two.best.objective);
}

TEST(Multistart, TheObserverSeesOneSequenceAndCanEndIt) {
  const Problem problem =
      block("multistart: {starts: 3, screen: 6}\nengine: {workers: 3}\n", "{algorithm: lbfgs}");
  int expected = 0;
  double best = std::numeric_limits<double>::infinity();
  const OptimizationResult result = optimize(problem, [&](const Trial& trial) {
    EXPECT_EQ(trial.evaluation, ++expected);
    EXPECT_GE(trial.start, 1);
    EXPECT_LE(trial.start, 3);
    EXPECT_LE(trial.best_objective, best);
    best = trial.best_objective;
    return expected < 5;
  });
  EXPECT_EQ(expected, 5);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_LE(result.best.objective, best)
      << "the trials of other searches that were under way count, too";
}

TEST(Multistart, SearchesThatDidNotBeginHaveFoundNothing) {
  const Problem problem =
      block("multistart: {starts: 5, screen: 6}\nengine: {type: serial}\n", "{algorithm: lbfgs}");
  const OptimizationResult result = optimize(problem, [](const Trial&) { return false; });
  ASSERT_EQ(result.multistart.starts.size(), 5u);
  EXPECT_EQ(result.multistart.starts[4].termination, "not_started");
  EXPECT_EQ(result.multistart.starts[4].status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.multistart.starts[4].optimum, -1);
  EXPECT_TRUE(result.multistart.optima.empty());
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
}

TEST(Multistart, NearResultsAreOneOptimum) {
  const std::vector<std::vector<double>> scaled = {
      {0.1, 0.1}, {0.9, 0.1}, {0.1005, 0.1}, {0.5, 0.5}};
  std::vector<StartResult> starts(4);
  for (std::size_t k = 0; k < 4; ++k) {
    starts[k].rho = Eigen::Map<const Eigen::Vector2d>(scaled[k].data());
    starts[k].objective = std::vector<double>{2.0, 1.0, 1.9, 0.5}[k];
  }
  starts[3].status.code = StatusCode::kInfeasible;
  const std::vector<Optimum> optima = cluster_optima(scaled, 1e-3, &starts);
  ASSERT_EQ(optima.size(), 2u);
  EXPECT_EQ(optima[0].objective, 1.0);
  EXPECT_EQ(optima[1].objective, 1.9) << "the best of a cluster stands for it";
  EXPECT_EQ(optima[1].found, 2);
  EXPECT_EQ(starts[0].optimum, 1);
  EXPECT_EQ(starts[1].optimum, 0);
  EXPECT_EQ(starts[2].optimum, 1);
  EXPECT_EQ(starts[3].optimum, -1) << "a search that failed has found none";
  EXPECT_EQ(cluster_optima(scaled, 1e-4, &starts).size(), 3u);
}

}  // namespace
}  // namespace codesign
