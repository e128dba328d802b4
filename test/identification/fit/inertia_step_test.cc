// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/inertia_step.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

InertiaBlock relative_block(int first, double weight) {
  InertiaBlock block;
  for (int k = 0; k < 10; ++k) block.columns[static_cast<std::size_t>(k)] = first + k;
  block.matrix.setIdentity();
  block.weight = weight;
  return block;
}

// The nearest possible matrix has the negative eigenvalues replaced by zero.
TEST(InertiaStep, ReachesTheBorder) {
  SymmetricNumbers target;
  target << 1.0, -0.5, 0.8, 2.0, 0.3, 0.9, -0.4, 0.2, 1.1, 0.6;
  const SymmetricEigen eigen = symmetric_eigen(symmetric_matrix(target));
  ASSERT_LT(eigen.values[0], -0.1);
  const Eigen::Matrix4d nearest =
      eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
  const SymmetricNumbers from = symmetric_numbers(Eigen::Matrix4d::Identity());
  for (const double weight : {1e-2, 1e-5, 1e-8}) {
    const std::vector<InertiaBlock> blocks{relative_block(0, weight)};
    const Eigen::VectorXd gradient = 2.0 * (from - target),
                          none = Eigen::VectorXd::Constant(10, kUnbounded);
    const Eigen::MatrixXd root = Eigen::MatrixXd::Identity(10, 10);
    const InertiaStep step(gradient, root, blocks, -none, none);
    EXPECT_LT((step.matrix(0) - nearest).norm(), 4.0 * weight + 2.0 * std::sqrt(weight)) << weight;
    const double least = (nearest - symmetric_matrix(target)).squaredNorm(),
                 found = (step.matrix(0) - symmetric_matrix(target)).squaredNorm();
    EXPECT_GE(found, least * (1.0 - 1e-12));
    EXPECT_LE(found, least + weight * (4.0 + nearest.trace())) << "the bound of duality";
    EXPECT_GT(symmetric_eigen(step.matrix(0)).values[0], 0.0);
  }
}

/// Two inertias and six bounded variables, of which fewer rows than unknowns are known.
struct MixedStep {
  MixedStep() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    root = Eigen::MatrixXd::NullaryExpr(22, 26, [&] { return normal(random); });
    root.leftCols(6) *= 100.0;
    gradient = 2.0 * root.transpose() *
               Eigen::VectorXd::NullaryExpr(22, [&] { return 10.0 * normal(random); });
    lower = Eigen::VectorXd::Constant(26, -kUnbounded);
    upper = Eigen::VectorXd::Constant(26, kUnbounded);
    lower.head(6).setConstant(-0.02);
    upper.head(6).setConstant(0.01);
    upper[1] = 0.0;
  }
  Eigen::MatrixXd root;
  Eigen::VectorXd gradient, lower, upper;
  std::vector<InertiaBlock> blocks{relative_block(6, 0.05), relative_block(16, 0.05)};
};

TEST(InertiaStep, MeetsTheConditionsOfOptimality) {
  const MixedStep problem;
  const InertiaStep step(problem.gradient, problem.root, problem.blocks, problem.lower,
                         problem.upper);
  const Eigen::VectorXd& p = step.step();
  Eigen::VectorXd slope = problem.gradient + 2.0 * problem.root.transpose() * (problem.root * p);
  const double scale = problem.gradient.norm();
  for (int l = 0; l < 2; ++l) {
    const Eigen::Matrix4d E = step.matrix(static_cast<std::size_t>(l));
    EXPECT_LT(
        (E - Eigen::Matrix4d::Identity() - symmetric_matrix(p.segment<10>(6 + 10 * l))).norm(),
        1e-12);
    slope.segment<10>(6 + 10 * l) +=
        0.05 * symmetric_numbers(Eigen::Matrix4d::Identity() - E.inverse());
  }
  EXPECT_LT(slope.tail(20).norm(), 1e-6 * scale);
  int on_bound = 0;
  for (int k = 0; k < 6; ++k) {
    EXPECT_GE(p[k], problem.lower[k]);
    EXPECT_LE(p[k], problem.upper[k]);
    const bool is_low = p[k] == problem.lower[k], is_high = p[k] == problem.upper[k];
    on_bound += is_low || is_high ? 1 : 0;
    if (is_low) {
      EXPECT_GT(slope[k], 0.0) << k;
    } else if (is_high) {
      EXPECT_LT(slope[k], 0.0) << k;
    } else {
      EXPECT_LT(std::abs(slope[k]), 1e-6 * scale) << k;
    }
  }
  EXPECT_GT(on_bound, 0);
  EXPECT_GT(step.decrease(), 0.0);
}

TEST(InertiaStep, PredictsItsDecrease) {
  const MixedStep problem;
  const InertiaStep step(problem.gradient, problem.root, problem.blocks, problem.lower,
                         problem.upper);
  const Eigen::VectorXd& p = step.step();
  double expected = -(problem.gradient.dot(p) + (problem.root * p).squaredNorm());
  for (std::size_t l = 0; l < 2; ++l)
    expected -= 0.05 * (step.matrix(l).trace() - 4.0 - std::log(step.matrix(l).determinant()));
  EXPECT_NEAR(step.decrease(), expected, 1e-6 * expected);
}

}  // namespace
}  // namespace codesign
