// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/driven_motion.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "equations/formulas.h"
#include "identification/recorded_motion.h"

namespace codesign {
namespace {

class DrivenMotionTest : public testing::Test {
 protected:
  DrivenMotionTest()
      : system(compiled(four_bar(pin_friction()),
                        let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity"))),
        joints(measured({"left_hinge"})),
        driven(make_driven_system(*system, joints)),
        motion(driven) {
    motion.set_design(system->parameters());
    const Status status = assemble_driven(*system, joints, driven, system->parameters(),
                                          Eigen::VectorXd::Constant(1, 0.3), &state);
    EXPECT_TRUE(status.ok()) << status.cause;
  }

  Status follow(double position, double velocity, double acceleration) {
    const double given[] = {position, velocity, acceleration};
    return motion.follow({In<double>(given).subspan(0, 1), In<double>(given).subspan(1, 1),
                          In<double>(given).subspan(2, 1)},
                         &state);
  }

  std::shared_ptr<const CompiledSystem> system;
  std::vector<MeasuredJoint> joints;
  DrivenSystem driven;
  DrivenMotion motion;
  State<double> state;
};

TEST_F(DrivenMotionTest, SatisfiesAllEquations) {
  ASSERT_TRUE(follow(0.5, 2.0, -3.0).ok());
  const Layout& layout = driven.system->layout();
  const int row = driven.system->drive_row(0);
  VectorX<double> Phi, Phi_rate, G;
  double g = 0.0;
  motion.equations().constraint_errors(state, &Phi, &Phi_rate);
  EXPECT_NEAR(Phi[row], 0.5, 1e-14);
  EXPECT_NEAR(Phi_rate[row], 2.0, 1e-13);
  Phi[row] = Phi_rate[row] = 0.0;
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT(Phi_rate.cwiseAbs().maxCoeff(), 1e-10);
  motion.equations().residual(state, &G, &g);
  EXPECT_NEAR(G[layout.lambda_column(row)], -3.0, 1e-12);
  G[layout.lambda_column(row)] = 0.0;
  EXPECT_LT(G.cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(DrivenMotionTest, FollowsALongWayOnTheSameBranch) {
  ASSERT_TRUE(follow(1.2, 0.0, 0.0).ok());
  // The parallelogram stays one: the right bar turns as far as the left one.
  const CouplingTerm right =
      drive_of(system->robot(), system->topology(), joint_index(system->robot(), "right_hinge"))
          .terms.front();
  Formulas<double>& formulas = motion.equations().formulas();
  formulas.load(state);
  EXPECT_NEAR(formulas.coordinate(right.pair, right.element).position, 1.2, 1e-9);
}

TEST_F(DrivenMotionTest, SolvesFromNearbyToTheSameEffort) {
  ASSERT_TRUE(follow(0.5, 2.0, -3.0).ok());
  const double effort = motion.effort(state, 0);
  ASSERT_TRUE(follow(0.52, 1.5, 4.0).ok());
  const double given[] = {0.5, 2.0, -3.0};
  ASSERT_TRUE(motion
                  .solve({In<double>(given).subspan(0, 1), In<double>(given).subspan(1, 1),
                          In<double>(given).subspan(2, 1)},
                         &state)
                  .ok());
  EXPECT_NEAR(motion.effort(state, 0), effort, 1e-10);
}

TEST_F(DrivenMotionTest, ForgettingMakesResultsRepeatToTheLastBit) {
  ASSERT_TRUE(motion.linearize(state).ok());
  motion.keep_pivots();
  const State<double> start = state;
  motion.reset_pivots();
  ASSERT_TRUE(follow(0.35, 1.0, 2.0).ok());
  const double first = motion.effort(state, 0);
  ASSERT_TRUE(follow(1.2, 1.0, 2.0).ok());
  state = start;
  motion.reset_pivots();
  ASSERT_TRUE(follow(0.35, 1.0, 2.0).ok());
  EXPECT_EQ(motion.effort(state, 0), first);
}

// A tree all of whose joints are driven has nothing to iterate: its coordinates are set, and one
// residual gives the efforts.
TEST(DrivenMotion, ATreeFollowsAnyMotionAtOnce) {
  const auto system = compiled(double_pendulum(pin_friction()),
                               let_go("{shoulder: {position: 0.3}}", "shoulder/velocity"));
  const std::vector<MeasuredJoint> joints = measured({"elbow", "shoulder"});
  const DrivenSystem driven = make_driven_system(*system, joints);
  DrivenMotion motion(driven);
  motion.set_design(system->parameters());
  State<double> state;
  ASSERT_TRUE(assemble_driven(*system, joints, driven, system->parameters(),
                              Eigen::Vector2d(0.0, 0.3), &state)
                  .ok());
  const Eigen::Vector2d position(-40.0, 9.0), velocity(3.0, -0.02), acceleration(-7.0, 11.0);
  ASSERT_TRUE(motion.follow({position, velocity, acceleration}, &state).ok());
  EXPECT_EQ(state.q, position.reverse());  // the coordinates have the order of the bodies
  EXPECT_EQ(state.v, velocity.reverse());
  EXPECT_EQ(state.z.head(2), acceleration.reverse());
  VectorX<double> G;
  double g = 0.0;
  motion.equations().residual(state, &G, &g);
  EXPECT_LT(G.head(2).cwiseAbs().maxCoeff(), 1e-13 * state.z.cwiseAbs().maxCoeff());
  EXPECT_EQ(motion.follow({position, velocity, Eigen::Vector2d(0.0, std::nan(""))}, &state).code,
            StatusCode::kNonFinite);
}

TEST_F(DrivenMotionTest, APositionThatIsNoNumberIsAStatus) {
  EXPECT_EQ(follow(std::nan(""), 0.0, 0.0).code, StatusCode::kAssemblyFailed);
  EXPECT_EQ(follow(0.3, std::nan(""), 0.0).code, StatusCode::kInitialVelocityFailed);
}

}  // namespace
}  // namespace codesign
