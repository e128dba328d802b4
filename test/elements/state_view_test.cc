// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "elements/state_view.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "integration/mechanisms.h"

namespace codesign {
namespace {

class StateViewTest : public ::testing::Test {
 protected:
  StateViewTest()
      : c(pendulum(), let_go("{hinge: {position: 0.4, velocity: 2.0}}", "hinge/position")),
        view(c.system) {
    EXPECT_TRUE(c.start().ok());
    view.set_design(c.system.parameters());
    view.load(c.state);
  }

  Compiled c;
  StateView<double> view;
};

TEST_F(StateViewTest, BodiesMoveAsTheStateSays) {
  const BodyKinematics<double>& bar = view.body(0);
  EXPECT_EQ(bar.r, c.state.q.head<3>());
  EXPECT_EQ(bar.pd, c.state.v.segment<4>(3));
  EXPECT_EQ(bar.pdd, c.state.z.segment<4>(3));
  EXPECT_NEAR((bar.A * bar.A.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
  EXPECT_TRUE(view.body(-1).at_rest);
  EXPECT_FALSE(bar.at_rest);
}

TEST_F(StateViewTest, LocalCoordinatesOfTheGroundHaveNoColumn) {
  const Pair& hinge = c.system.topology().pairs.at(0);
  for (int local = 0; local < kLocalSize; ++local) {
    const int body = local < kBodySize ? hinge.body_i : hinge.body_j;
    EXPECT_EQ(view.column(0, local), body < 0 ? -1 : kBodySize * body + local % kBodySize);
  }
}

TEST_F(StateViewTest, CoordinatesAreThoseOfTheStart) {
  EXPECT_NEAR(view.coordinate(0, 0).position, 0.4, 1e-12);
  EXPECT_NEAR(view.coordinate(0, 0, CoordinateDetail::kRate).rate, 2.0, 1e-12);
  EXPECT_EQ(view.coordinate_value(0, 0), view.coordinate(0, 0).position);
}

TEST_F(StateViewTest, PositionsContinueTheTurnsOfTheState) {
  State<double> turned = c.state;
  turned.turns.at(static_cast<std::size_t>(c.system.layout().turn(0, 0))) = 4.0 * M_PI;
  view.load(turned);
  EXPECT_NEAR(view.coordinate(0, 0).position, 4.0 * M_PI + 0.4, 1e-12);
  view.load(c.state);
  EXPECT_NEAR(view.coordinate(0, 0).position, 0.4, 1e-12) << "nothing is kept from another state";
}

TEST_F(StateViewTest, AnotherDesignForgetsWhatWasComputed) {
  const double before = view.design.constants.bodies.at(0).mass;
  std::vector<double> parameters = c.system.parameters();
  for (double& parameter : parameters) parameter *= 1.5;
  view.set_design(parameters);
  EXPECT_EQ(view.design.parameters, parameters);
  EXPECT_NEAR(view.coordinate(0, 0).rate, 2.0, 1e-12) << "an angle does not depend on lengths";
  EXPECT_GT(before, 0.0);
}

}  // namespace
}  // namespace codesign
