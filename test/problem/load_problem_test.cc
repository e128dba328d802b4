// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/load_problem.h"

#include <gtest/gtest.h>

#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/simulation.h"
#include "paths.h"

namespace codesign {
namespace {

Problem slider_crank(const ParameterSettings& settings = {}) {
  const std::string source = source_dir();
  return load_problem(read_source(source + "/urdf/slider_crank_haug.urdf"), {}, read_source(source + "/config/slider_crank_haug.yaml"),
                      settings);
}

TEST(Problem, CopiesShareWhatTheyHold) {
  const Problem problem = slider_crank(), copy = problem;
  EXPECT_EQ(copy.system(), problem.system());
  EXPECT_EQ(&copy.study(), &problem.study());
  EXPECT_EQ(&copy.urdf(), &problem.urdf());
}

TEST(Problem, SaysWhatItsStudySays) {
  const Problem problem = slider_crank();
  EXPECT_EQ(problem.duration(), problem.study().duration);
  EXPECT_EQ(problem.all_parameters().size(), problem.parameters().size());
  EXPECT_EQ(problem.tuned_names().size(), static_cast<std::size_t>(problem.start().size()));
  EXPECT_EQ(problem.parameters(problem.start()), problem.parameters());
  EXPECT_EQ(problem.optimizer_options().algorithm, problem.study().optimizer.algorithm);
}

TEST(Problem, SettingsMakeAnotherProblem) {
  const Problem problem = slider_crank();
  const std::string name = problem.tuned_names().front();
  const double moved = problem.start()[0] * 1.01;
  const Problem changed = with_settings(problem, {{name, moved}});
  EXPECT_EQ(changed.start()[0], moved);
  EXPECT_NE(problem.start()[0], moved);
  EXPECT_NE(changed.system(), problem.system());
  EXPECT_EQ(changed.start(), slider_crank({{name, moved}}).start());
}

TEST(Problem, AnotherStudyOfTheSameModelIsCompiledAnew) {
  const Problem problem = slider_crank();
  Study study = problem.study();
  study.duration = 0.25;
  study.tuned.resize(1);
  const Problem changed = with_study(problem, study);
  EXPECT_EQ(changed.duration(), 0.25);
  EXPECT_EQ(changed.start().size(), 1);
  EXPECT_EQ(changed.urdf().text, problem.urdf().text);
}

TEST(Problem, SignalsOfASimulationAreSpelledAsInStudies) {
  const Problem problem = slider_crank();
  Simulation simulation(problem, problem.parameters(), {"slider_joint/position", "crank_joint/velocity"});
  ASSERT_TRUE(simulation.start().ok());
  Frame frame;
  simulation.sample(0.0, &frame);
  ASSERT_EQ(frame.signals.size(), 2U);
  EXPECT_EQ(simulation.names().signals.at(1), "crank_joint/velocity");
  EXPECT_THROW(Simulation(problem, problem.parameters(), {"crank_joint/speed"}), InputError);
}

TEST(Problem, OptionsOfASearchComeInPlaceOfTheStudys) {
  const Problem problem = slider_crank();
  OptimizerOptions options = problem.optimizer_options();
  options.max_evaluations = 2;
  const OptimizationResult result = optimize(problem, options);
  EXPECT_LE(result.evaluations, 2);
  EXPECT_EQ(result.initial_rho, problem.start());
  EXPECT_NE(problem.optimizer_options().max_evaluations, 2);
}

}  // namespace
}  // namespace codesign
