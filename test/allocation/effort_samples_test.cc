// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The efforts of a sample and their derivatives allocate no memory once the workspaces have their
// sizes.
#include "allocation/count.h"
#include "equations/compiled.h"
#include "identification/recorded_motion.h"

namespace codesign {
namespace {

TEST(EffortSamples, AskForNoMemoryOnceWarm) {
  std::string urdf = four_bar(
      "<codesign:friction mu_static='0.2' codesign:mu_static='${mu+0.05}' mu_dynamic='0.15' "
      "codesign:mu_dynamic='${mu}' "
      "transition_velocity='0.01' joint_length='0.05' pin_radius='0.02'/>");
  const std::string ground = "<link name='ground'/>";
  urdf.replace(urdf.find(ground), ground.size(),
               "<codesign:parameter name='mu' value='0.15'/><link name='ground'/>");
  const auto system = compiled(urdf, let_go("{left_hinge: {position: 0.3}}", "left_hinge/velocity",
                                            "parameters: {mu: {tune: true}}"));
  MotionSamples measured_motion;
  for (Eigen::MatrixXd* part :
       {&measured_motion.position, &measured_motion.velocity, &measured_motion.acceleration})
    part->resize(1, 100);
  for (int k = 0; k < 100; ++k) {
    measured_motion.position(0, k) = 0.3 + 0.4 * std::sin(0.05 * k);
    measured_motion.velocity(0, k) = 2.0 * std::cos(0.05 * k);
    measured_motion.acceleration(0, k) = -10.0 * std::sin(0.05 * k);
  }
  EffortModel model(*system, measured({"left_hinge"}), measured_motion);
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  std::vector<double> parameters = system->parameters();
  parameters[0] *= 1.3;
  DrivenMotion motion(model.driven());
  EffortTangent<4> tangent(*model.driven().system, {0, 1});
  motion.set_design(parameters);
  tangent.set_design(parameters);
  RowJacobian jacobian(100, 1);
  State<double> state = model.state(0);
  for (const bool warm : {false, true}) {
    const std::int64_t before = allocations();
    for (int k = 0; k < 100; ++k) {
      state = model.state(k);
      const auto number = [k](const Eigen::MatrixXd& of) { return In<double>(of.data() + k, 1); };
      ASSERT_TRUE(motion
                      .solve({number(model.position()), number(model.velocity()),
                              number(model.acceleration())},
                             &state)
                      .ok());
      ASSERT_TRUE(motion.linearize(state).ok());
      tangent.differentiate(motion, state, k, &jacobian);
    }
    if (warm) {
      EXPECT_EQ(allocations(), before);
    }
  }
}

}  // namespace
}  // namespace codesign
