// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excitation_program.h"

#include <gtest/gtest.h>

#include <numeric>

#include "description/study.h"
#include "equations/equations.h"
#include "excitation/excited_cases.h"
#include "math/differences.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

TEST(LimitEnvelope, LiesAboveTheLargestMagnitude) {
  const Eigen::Vector4d z(0.3, -0.95, 0.9, 0.94);
  for (const double sharpness : {20.0, 600.0}) {
    const double envelope = limit_envelope(z, sharpness, nullptr);
    EXPECT_GT(envelope, -0.05);
    EXPECT_LT(envelope, -0.05 + std::log(8.0) / sharpness);
  }
}

TEST(LimitEnvelope, Derivatives) {
  const Eigen::Vector4d z(0.3, -0.95, 0.9, 0.94);
  Eigen::VectorXd by_z;
  limit_envelope(z, 30.0, &by_z);
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const auto moved = [&](double change) {
      return limit_envelope(z + change * Eigen::Vector4d::Unit(k), 30.0, nullptr);
    };
    EXPECT_NEAR(by_z[k], ridders_derivative(moved, 0.0, 0.005).value, 1e-8);
  }
}

/// Compares all derivatives of a program at a point.
void expect_gradient(const Problem& problem, double tolerance) {
  const MotionLimits limits = motion_limits(problem);
  const FitVariables variables(study_of(problem));
  std::vector<std::string> names;
  for (const MeasuredJoint& joint : limits.joints) names.push_back(joint.name);
  const Information information(variables, names, limits.noise);
  const TrajectorySpace space(*study_of(problem).excitation, limits,
                              Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size())));
  ExcitedMotion motion(*system_of(problem), limits.joints, limits.followers, problem.parameters(),
                       1);
  std::vector<int> columns(static_cast<std::size_t>(variables.size()));
  std::iota(columns.begin(), columns.end(), 0);
  ExcitationProgram program(space, limits, information, columns, &motion);
  program.set_sharpness(20.0);
  const Eigen::VectorXd x = space.shrunk(
      space.mixed(Eigen::VectorXd::LinSpaced(space.size(), 0.1, 0.9).unaryExpr([](double u) {
        return std::fmod(5.3 * u, 1.0);
      })),
      0.5);
  ASSERT_TRUE(motion.begin(space.rest(x)).ok());
  const ExcitationProgram::Value value = program.evaluate(x, true);
  ASSERT_TRUE(value.status.ok()) << value.status.cause;
  for (Eigen::Index k = 0; k < x.size(); k += 2) {
    const auto criterion = [&](double change) {
      return program.evaluate(x + change * Eigen::VectorXd::Unit(x.size(), k), false).criterion;
    };
    EXPECT_NEAR(value.gradient[k], ridders_derivative(criterion, 0.0, 2e-3).value,
                tolerance * value.gradient.cwiseAbs().maxCoeff())
        << k;
    for (Eigen::Index row = 0; row < program.rows(); ++row) {
      const auto limit = [&](double change) {
        return program.evaluate(x + change * Eigen::VectorXd::Unit(x.size(), k), false).limits[row];
      };
      EXPECT_NEAR(value.limits_x(row, k), ridders_derivative(limit, 0.0, 2e-3).value,
                  tolerance * value.limits_x.cwiseAbs().maxCoeff())
          << limits.signals[static_cast<std::size_t>(row)].name;
    }
  }
}

TEST(ExcitationProgram, GradientOfAnArmWithSensors) {
  expect_gradient(arm("harmonics: 3", "joints: {elbow: {effort_scale: {}, delay: {}, offset: {}}}",
                      "fore_inertia, fore_mass, fore_viscous"),
                  1e-6);
}

TEST(ExcitationProgram, GradientOfAClosedLoop) {
  expect_gradient(slider_crank("  trajectory: spline\n  knots: 8\n"), 1e-6);
}

TEST(ExcitationProgram, AMotionThatTellsNothingIsAFailure) {
  const Problem problem = excited_pendulum("", "parameters: {mass: {}, inertia: {}}", "0 0 1");
  const MotionLimits limits = motion_limits(problem);
  const FitVariables variables(study_of(problem));
  const Information information(variables, {"hinge"}, limits.noise);
  const TrajectorySpace space(*study_of(problem).excitation, limits, Eigen::VectorXd::Zero(1));
  ExcitedMotion motion(*system_of(problem), limits.joints, {}, problem.parameters(), 1);
  ExcitationProgram program(space, limits, information, {0, 1}, &motion);
  ASSERT_TRUE(motion.begin(space.rest(space.plain())).ok());
  EXPECT_EQ(program.evaluate(space.plain(), true).status.code, StatusCode::kNotIdentifiable);
}

}  // namespace
}  // namespace codesign
