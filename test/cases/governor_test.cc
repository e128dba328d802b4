// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// References: an independent solution of the same data at tolerances down to 1e-12 (psi converged
// to 4e-11 relative).
#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/search_hooks.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

TEST(Governor, CountsAreThePapers) {
  expect_counts(Shipped("governor"), {42, 84, 2, 40, 124, 7, 868, 992});
}

TEST(Governor, ObjectiveAndGradientMeetTheReference) {
  expect_reference(
      Shipped("governor"), 18.99293371, 1e-7,
      {90.464824, -483.002357, 81.199348, 638.318351, -75.829680, 542.933449, 733.520034}, 1e-5);
}

// The hinges of the reference turn in the opposite direction, and their speeds are surface speeds
// at the pin radius of 3 mm.
TEST(Governor, SeriesMeetTheReference) {
  expect_series(
      Shipped("governor"),
      {{"pillar/angular_velocity/z",
        {11.522196761571987, 11.3790063242535, 11.380174854172902, 11.380244659242331},
        3.837959},
       {"collar/position/z",
        {0.10000680772202986, 0.10000027870066212, 0.09999999152730622, 0.09999999996096749},
        0.0006656},
       {"collar_joint/velocity",
        {0.0002398881051808091, -8.62689651091516e-06, -1.3418409777427592e-08,
         5.462323039552973e-09},
        0.011055},
       {"throttle/output",
        {-0.0013615444059700277, -5.574013242359843e-05, 1.6945387565359127e-06,
         7.806502666518611e-09},
        0.133119},
       {"right_hinge/normal_force",
        {1.120861468211782, 0.9073012776099204, 0.8999712637214885, 0.9000972170875692},
        13.945825},
       {"left_hinge/normal_force",
        {1.1208614682117743, 0.9073012776099056, 0.8999712637214828, 0.9000972170875744},
        13.945825},
       {"right_hinge/friction",
        {2.310018437418956e-05, -6.7258052983689705e-07, -1.0376941457948758e-09,
         4.2248025221395935e-10},
        0.00734883},
       {"left_hinge/velocity",
        {-0.0016622368726479111, 5.9782097635821362e-05, 9.2986313676669482e-08,
         -3.7852567239510781e-08},
        0.0767228}});
}

TEST(Governor, TunesIntoItsFlatValley) {
  Shipped shipped("governor");
  // Looser tolerances than shipped, to save time: the valley is flat.
  shipped.study.solver.relative_tolerance = 1e-6;
  shipped.study.solver.absolute_tolerance = 1e-7;
  shipped.study.solver.sensitivity_tolerance = 0.0;
  // The search goes on from its first stop, which is not stationary.
  shipped.study.optimizer.max_evaluations = 40;
  const OptimizationResult result =
      optimize(make_system(shipped.robot, shipped.study), shipped.study.optimizer);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LE(result.best.objective, 0.6198);
  EXPECT_LE(result.cost.evaluations, 40);
}

// Workers of a search take designs in any order, yet its results have the same bits for any number
// of them.
TEST(Governor, AnEvaluationDoesNotDependOnThoseBefore) {
  Shipped shipped("governor");
  shipped.study.duration = 0.02;
  shipped.study.solver.relative_tolerance = 1e-5;
  shipped.study.solver.absolute_tolerance = 1e-6;
  shipped.study.solver.sensitivity_tolerance = 0.0;
  Eigen::VectorXd other = shipped.start();
  other << 0.15, 0.06, 0.2757, 0.0284, 0.0208, 0.2039, 0.04;
  for (const IntegratorKind integrator : {IntegratorKind::kRosenbrock, IntegratorKind::kIdas}) {
    shipped.study.solver.integrator = integrator;
    Evaluator used = evaluator_of(make_system(shipped.robot, shipped.study)),
              fresh = evaluator_of(make_system(shipped.robot, shipped.study));
    used.evaluate(other, true);
    const Evaluation again = used.evaluate(shipped.start(), true),
                     first = fresh.evaluate(shipped.start(), true);
    ASSERT_TRUE(again.status.ok()) << again.status.cause;
    EXPECT_EQ(again.objective, first.objective);
    EXPECT_EQ(again.gradient, first.gradient);
  }
}

TEST(Governor, DesignsThatCannotBeAssembledHaveAStatus) {
  Shipped shipped("governor");
  shipped.study.duration = 0.001;
  Evaluator evaluator = evaluator_of(make_system(shipped.robot, shipped.study));
  // The shortest arms on the tallest pillar do not reach the collar.
  Eigen::VectorXd rho = shipped.start();
  rho << 0.1, 0.06, 0.4, 0.02, 0.02, 0.25, 0.03;
  const Evaluation impossible = evaluator.evaluate(rho, true);
  EXPECT_EQ(impossible.status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(impossible.status.cause.find("collar_pin"), std::string::npos)
      << impossible.status.cause;
  EXPECT_TRUE(evaluator.evaluate(shipped.start(), true).status.ok());
}

}  // namespace
}  // namespace codesign
