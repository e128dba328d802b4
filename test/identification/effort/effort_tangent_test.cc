// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_tangent.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "identification/complex_efforts.h"
#include "identification/recorded_motion.h"
#include "math/differences.h"

namespace codesign {
namespace {

/// A pendulum on a slide: the slide's friction depends on the reaction to the pendulum, whose
/// length and mass are tuned.
std::shared_ptr<const CompiledSystem> crane() {
  return compiled(
      "<robot name='crane' xmlns:codesign='urn:t'><codesign:parameter name='length' "
      "value='0.5'/><codesign:parameter name='load' "
      "value='2'/>"
      "<codesign:parameter name='mu' value='0.1'/><codesign:parameter name='width' "
      "value='0.1'/><codesign:parameter name='stiffness' "
      "value='3'/><link name='ground'/><link name='trolley'><inertial><mass value='1'/><inertia "
      "ixx='0.01' ixy='0' ixz='0' iyy='0.01' "
      "iyz='0' "
      "izz='0.01'/></inertial></link><link name='load'><inertial><origin xyz='0 0 -0.5' "
      "codesign:xyz='0 0 ${-length}'/><mass value='2' "
      "codesign:value='${load}'/><inertia ixx='0.02' ixy='0' ixz='0' iyy='0.02' iyz='0' "
      "izz='0.02'/></inertial></link>"
      "<joint name='rail' type='prismatic'><parent link='ground'/><child link='trolley'/><axis "
      "xyz='1 0 0'/><limit effort='0' "
      "velocity='0'/>"
      "<codesign:friction mu_static='0.15' codesign:mu_static='${1.5*mu}' mu_dynamic='0.1' "
      "codesign:mu_dynamic='${mu}' "
      "transition_velocity='0.01' joint_length='0.2' joint_width='0.1' "
      "codesign:joint_width='${width}'/></joint>"
      "<joint name='swing' type='continuous'><parent link='trolley'/><child link='load'/><axis "
      "xyz='0.6 0.8 0'/><codesign:torsion_spring "
      "stiffness='3' codesign:stiffness='${stiffness}'/></joint></robot>",
      let_go("{}", "rail/velocity",
             "parameters: {length: {tune: true}, load: {tune: true}, mu: {tune: true}, width: "
             "{tune: true}, stiffness: {tune: true}}"));
}

TEST(EffortTangent, AgreesWithAComplexStepForEightAndForFourLanes) {
  const auto system = crane();
  const std::vector<MeasuredJoint> joints = measured({"rail", "swing"});
  const DrivenSystem driven = make_driven_system(*system, joints);
  DrivenMotion motion(driven);
  motion.set_design(system->parameters());
  const Eigen::Vector2d position(0.1, 0.4), velocity(0.02, -1.3), acceleration(1.5, 4.0);
  State<double> state;
  ASSERT_TRUE(
      assemble_driven(*system, joints, driven, system->parameters(), position, &state).ok());
  const DriveMotion given{position, velocity, acceleration};
  ASSERT_TRUE(motion.follow(given, &state).ok());
  ASSERT_TRUE(motion.linearize(state).ok());

  RowJacobian jacobian = RowJacobian::Zero(3, 5), narrow = RowJacobian::Zero(2, 5);
  EffortTangent<8> all(*driven.system, {0, 5});
  all.set_design(system->parameters());
  all.differentiate(motion, state, 1, &jacobian);
  EXPECT_TRUE(jacobian.row(0).isZero(0.0));
  EffortTangent<4> first(*driven.system, {0, 4}), last(*driven.system, {4, 1});
  for (EffortTangent<4>* part : {&first, &last}) {
    part->set_design(system->parameters());
    part->differentiate(motion, state, 0, &narrow);
  }
  ComplexEfforts complex(driven, given, state);
  const std::vector<double> parameters = system->parameters();
  const Eigen::VectorXd rho = Eigen::Map<const Eigen::VectorXd>(parameters.data(), 5);
  const Eigen::MatrixXd reference =
      complex_step_jacobian([&complex](const Eigen::VectorXcd& at) { return complex(at); }, rho);
  EXPECT_GT(reference.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-3);
  EXPECT_LT(compare_jacobians(jacobian.bottomRows(2), reference).largest, 1e-10);
  EXPECT_LT(compare_jacobians(narrow, reference).largest, 1e-10);
}

}  // namespace
}  // namespace codesign
