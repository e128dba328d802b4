// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/smooth_program.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "math/dense.h"
#include "optimization/cart.h"

namespace codesign {
namespace {

const std::string kRunsOfBlock = "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}}}\n";
const std::string kPath =
    "path: [{signal: slide/velocity, between: [-1.5, 1.5]}, {signal: hold/output, at_most: "
    "\"${Kp}\"}]\n";

OptimizationResult tune_with(const std::string& blocks, const std::string& algorithm = "slsqp") {
  return optimize(block(
      blocks, "{algorithm: " + algorithm + ", relative_tolerance: 1.0e-9, max_evaluations: 400}"));
}

/// Each derivative of a row against central differences of the row.
template <class Row>
void expect_derivatives(const Ensemble& ensemble, SmoothProgram* program,
                        const Eigen::VectorXd& rho, const Eigen::VectorXd& slack, const Row& row) {
  const auto at = [&](const Eigen::VectorXd& design, const Eigen::VectorXd& y) {
    const EnsembleEvaluation all = ensemble.evaluate(design, true);
    program->take(all, design);
    return row(y);
  };
  const SmoothProgram::Value value = at(rho, slack);
  for (Eigen::Index k = 0; k < rho.size(); ++k) {
    const double h = 1e-4 * rho[k];
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(rho.size(), k);
    const double difference =
        (at(rho + step, slack).value - at(rho - step, slack).value) / (2.0 * h);
    EXPECT_NEAR(value.by_rho[k], difference, 1e-5 * (std::abs(difference) + 1e-3))
        << "parameter " << k;
  }
  for (Eigen::Index k = 0; k < slack.size(); ++k) {
    const Eigen::VectorXd step = 1e-3 * Eigen::VectorXd::Unit(slack.size(), k);
    EXPECT_NEAR(value.by_slack[k],
                (at(rho, slack + step).value - at(rho, slack - step).value) / 2e-3, 1e-9)
        << "slack " << k;
  }
}

TEST(SmoothProgram, DerivativesOfObjectiveAndRowsAreRight) {
  const Problem problem = block(kRunsOfBlock + kPath +
                                "robust: {measure: worst}\nsolver: {relative_tolerance: 1.0e-10, "
                                "absolute_tolerance: 1.0e-11}\n");
  const Ensemble ensemble(problem);
  SmoothProgram program(ensemble);
  const EnsembleEvaluation all = ensemble.evaluate(problem.start(), true);
  const Eigen::VectorXd slack = program.start(all, 2.0);
  ASSERT_EQ(slack.size(), 1);
  expect_derivatives(ensemble, &program, problem.start(), slack,
                     [&](const auto& y) { return program.objective(y); });
  for (int row : {0, 1, 2 + 7, 2 + 60, program.inequalities() - 3})
    expect_derivatives(ensemble, &program, problem.start(), slack,
                       [&](const auto& y) { return program.inequality(row, y); });
}

TEST(SmoothProgram, BoundsAreKeptInEveryRun) {
  const OptimizationResult free = tune_with(kRunsOfBlock),
                           bounded = tune_with(kRunsOfBlock +
                                               "path: [{signal: hold/output, between: [-6, 6]}]\n");
  ASSERT_TRUE(free.status.ok()) << free.status.cause;
  ASSERT_TRUE(bounded.status.ok()) << bounded.status.cause;
  ASSERT_EQ(bounded.constraints.watched.size(), 1U);
  EXPECT_LE(bounded.constraints.watched[0].violation, 1e-8);
  EXPECT_GT(bounded.best.objective, free.best.objective);
  EXPECT_NEAR(
      std::max(bounded.constraints.watched[0].largest, -bounded.constraints.watched[0].smallest),
      6.0, 1e-6)
      << "the bound is active";
  EXPECT_EQ(bounded.constraints.watched[0].lower, -6.0);
  EXPECT_EQ(bounded.constraints.watched[0].upper, 6.0);
  EXPECT_EQ(bounded.constraints.watched[0].before, 0.8);
  EXPECT_EQ(free.constraints.watched.size(), 0U);
}

TEST(SmoothProgram, TellsInWhichRunASignalWasExtreme) {
  // The set-point of the second run is farther away, so the controller pushes harder there.
  const OptimizationResult result =
      tune_with(kRunsOfBlock + "path: [{signal: hold/output, between: [\"${-Kp}\", 600]}]\n");
  ASSERT_EQ(result.constraints.watched.size(), 1U);
  EXPECT_EQ(result.constraints.watched[0].largest_scenario, 1);
  EXPECT_DOUBLE_EQ(result.constraints.watched[0].lower, -result.best.rho[0]);
}

TEST(SmoothProgram, AlgorithmsAgreeOnABoundedDesign) {
  const std::string bound = "path: [{signal: hold/output, between: [-6, 6]}]\n";
  const OptimizationResult slsqp = tune_with(bound), mma = tune_with(bound, "mma");
  ASSERT_TRUE(slsqp.status.ok() && mma.status.ok()) << slsqp.status.cause << mma.status.cause;
  EXPECT_NEAR(mma.best.objective, slsqp.best.objective, 1e-4 * slsqp.best.objective);
}

TEST(SmoothProgram, AnImpossibleBoundIsInfeasible) {
  const OptimizationResult result = tune_with("final: [{signal: slide/position, at_least: 4.0}]\n");
  EXPECT_EQ(result.status.code, StatusCode::kInfeasible);
  EXPECT_NE(result.status.cause.find("final[0] (slide/position)"), std::string::npos)
      << result.status.cause;
  EXPECT_GT(result.constraints.watched.at(0).violation, 1.0);
}

TEST(SmoothProgram, DependentConstraintsAreNoSuccess) {
  const std::string one = "{signal: slide/velocity, between: [0.0, 0.0]}";
  const OptimizationResult once = tune_with("final: [" + one + "]\n"),
                           twice = tune_with("final: [" + one + ", " + one + "]\n");
  ASSERT_TRUE(once.status.ok()) << once.status.cause;
  if (twice.status.ok()) {
    EXPECT_NEAR(twice.best.objective, once.best.objective, 1e-4 * once.best.objective);
  }
}

TEST(SmoothProgram, APeakInConstraintsIsABoundOnBothSides) {
  const std::string path = "path: [{signal: hold/output, reference: 1.0, between: [-6, 6]}]\n";
  const std::string peak = "constraints: [{peak: hold/output, reference: 1.0, at_most: 6}]\n";
  const OptimizationResult a = tune_with(kRunsOfBlock + path), b = tune_with(kRunsOfBlock + peak);
  ASSERT_TRUE(a.status.ok() && b.status.ok()) << a.status.cause << b.status.cause;
  EXPECT_EQ(a.best.objective, b.best.objective) << "bit for bit";
  EXPECT_EQ(a.best.rho, b.best.rho);
  EXPECT_EQ(b.constraints.watched.at(0).element, "constraints[0]");
  EXPECT_LE(b.constraints.watched.at(0).violation, 1e-8);
  EXPECT_THROW(tune_with(peak, "lbfgs"), InputError);
}

TEST(SmoothProgram, AConstraintOnParametersHoldsInEveryRun) {
  // Kd <= 2 sqrt(Kp mass): the lightest run binds, though the study's own mass does not.
  const std::string runs = "runs: {light: {set: {mass: 0.3}}, heavy: {set: {mass: 4.0}}}\n";
  const OptimizationResult result = tune_with(runs + "constraints: [\"Kd**2 <= 0.5*Kp*mass\"]\n");
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double Kp = result.best.rho[0], Kd = result.best.rho[1];
  EXPECT_GE(0.5 * Kp * 0.3 - Kd * Kd, -1e-7);
  EXPECT_NEAR(result.constraints.margins[0], 0.5 * Kp * 0.3 - Kd * Kd, 1e-12);
  EXPECT_NEAR(result.constraints.margins[0], 0.0, 1e-5) << "it is active";
}

TEST(SmoothProgram, OtherAlgorithmsAreRefused) {
  const std::string bound = "path: [{signal: hold/output, between: [-6, 6]}]\n";
  EXPECT_THROW(tune_with(bound, "lbfgs"), InputError);
  EXPECT_THROW(tune_with("final: [{signal: slide/position, between: [0.5, 0.5]}]\n", "mma"),
               InputError);
}

TEST(SmoothProgram, MovesTheCartByTheBangBangPeak) {
  // A cart of 1 kg, 1 m from rest to rest in 1 s. Piecewise linear forces with 40 coefficients
  // reverse within one span h = 1/39, so that the peak is 4 / (1 - h^2 / 3) m/s^2 for a symmetric
  // reversal, instead of 4.
  const SourceText study{"cart.yaml", R"(
duration: 1.0
controllers: {push: {type: basis, shape: linear, output: slide, coefficients: {count: 40, initial: 0.0, lower: -20.0, upper: 20.0}}}
objective: {peak: [{signal: slide/acceleration}]}
final: [{signal: slide/position, between: [1.0, 1.0]}, {signal: slide/velocity, between: [0.0, 0.0]}]
solver: {relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}
optimizer: {algorithm: slsqp, relative_tolerance: 1.0e-10}
)"};
  const OptimizationResult result = optimize(load_problem(cart_urdf(), {}, study));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LT(result.best.objective, 4.001);
  EXPECT_GT(result.best.objective, 4.0);
  for (const WatchedResult& watched : result.constraints.watched)
    EXPECT_LE(watched.violation, 1e-8);
}

// r int u^2 + a (x - 1/2)^2 + b v^2 at the end of 1 s is least for a force c0 + c1 t, which
// piecewise linear forces contain; then it is quadratic in c0 and c1.
TEST(SmoothProgram, ShapeCoefficientsReachTheLinearForceOfAQuadraticObjective) {
  const double r = 1e-2, a = 1000.0, b = 100.0;
  const Eigen::Vector2d x(1.0 / 2.0, 1.0 / 6.0), v(1.0, 1.0 / 2.0);
  Eigen::Matrix2d hessian = a * x * x.transpose() + b * v * v.transpose();
  hessian += r * (Eigen::Matrix2d() << 1.0, 1.0 / 2.0, 1.0 / 2.0, 1.0 / 3.0).finished();
  const Eigen::Vector2d c = solve_positive_definite(hessian, a * 0.5 * x);
  const double optimum = a * 0.25 - a * 0.5 * x.dot(c);
  for (const char* algorithm : {"auto", "lbfgs", "slsqp"}) {
    const SourceText study{"cart.yaml", R"(
duration: 1.0
controllers: {push: {type: basis, shape: linear, output: slide, coefficients: {count: 60, initial: 0.0, lower: -50.0, upper: 50.0}}}
objective:
  integral: [{signal: push/output, weight: 1.0e-2}]
  terminal: [{signal: slide/position, reference: 0.5, weight: 1000}, {signal: slide/velocity, weight: 100}]
optimizer: {max_evaluations: 400, algorithm: )" +
                                            std::string(algorithm) + "}\n"};
    const OptimizationResult result = optimize(load_problem(cart_urdf(), {}, study));
    ASSERT_TRUE(result.status.ok()) << algorithm << ": " << result.status.cause;
    EXPECT_NE(result.termination, "stopped_early") << algorithm;
    EXPECT_NEAR(result.best.objective, optimum, 1e-4 * optimum)
        << algorithm << ": " << result.cost.evaluations << " evaluations";
  }
}

// A speed that has to end at zero tells nothing of its range at the end: the default tolerance
// counts the speed of the whole run.
TEST(SmoothProgram, SwingsUpToRestWithinTheDefaultTolerance) {
  const SourceText urdf{"swing.urdf", R"(<robot name="swing"><link name="base"/>
  <link name="bar"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/>
    <dynamics damping="0.02" friction="0"/></joint></robot>)"};
  const SourceText study{"swing.yaml", R"(
duration: 1.5
controllers: {motor: {type: basis, shape: cubic, output: hinge, coefficients: {count: 8, initial: 0.0, lower: -20.0, upper: 20.0}}}
objective: {integral: [{signal: hinge/effort}]}
final: [{signal: hinge/position, between: [3.141592653589793, 3.141592653589793]}, {signal: hinge/velocity, between: [0.0, 0.0]}]
optimizer: {max_evaluations: 200}
)"};
  const OptimizationResult result = optimize(load_problem(urdf, {}, study));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.constraints.watched.size(), 2U);
  EXPECT_NEAR(result.constraints.watched[0].tolerance, 3.14e-5, 1e-6);
  EXPECT_NEAR(result.constraints.watched[1].tolerance, 6.1e-5, 1e-5) << "of 6.1 rad/s on the way";
  for (const WatchedResult& watched : result.constraints.watched)
    EXPECT_LE(watched.violation, watched.tolerance);
}

}  // namespace
}  // namespace codesign
