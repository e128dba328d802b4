// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_search.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "excitation/excited_cases.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

class TrajectorySearchOf : public testing::TestWithParam<std::string> {};

TEST_P(TrajectorySearchOf, LowersTheCriterionWithinTheLimits) {
  const Problem problem =
      excited_pendulum("harmonics: 4, max_evaluations: 120, search: " + GetParam(),
                       "parameters: {mass: {}, inertia: {}, viscous: {}}");
  const MotionLimits limits = motion_limits(problem);
  const FitVariables variables(study_of(problem));
  const Information information(variables, {"hinge"}, limits.noise);
  const TrajectorySpace space(*study_of(problem).excitation, limits, Eigen::VectorXd::Zero(1));
  ExcitedMotion motion(*system_of(problem), limits.joints, {}, problem.parameters(), 1);
  ExcitationProgram program(space, limits, information, {0, 1, 2}, &motion);
  Eigen::VectorXd x = space.shrunk(space.plain(), 0.5);
  ASSERT_TRUE(motion.begin(space.rest(x)).ok());
  int trials = 0;
  const auto count = [&](const ExcitationTrial& trial) {
    EXPECT_EQ(trial.start, 3);
    EXPECT_EQ(trial.evaluation, ++trials);
    return true;
  };
  const TrajectorySearchResult found =
      search_trajectory(*study_of(problem).excitation, x, 3, count, &program);
  EXPECT_EQ(found.evaluations, trials);
  EXPECT_LE(found.evaluations, 120);
  EXPECT_LT(found.criterion, found.initial_criterion - 3.0);
  EXPECT_LE(program.worst_of(found.x), 1.0);
  EXPECT_DOUBLE_EQ(program.evaluate(found.x, false).criterion, found.criterion);
}

INSTANTIATE_TEST_SUITE_P(Methods, TrajectorySearchOf, testing::Values("slsqp", "ccsaq", "mma"));

TEST(TrajectorySearch, EndsWhenToldWithTheBestPointSoFar) {
  const Problem problem =
      excited_pendulum("harmonics: 4", "parameters: {inertia: {}, viscous: {}}");
  const MotionLimits limits = motion_limits(problem);
  const FitVariables variables(study_of(problem));
  const Information information(variables, {"hinge"}, limits.noise);
  const TrajectorySpace space(*study_of(problem).excitation, limits, Eigen::VectorXd::Zero(1));
  ExcitedMotion motion(*system_of(problem), limits.joints, {}, problem.parameters(), 1);
  ExcitationProgram program(space, limits, information, {0, 1}, &motion);
  const Eigen::VectorXd x = space.shrunk(space.plain(), 0.5);
  ASSERT_TRUE(motion.begin(space.rest(x)).ok());
  const auto stop = [](const ExcitationTrial& trial) { return trial.evaluation < 6; };
  const TrajectorySearchResult found =
      search_trajectory(*study_of(problem).excitation, x, 1, stop, &program);
  EXPECT_EQ(found.evaluations, 6);
  EXPECT_EQ(found.termination, "cancelled");
  EXPECT_LE(found.criterion, found.initial_criterion);
  EXPECT_LE(program.worst_of(found.x), 1.0);
}

}  // namespace
}  // namespace codesign
