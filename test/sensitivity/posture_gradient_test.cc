// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/posture_gradient.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "math/differences.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/postures.h"

namespace codesign {
namespace {

/// A crank that turns fully, its angles an expression of a parameter; the objective and the watched
/// signals as given.
Problem path_generator(const std::string& lines) {
  return postures(
      "four_bar_path",
      "positions: {crank_joint: {from: \"${begin}\", to: \"${begin + 5.5}\", count: 7}}\n"
      "initial_state: {coupler_joint: {guess: 0.5}, crank_joint: {velocity: \"${1 + begin}\"}}\n"
      "parameters: {r1: {}, r2: {}, r3: {}, r4: {}, pen_x: {}, pen_y: {}, pivot_x: {}, "
      "frame_angle: "
      "{}, begin: {initial: 0.8, lower: 0, upper: 2}}\n" +
          lines);
}

const char* const kSums =
    "objective:\n  sum: [{signal: pen/position/x, reference: [0.5, 0.4, 0.3, 0.2, 0.1, 0, "
    "\"${r2}\"], weight: 2}, {signal: pen/velocity/y}]\n"
    "  terminal: [{signal: coupler_joint/position, reference: 1.0}]\n";

TEST(PostureGradient, MeetsDifferences) {
  for (const std::string& lines :
       {std::string(kSums),
        std::string("objective: {peak: [{signal: pen/position/y, after: 1, before: 4}], stroke: "
                    "[{signal: coupler_joint/velocity}], minimum: [{signal: pen/position/x, "
                    "weight: -1}]}\n"),
        std::string("objective: {sum: [{signal: crank_joint/acceleration, weight: 1.0e-2}, "
                    "{signal: rocker/reaction_force/x, weight: 1.0e-3}]}\n")}) {
    const Problem problem = path_generator(lines);
    const GradientCheck check = check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_EQ(check.method, CheckMethod::kRidders);
    EXPECT_GT(check.reference.cwiseAbs().maxCoeff(), 0.0);
    // The derivative by frame_angle may be zero, and what rounding leaves of the difference counts.
    EXPECT_LT(check.largest_relative_difference, 1e-7) << lines;
  }
}

// The crank is held: what its drive takes, and the reactions, are those of statics, and with a
// velocity those of a motion without acceleration.
TEST(PostureGradient, OfHeldPosturesMeetsDifferences) {
  for (const char* const begin :
       {"\nhold: true\n", "\nhold: [crank_joint]\ngravity: [0, 3, 0]\n"}) {
    const Problem problem =
        path_generator(std::string("objective: {sum: [{signal: crank_joint/effort}, {signal: "
                                   "rocker/reaction_force/x, weight: 1.0e-2}]}\n") +
                       begin);
    const GradientCheck check = check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    const double largest = check.reference.cwiseAbs().maxCoeff();
    EXPECT_GT(largest, 0.0);
    EXPECT_LT((check.evaluation.gradient - check.reference).cwiseAbs().maxCoeff(), 1e-9 * largest)
        << begin;
  }
}

TEST(PostureGradient, OfWatchedSignalsMeetsDifferences) {
  const Problem problem = path_generator(
      "path: [{signal: pen/position/y, at_most: 9}, {signal: pen/velocity/x, at_most: 9, after: "
      "2, before: 3}]\nfinal: [{signal: coupler_joint/position, at_most: 9}]\n"
      "constraints: [{stroke: pen/position/x, at_most: 9}]\n");
  Evaluator evaluator(problem);
  const Eigen::VectorXd start = problem.start();
  const Extremes extremes = evaluator.evaluate(start, true).extremes;
  ASSERT_EQ(extremes.values.size(), 7 + 2 + 1 + 7 + 1);
  EXPECT_EQ(extremes.times[8], 3.0);
  for (Eigen::Index place = 0; place < extremes.values.size(); ++place)
    for (Eigen::Index k = 0; k < start.size(); ++k) {
      const auto value = [&](double step) {
        return evaluator.evaluate(start + step * Eigen::VectorXd::Unit(start.size(), k), false)
            .extremes.values[place];
      };
      EXPECT_NEAR(extremes.gradients(k, place), ridders_derivative(value, 0.0, 1e-2).value, 1e-8)
          << place << ' ' << k;
    }
}

// J^T J from the derivatives of the single residuals, which are watched here as signals.
TEST(PostureGradient, TheRootIsThatOfTheResiduals) {
  const Problem problem = path_generator(
      std::string(kSums) +
      "path: [{signal: pen/position/x, reference: [0.5, 0.4, 0.3, 0.2, 0.1, 0, \"${r2}\"], "
      "at_most: 9}, {signal: pen/velocity/y, at_most: 99}]\n"
      "final: [{signal: coupler_joint/position, reference: 1.0, at_most: 9}]\n");
  const Evaluation at = Evaluator(problem).evaluate(problem.start(), Derivatives::kGaussNewton);
  ASSERT_TRUE(at.status.ok()) << at.status.cause;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(15);
  weights.head(7).setConstant(2.0);
  const Eigen::MatrixXd& by = at.extremes.gradients;
  const Eigen::MatrixXd expected = by * weights.asDiagonal() * by.transpose();
  EXPECT_LT((at.jacobian_root.transpose() * at.jacobian_root - expected).norm(),
            1e-12 * expected.norm());
  const Eigen::VectorXd gradient = 2.0 * by * weights.asDiagonal() * at.extremes.values;
  EXPECT_LT((at.gradient - gradient).norm(), 1e-12 * gradient.norm());
  EXPECT_NEAR(at.objective, weights.dot(at.extremes.values.cwiseAbs2()), 1e-12 * at.objective);
}

TEST(PostureGradient, AFailureIsThatOfTheSequence) {
  const Problem problem = path_generator(kSums);
  Eigen::VectorXd rho = problem.start();
  rho[1] = 4.0;
  const Evaluation at = Evaluator(problem).evaluate(rho, true);
  EXPECT_EQ(at.status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(at.status.cause.find("posture "), std::string::npos) << at.status.cause;
}

}  // namespace
}  // namespace codesign
