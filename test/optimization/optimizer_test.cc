// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/optimization.h"

#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "description/study.h"
#include "optimization/search_hooks.h"
#include "paths.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

struct Case {
  RobotDescription robot;
  Study study;
};

/// A shipped study at tolerances loose enough for a short test and tight enough for the digits that
/// are compared.
Case shipped(const std::string& name) {
  const std::string root = source_dir();
  Case c;
  c.robot = read_urdf(read_source(root + "/urdf/" + name + ".urdf"));
  c.study = read_study(read_source(root + "/config/" + name + ".yaml"), c.robot);
  c.study.solver.relative_tolerance = 1e-5;
  c.study.solver.absolute_tolerance = 1e-6;
  return c;
}

TEST(Optimizer, TunesTheSliderCrank) {
  const Case c = shipped("slider_crank");
  const OptimizationResult result = optimize(make_system(c.robot, c.study), c.study.optimizer);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LE(result.best.objective, 8.80e-4);
  EXPECT_EQ(result.optimality.influences, std::vector<bool>(c.study.tuned.size(), true));
  EXPECT_NEAR(result.initial.objective, 0.0592527, 1e-5);
}

TEST(Optimizer, KeepsToTheParameterConstraint) {
  const Case c = shipped("slider_crank_haug");
  const OptimizationResult result = optimize(make_system(c.robot, c.study), c.study.optimizer);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LE(result.best.objective, 0.02122);
  EXPECT_GE(result.best.rho[1] - result.best.rho[0], 0.165 - 1e-7);
}

TEST(Optimizer, RefusesConstraintsWhereTheyAreNotTaken) {
  Case c = shipped("slider_crank_haug");
  c.study.optimizer.algorithm = "lbfgs";
  EXPECT_THROW(optimize(make_system(c.robot, c.study), c.study.optimizer), InputError);
}

TEST(Optimizer, CancelKeepsTheBestPoint) {
  const Case c = shipped("slider_crank");
  const OptimizationResult result =
      optimize(make_system(c.robot, c.study), c.study.optimizer,
               [](const Trial& trial) { return trial.evaluation < 2; });
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.cost.evaluations, 2);
  EXPECT_LE(result.best.objective, result.initial.objective);
  EXPECT_EQ(result.best.gradient.size(), 5);
}

TEST(Optimizer, SurvivesPointsThatCannotBeAssembled) {
  // A rod this short cannot turn round with most cranks; the constraint that keeps it away is
  // dropped.
  Case c = shipped("slider_crank_haug");
  c.study.constraints.clear();
  c.study.optimizer.algorithm = "lbfgs";
  c.study.optimizer.max_evaluations = 6;
  for (Parameter& parameter : c.study.parameters) {
    if (parameter.name == "rod_length") {
      parameter.value = 0.26;
      parameter.lower = 0.05;
    }
  }
  // The objective rewards a short rod, so that the search enters the region where the mechanism
  // cannot be assembled.
  c.study.integral.front().signal = parse_signal("slider_joint/position", {}, "signal");
  c.study.integral.front().reference = Quantity(0.0);
  c.study.integral.resize(1);
  c.study.duration = 0.02;
  const OptimizationResult result = optimize(make_system(c.robot, c.study), c.study.optimizer);
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_GT(result.cost.failed_evaluations, 0);
  EXPECT_LT(result.best.objective, result.initial.objective);
}

}  // namespace
}  // namespace codesign
