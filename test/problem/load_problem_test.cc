// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/simulation.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

Problem slider_crank(const ParameterSettings& settings = {}) {
  const std::string source = source_dir();
  return load_problem(read_source(source + "/urdf/slider_crank_haug.urdf"), {},
                      read_source(source + "/config/slider_crank_haug.yaml"), settings);
}

TEST(Problem, CopiesShareWhatTheyHold) {
  const Problem problem = slider_crank(), copy = problem;
  EXPECT_EQ(system_of(copy), system_of(problem));
  EXPECT_EQ(&study_of(copy), &study_of(problem));
  EXPECT_EQ(&copy.urdf(), &problem.urdf());
}

TEST(Problem, SaysWhatItsStudySays) {
  const Problem problem = slider_crank();
  EXPECT_EQ(problem.duration(), study_of(problem).duration);
  EXPECT_EQ(problem.all_parameters().size(), problem.parameters().size());
  EXPECT_EQ(problem.tuned_names().size(), static_cast<std::size_t>(problem.start().size()));
  EXPECT_EQ(problem.parameters(problem.start()), problem.parameters());
  EXPECT_EQ(problem.optimizer_options().algorithm, study_of(problem).optimizer.algorithm);
}

TEST(Problem, SettingsMakeAnotherProblem) {
  const Problem problem = slider_crank();
  const std::string name = problem.tuned_names().front();
  const double moved = problem.start()[0] * 1.01;
  const Problem changed = with_settings(problem, {{name, moved}});
  EXPECT_EQ(changed.start()[0], moved);
  EXPECT_NE(problem.start()[0], moved);
  EXPECT_NE(system_of(changed), system_of(problem));
  EXPECT_EQ(changed.start(), slider_crank({{name, moved}}).start());
}

TEST(Problem, AnotherStudyOfTheSameModelIsCompiledAnew) {
  const Problem problem = slider_crank();
  Study study = study_of(problem);
  study.duration = 0.25;
  study.tuned.resize(1);
  const Problem changed = with_study(problem, study);
  EXPECT_EQ(changed.duration(), 0.25);
  EXPECT_EQ(changed.start().size(), 1);
  EXPECT_EQ(changed.urdf().text, problem.urdf().text);
}

TEST(Problem, SignalsOfASimulationAreSpelledAsInStudies) {
  const Problem problem = slider_crank();
  Simulation simulation(problem, problem.parameters(),
                        {"slider_joint/position", "crank_joint/velocity"});
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
  EXPECT_LE(result.cost.evaluations, 2);
  EXPECT_EQ(result.initial.rho, problem.start());
  EXPECT_NE(problem.optimizer_options().max_evaluations, 2);
}

void expect_same_gradient(const Problem& a, const Problem& b) {
  const Evaluation of_a = Evaluator(a).evaluate(a.start(), true),
                   of_b = Evaluator(b).evaluate(b.start(), true);
  ASSERT_TRUE(of_a.status.ok()) << of_a.status.cause;
  EXPECT_EQ(of_a.objective, of_b.objective);
  EXPECT_EQ(of_a.gradient, of_b.gradient);
}

TEST(PortableProblem, IsTheSameProblemElsewhere) {
  const Problem problem = block("runs: {near: {}, far: {controllers: {hold: {setpoint: 0.9}}}}\n");
  const Problem copy = load_portable(make_portable(problem));
  EXPECT_EQ(distinct_systems(copy).size(), 2U);
  EXPECT_EQ(copy.tuned_names(), problem.tuned_names());
  expect_same_gradient(problem, copy);
}

TEST(PortableProblem, CarriesValuesAndTheChoiceOfParameters) {
  Study study = study_of(block(""));
  study.tuned = {3, 0};
  const Problem problem = with_study(block(""), study, {{"mass", 3.3}, {"Kd", 7.0}});
  ASSERT_EQ(problem.tuned_names(), (std::vector<std::string>{"Kd", "mu"}));
  const Problem copy = load_portable(make_portable(problem));
  EXPECT_EQ(copy.tuned_names(), problem.tuned_names());
  EXPECT_EQ(copy.parameters(), problem.parameters());
  expect_same_gradient(problem, copy);
  EXPECT_EQ(make_portable(copy).values, make_portable(problem).values) << "a copy of a copy";
}

TEST(PortableProblem, CarriesTrajectories) {
  SourceText study = block("").study_text();
  study.text.replace(study.text.find("setpoint: 0.5"), 13,
                     "setpoint: {type: trajectory, bag: recorded.bag, topic: /path, joint: slide}");
  int reads = 0;
  const TrajectoryLoader loader = [&reads](const TrajectoryAddress& address) {
    ++reads;
    EXPECT_EQ(address.bag, "recorded.bag");
    return RecordedTrajectory{{0.0, 0.5, 1.0}, {0.0, 0.3, 0.5}, {}, {}};
  };
  const Problem problem = load_problem(block("").urdf(), {}, study, {}, loader);
  const Problem copy = load_portable(make_portable(problem));
  EXPECT_EQ(reads, 1) << "the bag is read once, by the process that has it";
  expect_same_gradient(problem, copy);
  PortableProblem without = make_portable(problem);
  without.trajectories.clear();
  EXPECT_THROW(load_portable(without), InputError);
}

TEST(PortableProblem, CarriesTheFilesThatTheStudyNames) {
  int reads = 0;
  const FileLoader files = [&reads](const FileAddress& address) {
    ++reads;
    return SourceText{
        "far/" + address.file,
        R"({"names": ["mu"], "covariance": [[1e-4]], "identified": {"mu": {"value": 0.3, "determined": true}}})"};
  };
  const Problem plain = block("");
  const SourceText study{"block.yaml", plain.study_text().text + "uncertain: {from: i.json}\n"};
  const Problem problem = load_problem(plain.urdf(), {}, study, {}, {}, files);
  const Problem copy = load_portable(make_portable(problem));
  EXPECT_EQ(reads, 1) << "the file is read once, by the process that has it";
  ASSERT_EQ(study_of(copy).ensemble.uncertain.size(), 1U);
  EXPECT_EQ(study_of(copy).ensemble.uncertain[0].distribution.deviation, 0.01);
  EXPECT_EQ(study_of(load_portable(make_portable(copy))).ensemble.uncertain.size(), 1U)
      << "a copy of a copy";
  EXPECT_EQ(make_portable(with_settings(problem, {{"mass", 2.5}})).files.size(), 1U);
  PortableProblem without = make_portable(problem);
  without.files.clear();
  EXPECT_THROW(load_portable(without), InputError);
}

TEST(PortableProblem, RefusesOtherParameters) {
  PortableProblem portable = make_portable(block(""));
  portable.values.pop_back();
  EXPECT_THROW(load_portable(portable), InputError);
  portable = make_portable(block(""));
  portable.tuned.push_back("Ki");
  EXPECT_THROW(load_portable(portable), InputError);
}

}  // namespace

}  // namespace codesign
