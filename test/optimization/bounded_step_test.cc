// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/bounded_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

struct StepProblem {
  Eigen::VectorXd gradient, scale, lower, upper;
  Eigen::MatrixXd root;
  BoundedStep step() const { return {gradient, root, scale, lower, upper}; }
};

/// A random problem with correlated columns; the bounds lie around zero, some of them at zero.
StepProblem random_problem(int size, unsigned seed) {
  std::srand(seed);
  StepProblem p;
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(3 * size, size) +
                            Eigen::VectorXd::Random(3 * size) * Eigen::RowVectorXd::Ones(size);
  p.root = triangular_root(A);
  p.gradient = 10.0 * Eigen::VectorXd::Random(size);
  p.scale = p.root.colwise().norm().transpose();
  p.lower = -0.5 * (Eigen::VectorXd::Random(size).array() + 0.6).max(0.0);
  p.upper = 0.5 * (Eigen::VectorXd::Random(size).array() + 0.6).max(0.0);
  return p;
}

/// The gradient of the problem of damped() at p.
Eigen::VectorXd slope(const StepProblem& problem, double mu, const Eigen::VectorXd& p) {
  return problem.gradient + 2.0 * (problem.root.transpose() * (problem.root * p)) +
         2.0 * mu * problem.scale.cwiseAbs2().cwiseProduct(p);
}

TEST(BoundedStep, MeetsTheConditionsOfAnOptimum) {
  int held = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
    for (const double mu : {1e-8, 1e-2, 1.0}) {
      const StepProblem problem = random_problem(7, seed);
      const Eigen::VectorXd p = problem.step().damped(mu), by_p = slope(problem, mu, p);
      const double small = 1e-9 * problem.gradient.norm();
      for (Eigen::Index k = 0; k < p.size(); ++k) {
        EXPECT_GE(p[k], problem.lower[k]);
        EXPECT_LE(p[k], problem.upper[k]);
        const bool at_lower = p[k] == problem.lower[k], at_upper = p[k] == problem.upper[k];
        EXPECT_TRUE(at_lower || by_p[k] <= small) << seed << " " << k << " " << by_p[k];
        EXPECT_TRUE(at_upper || by_p[k] >= -small) << seed << " " << k << " " << by_p[k];
        held += at_lower || at_upper;
      }
    }
  EXPECT_GT(held, 100) << "bounds take part";
}

TEST(BoundedStep, WithoutBoundsItIsTheSolutionOfTheNormalEquations) {
  StepProblem problem = random_problem(5, 3);
  problem.lower.setConstant(-kNoBound);
  problem.upper.setConstant(kNoBound);
  const BoundedStep step = problem.step();
  const Eigen::VectorXd p = step.within(kNoBound);
  const Eigen::MatrixXd H = 2.0 * problem.root.transpose() * problem.root;
  EXPECT_LE((H * p + problem.gradient).norm(), 1e-10 * problem.gradient.norm());
  EXPECT_NEAR(step.predicted_decrease(p), -0.5 * problem.gradient.dot(p),
              1e-10 * step.predicted_decrease(p));
  EXPECT_NEAR(step.slope(p), problem.gradient.dot(p), 1e-12 * std::abs(step.slope(p)));
}

TEST(BoundedStep, IsNotLongerThanTheRadius) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const StepProblem problem = random_problem(6, seed);
    const BoundedStep step = problem.step();
    const double free = step.length(step.within(kNoBound));
    double before = 0.0;
    for (const double fraction : {1e-6, 1e-3, 0.3, 0.8}) {
      const Eigen::VectorXd p = step.within(fraction * free);
      EXPECT_LE(step.length(p), 1.1 * fraction * free);
      EXPECT_GE(step.length(p), 0.9 * fraction * free);
      EXPECT_GT(step.predicted_decrease(p), before) << "a longer step predicted_decreases more";
      before = step.predicted_decrease(p);
    }
    EXPECT_EQ(step.within(2.0 * free), step.within(kNoBound));
  }
}

TEST(BoundedStep, IsFiniteWhereTheRootIsSingular) {
  StepProblem problem = random_problem(4, 2);
  problem.root.row(3).setZero();
  problem.root.col(2) = problem.root.col(1);
  problem.gradient = problem.root.transpose() * Eigen::Vector4d(1.0, -2.0, 0.5, 0.0);
  problem.lower.setConstant(-kNoBound);
  problem.upper.setConstant(kNoBound);
  const Eigen::VectorXd p = problem.step().within(kNoBound);
  ASSERT_TRUE(p.allFinite());
  EXPECT_LE(slope(problem, 0.0, p).norm(), 1e-6 * problem.gradient.norm());
}

TEST(BoundedStep, WithEverythingHeldThereIsNone) {
  StepProblem problem = random_problem(3, 5);
  problem.lower.setZero();
  problem.upper.setZero();
  EXPECT_EQ(problem.step().within(1.0), Eigen::VectorXd::Zero(3));
}

TEST(BoundedStep, HasNoComponentAlongDirectionsWithoutInfluence) {
  StepProblem problem = random_problem(6, 5);
  // The third column is the sum of the first two within rounding, and the gradient belongs to
  // residuals with that Jacobian.
  problem.root.col(2) =
      problem.root.col(0) + problem.root.col(1) + 1e-13 * Eigen::VectorXd::Random(6);
  const Eigen::VectorXd residuals = 1e3 * Eigen::VectorXd::Random(6);
  problem.gradient = 2.0 * problem.root.transpose() * residuals;
  problem.scale.setOnes();
  problem.lower.setConstant(-kNoBound);
  problem.upper.setConstant(kNoBound);
  const Eigen::VectorXd shortest = -LeastNorm(problem.root, 1e-9).solve(residuals);
  const Eigen::VectorXd p = problem.step().within(kNoBound);
  EXPECT_LE((p - shortest).norm(), 1e-8 * shortest.norm());
  EXPECT_NEAR(p.dot(Eigen::VectorXd::Unit(6, 0) + Eigen::VectorXd::Unit(6, 1) -
                    Eigen::VectorXd::Unit(6, 2)),
              0.0, 1e-8 * p.norm());

  // A bound limits one component: the other columns replace its effect.
  problem.lower[0] = problem.upper[0] = 0.0;
  const Eigen::VectorXd held = problem.step().within(kNoBound);
  EXPECT_EQ(held[0], 0.0);
  EXPECT_LT((problem.root * held + residuals).norm(), residuals.norm());
}

}  // namespace
}  // namespace codesign
