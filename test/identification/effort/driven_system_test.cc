// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/driven_system.h"

#include "description/study.h"
#include "equations/compiled.h"
#include "identification/recorded_motion.h"

namespace codesign {
namespace {

std::shared_ptr<const CompiledSystem> double_pendulum_system() {
  return compiled(double_pendulum(), let_go("{shoulder: {position: 1.0}}", "elbow/velocity"));
}

/// The fault that a choice of measured joints is refused with.
InputFault refusal(const CompiledSystem& system, const std::vector<MeasuredJoint>& joints) {
  try {
    make_driven_system(system, joints);
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

TEST(DrivenSystem, EveryMeasuredJointOfATreeIsDriven) {
  const auto system = double_pendulum_system();
  const DrivenSystem driven = make_driven_system(*system, measured({"elbow", "shoulder"}));
  EXPECT_EQ(driven.drives, (std::vector<int>{0, 1}));
  EXPECT_TRUE(driven.surplus.empty());
  const Coupling& first = driven.system->topology().couplings[0];
  EXPECT_EQ(first.name, "elbow");
  EXPECT_TRUE(first.is_drive);
  EXPECT_EQ(driven.system->drive_row(0), driven.system->layout().coupling_row(0));
  EXPECT_EQ(driven.system->layout().n, 2);
  EXPECT_EQ(driven.system->layout().m, 2) << "the drives";
  Study study = system->whole_study();
  study.solver.coordinates = CoordinatesKind::kAbsolute;
  const CompiledSystem absolute(system->robot(), study);
  const Layout& layout =
      make_driven_system(absolute, measured({"elbow", "shoulder"})).system->layout();
  EXPECT_EQ(layout.n, 2 * 7);
  EXPECT_EQ(layout.m, 2 * 5 + 2 + 2) << "rows of hinges, unit Euler parameters, drives";
}

TEST(DrivenSystem, InALoopTheJointWithAnEffortIsPreferred) {
  const auto system =
      compiled(four_bar(), let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity"));
  const DrivenSystem driven =
      make_driven_system(*system, measured({"right_hinge"}, {"left_hinge", "left_pin"}));
  EXPECT_EQ(driven.drives, std::vector<int>{0});
  EXPECT_EQ(driven.surplus, (std::vector<int>{1, 2}));
}

TEST(DrivenSystem, WithoutControllersAndObjective) {
  const auto system = compiled(
      pendulum(),
      let_go(
          "{}", "hinge/velocity",
          "controllers: {motor: {type: pid, input: hinge/position, setpoint: 0.0, output: hinge, "
          "gains: {p: 5.0, i: 1.0}}}"));
  ASSERT_GT(system->layout().states, 0);
  EXPECT_EQ(make_driven_system(*system, measured({"hinge"})).system->layout().states, 0);
}

TEST(DrivenSystem, GearsThatYieldAreRigid) {
  const auto system = compiled(
      pendulum("<codesign:actuator gear_ratio='20' rotor_inertia='1e-4' stiffness='400'/>"),
      let_go("{}", "hinge/velocity"));
  ASSERT_GT(system->robot().joints.size(), 1U) << "the motor's side";
  const DrivenSystem driven = make_driven_system(*system, measured({"hinge"}));
  EXPECT_EQ(driven.drives, std::vector<int>{0});
  EXPECT_EQ(driven.system->layout().n, 1);
}

// A measured joint drives, whatever motion the study gives; segments leave it to the study.
TEST(DrivenSystem, MotionsThatTheStudyGivesAreMeasured) {
  const auto system =
      compiled(four_bar(), "duration: 1\nmotion: {left_hinge: {position: \"${0.3 + 0.2*t}\"}}\n");
  const DrivenSystem driven = make_driven_system(*system, measured({"left_hinge"}));
  EXPECT_EQ(driven.drives, std::vector<int>{0});
  EXPECT_TRUE(driven.system->study().motion.empty());
  EXPECT_EQ(independent_joints(*system, measured({"left_hinge"})), std::vector<std::string>{});
}

TEST(DrivenSystem, TooFewJointsAreRefusedByTheJointWhoseMotionIsNotDetermined) {
  const InputFault fault = refusal(*double_pendulum_system(), measured({"shoulder"}));
  EXPECT_EQ(fault.element, "<joint name=\"elbow\">");
  EXPECT_NE(fault.message.find("not determined"), std::string::npos);
  EXPECT_NE(fault.value.find("'shoulder'"), std::string::npos);
}

TEST(DrivenSystem, MoreEffortsThanDegreesOfFreedomAreRefused) {
  const auto system =
      compiled(four_bar(), let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity"));
  const InputFault fault = refusal(*system, measured({"left_hinge", "right_hinge"}));
  EXPECT_NE(fault.message.find("degrees of freedom"), std::string::npos);
  EXPECT_EQ(fault.where.line, 3);
}

TEST(DrivenSystem, UnknownAndRepeatedJointsAreRefused) {
  const auto system = double_pendulum_system();
  EXPECT_NE(refusal(*system, measured({"elbo"})).message.find("elbow"), std::string::npos);
  EXPECT_NE(refusal(*system, measured({"elbow", "elbow"})).message.find("twice"),
            std::string::npos);
}

TEST(DrivenSystem, FrictionWithStatesIsRefused) {
  const auto system = compiled(with_friction_model(pendulum(pin_friction()), "lugre"),
                               let_go("{}", "hinge/velocity"));
  EXPECT_EQ(refusal(*system, measured({"hinge"})).value, "lugre");
}

TEST(DrivenSystem, AStretchedOutStartDoesNotCount) {
  // All bars of the parallelogram hang on one line, where two motions meet.
  std::string urdf = four_bar();
  const auto replace = [&urdf](const std::string& from, const std::string& to) {
    urdf.replace(urdf.find(from), from.size(), to);
  };
  replace("<origin xyz='1.2 0 0'/>", "<origin xyz='0 0 -1.2'/>");
  const auto system = compiled(urdf, let_go("{left_hinge: {position: 0.0}, right_hinge: {guess: "
                                            "0.0}, left_pin: {guess: 1.5707963267948966}}",
                                            "left_hinge/velocity"));
  const Eigen::MatrixXd positions = Eigen::MatrixXd::Constant(1, 1, 0.7);
  EXPECT_EQ(make_driven_system(*system, measured({"left_hinge"}), positions).drives,
            std::vector<int>{0});
}

TEST(DrivenSystem, AJointWithoutMassIsLeftOutUnlessItHasAnEffort) {
  std::string urdf = pendulum();
  const std::string end = "</robot>";
  urdf.replace(urdf.find(end), end.size(),
               "<link name='tool'/>" + hinge("tool_joint", "bar", "tool", "0 0 -1") + end);
  const auto system = compiled(urdf, let_go("{}", "hinge/velocity"));
  const DrivenSystem driven = make_driven_system(*system, measured({"hinge"}, {"tool_joint"}));
  EXPECT_EQ(driven.drives, std::vector<int>{0});
  EXPECT_TRUE(driven.surplus.empty());
  EXPECT_EQ(refusal(*system, measured({"hinge", "tool_joint"})).element,
            "<joint name=\"tool_joint\">");
}

TEST(DrivenSystem, AssemblesTheLoopsAtTheMeasuredPositions) {
  const auto system =
      compiled(four_bar(), let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity"));
  const std::vector<MeasuredJoint> joints = measured({"left_hinge"}, {"right_hinge"});
  const DrivenSystem driven = make_driven_system(*system, joints);
  State<double> state;
  ASSERT_TRUE(assemble_driven(*system, joints, driven, system->parameters(),
                              Eigen::Vector2d(0.5, 0.52), &state)
                  .ok());
  Equations<double> equations(*driven.system);
  equations.set_design(system->parameters());
  VectorX<double> Phi, Phi_rate;
  equations.constraint_errors(state, &Phi, &Phi_rate);
  EXPECT_NEAR(Phi[driven.system->drive_row(0)], 0.5, 1e-12);
  Phi[driven.system->drive_row(0)] = 0.0;
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace codesign
