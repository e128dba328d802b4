// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/continuation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "integration/integrator.h"

namespace codesign {
namespace {

/// Two links, hinged on the ground 1.2 apart; the right one can become longer; a loop joins their
/// tips. Each parameter is heard of once.
std::shared_ptr<const CompiledSystem> growing_triangle(const std::string& solver) {
  const std::string urdf =
      "<robot name='t' xmlns:codesign='urn:t'><codesign:parameter name='length' value='1' "
      "lower='0.1' upper='9'/>"
      "<codesign:parameter name='mass' value='1' lower='-1' upper='9'/><link name='ground'/>" +
      bar("left") +
      "<link name='right'><inertial><origin xyz='0 0 -0.5' codesign:xyz='0 0 ${-length/2}'/><mass "
      "value='1' codesign:value='${mass}'/>"
      "<inertia ixx='0.0834' ixy='0' ixz='0' iyy='0.0834' iyz='0' izz='0.001'/></inertial></link>" +
      bar("coupler") + hinge("left_hinge", "ground", "left", "0 0 0") +
      hinge("right_hinge", "ground", "right", "1.2 0 0") +
      hinge("elbow", "left", "coupler", "0 0 -1") +
      "<loop name='tip' type='continuous'><predecessor link='coupler'><origin xyz='0 0 "
      "-1'/></predecessor>"
      "<successor link='right'><origin xyz='0 0 -1' codesign:xyz='0 0 "
      "${-length}'/></successor><axis xyz='0 1 0'/></loop></robot>";
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(
      robot,
      read_study(
          {"test.yaml",
           "duration: 1.0\ninitial_state: {left_hinge: {position: 0.3, velocity: 2.0}, "
           "elbow: {guess: -1.5}, right_hinge: {guess: 0.1}}\nparameters: {length: {tune: true}, "
           "mass: {tune: false}}\nobjective: {integral: [{signal: elbow/position}]}\nsolver: " +
               solver + "\n"},
          robot));
}

class Continued : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    system_ = growing_triangle(std::string("{integrator: ") + GetParam() +
                               ", relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}");
    integrator_ = make_integrator(*system_);
    ASSERT_TRUE(integrator_->start({1.0, 1.0}).ok());
    while (integrator_->state().t < 0.2) ASSERT_TRUE(integrator_->advance(0.2).ok());
  }
  TreeCoordinates coordinates(const State<double>& state) {
    TreeCoordinates found;
    EXPECT_EQ(tree_coordinates(*system_, integrator_->assembly().tree(), state,
                               integrator_->assembly().theta(), &integrator_->equations(), &found),
              "");
    return found;
  }
  double gap() {
    Eigen::VectorXd errors, rates;
    integrator_->equations().constraint_errors(integrator_->state(), &errors, &rates);
    return std::max(errors.cwiseAbs().maxCoeff(), rates.cwiseAbs().maxCoeff());
  }

  std::shared_ptr<const CompiledSystem> system_;
  std::unique_ptr<Integrator> integrator_;
};

TEST_P(Continued, AMassChangesAccelerationsButNoPositionAndNoVelocity) {
  const State<double> before = integrator_->state();
  ASSERT_TRUE(integrator_->go_on(before.t, {1.0, 3.0}).ok());
  EXPECT_EQ(integrator_->state().q, before.q);
  EXPECT_EQ(integrator_->state().v, before.v);
  EXPECT_GT((integrator_->state().z - before.z).cwiseAbs().maxCoeff(), 1e-3);
  while (integrator_->state().t < 0.4) ASSERT_TRUE(integrator_->advance(0.4).ok());
  EXPECT_LT(integrator_->statistics().energy_error, 1e-5) << "the mass that appeared is no error";
}

TEST_P(Continued, ALengthKeepsTheIndependentCoordinateAndClosesTheLoop) {
  const TreeCoordinates before = coordinates(integrator_->state());
  ASSERT_TRUE(integrator_->go_on(integrator_->state().t, {1.3, 1.0}).ok());
  const TreeCoordinates behind = coordinates(integrator_->state());
  EXPECT_NEAR(behind.theta[0], before.theta[0], 1e-12);
  EXPECT_NEAR(behind.rate[0], before.rate[0], 1e-12);
  EXPECT_GT((behind.theta - before.theta).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT(gap(), 1e-11);
  while (integrator_->state().t < 0.4) ASSERT_TRUE(integrator_->advance(0.4).ok());
  EXPECT_LT(integrator_->statistics().energy_error, 1e-5);
}

TEST_P(Continued, ALengthThatClosesNoLoopIsRefusedAndTheRunGoesOnAsBefore) {
  const State<double> before = integrator_->state();
  const Status status = integrator_->go_on(before.t, {8.0, 1.0});
  EXPECT_EQ(status.code, StatusCode::kAssemblyFailed) << status.cause;
  EXPECT_NEAR(status.time, 0.2, 1e-12);
  EXPECT_EQ(integrator_->go_on(before.t, {1.0, -0.5}).code, StatusCode::kInvalidDesign);
  EXPECT_EQ(integrator_->equations().parameters(), (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(integrator_->state().q, before.q);
  auto untouched = make_integrator(*system_);
  ASSERT_TRUE(untouched->start({1.0, 1.0}).ok());
  for (Integrator* each : {integrator_.get(), untouched.get()})
    while (each->state().t < 0.5) ASSERT_TRUE(each->advance(0.5).ok());
  EXPECT_LT((integrator_->state().q - untouched->state().q).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_P(Continued, AnInstantWithinTheLastStepDiscardsWhatIsBehindIt) {
  const double t = integrator_->state().t;
  ASSERT_TRUE(integrator_->advance(1.0).ok());
  State<double> between;
  double psi = 0.0;
  const double time = 0.5 * (t + integrator_->state().t);
  integrator_->interpolate(time, &between, &psi);
  ASSERT_TRUE(integrator_->go_on(time, {1.0, 1.0}).ok());
  EXPECT_EQ(integrator_->state().t, time);
  EXPECT_LT((integrator_->state().q - between.q).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(integrator_->psi(), psi, 1e-12);
  EXPECT_LT(gap(), 1e-12);
  State<double> again;
  integrator_->interpolate(time, &again, &psi);
  EXPECT_EQ(again.q, integrator_->state().q);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Continued, testing::Values("rosenbrock", "idas"));

}  // namespace
}  // namespace codesign
