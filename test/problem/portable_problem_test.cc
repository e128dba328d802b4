// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/portable_problem.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {
namespace {

void expect_same_gradient(const Problem& a, const Problem& b) {
  const Evaluation of_a = Evaluator(a).evaluate(a.start(), true), of_b = Evaluator(b).evaluate(b.start(), true);
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
  Study study = block("").study();
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
  study.text.replace(study.text.find("setpoint: 0.5"), 13, "setpoint: {type: trajectory, bag: recorded.bag, topic: /path, joint: slide}");
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
    return SourceText{"far/" + address.file,
                      R"({"names": ["mu"], "covariance": [[1e-4]], "identified": {"mu": {"value": 0.3, "determined": true}}})"};
  };
  const Problem plain = block("");
  const SourceText study{"block.yaml", plain.study_text().text + "uncertain: {from: i.json}\n"};
  const Problem problem = load_problem(plain.urdf(), {}, study, {}, {}, files);
  const Problem copy = load_portable(make_portable(problem));
  EXPECT_EQ(reads, 1) << "the file is read once, by the process that has it";
  ASSERT_EQ(copy.study().ensemble.uncertain.size(), 1U);
  EXPECT_EQ(copy.study().ensemble.uncertain[0].distribution.deviation, 0.01);
  EXPECT_EQ(load_portable(make_portable(copy)).study().ensemble.uncertain.size(), 1U) << "a copy of a copy";
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
