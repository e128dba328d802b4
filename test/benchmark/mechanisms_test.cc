// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/mechanisms.h"

#include <gtest/gtest.h>

#include "assembly/count_equations.h"
#include "description/study.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

Problem load(const GeneratedCase& generated) {
  return load_problem(generated.urdf, {}, generated.study);
}

Counts counts_of(const Problem& problem) {
  Status status;
  const Counts counts = count_equations(*system_of(problem), problem.parameters(), &status);
  EXPECT_TRUE(status.ok()) << status.cause;
  return counts;
}

TEST(Mechanisms, AnOpenChainHasAsManyDegreesOfFreedomAsLinks) {
  for (int links : {1, 2, 5}) {
    const Counts counts = counts_of(load(open_chain(links)));
    EXPECT_EQ(counts.bodies, links);
    EXPECT_EQ(counts.degrees_of_freedom, links);
    EXPECT_EQ(counts.redundant_constraints, 0);
  }
}

TEST(Mechanisms, ALadderMovesInOneWay) {
  for (int loops : {1, 2, 4}) {
    const Counts counts = counts_of(load(ladder(loops)));
    EXPECT_EQ(counts.bodies, 2 * loops + 1);
    EXPECT_EQ(counts.degrees_of_freedom, 1);
    EXPECT_EQ(counts.redundant_constraints, 0);
  }
}

TEST(Mechanisms, StackedFourBarsHaveThreeRedundantConstraintsEach) {
  for (bool with_friction : {false, true}) {
    const Problem problem = load(stacked_four_bars(3, with_friction));
    const Counts counts = counts_of(problem);
    EXPECT_EQ(counts.bodies, 9);
    EXPECT_EQ(counts.degrees_of_freedom, 3);
    EXPECT_EQ(counts.redundant_constraints, 9);
    EXPECT_EQ(problem.warnings().size(), with_friction ? 1U : 0U)
        << "undetermined_friction, of all cranks";
  }
}

TEST(Mechanisms, ABricardRingMovesThoughCountingSaysItDoesNot) {
  const Counts counts = counts_of(load(bricard_ring()));
  EXPECT_EQ(counts.bodies, 5);
  EXPECT_EQ(counts.degrees_of_freedom, 1);
  EXPECT_EQ(counts.redundant_constraints, 1);
}

TEST(Mechanisms, EveryParameterOfAChainMatters) {
  const Problem problem = load(parametric_chain(2, 8));
  EXPECT_EQ(problem.tuned_names(),
            (std::vector<std::string>{"length_0", "mass_0", "radius_0", "friction_0", "length_1",
                                      "mass_1", "radius_1", "friction_1"}));
  const GradientCheck check =
      check_gradient(system_of(problem), problem.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-9);
  EXPECT_GT(check.evaluation.gradient.cwiseAbs().minCoeff(), 1e-6);
}

TEST(Mechanisms, TheChainsAreTheSameAtTheStart) {
  const Problem plain = load(open_chain(3)), parametric = load(parametric_chain(3, 2));
  EXPECT_EQ(study_of(parametric).tuned.size(), 2U);
  EXPECT_NEAR(Evaluator(plain).evaluate({}, false).objective,
              Evaluator(parametric).evaluate(parametric.start(), false).objective, 1e-9);
}

}  // namespace
}  // namespace codesign
