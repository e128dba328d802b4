// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients where Gonthier's bristles switch again and again as a block comes to rest and is torn
// off; theory (13e), (17d). Reference: equation (13e) for one block by scipy's Radau at rtol 1e-10,
// differences of its objective extrapolated from two widths.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "assembly/make_system.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

struct Stick {
  const char *name, *duration, *velocity, *p, *d, *effort;
  double objective;
  Eigen::Vector3d gradient;  ///< by Kp, Kd, mu
};

std::shared_ptr<const CompiledSystem> sticking(const Stick& of, const std::string& solver) {
  const RobotDescription robot = read_urdf(
      {"block.urdf",
       "<robot name='block' xmlns:codesign='urn:mechanism_codesign'><codesign:parameter name='mu' "
       "value='0.3' lower='0.1' upper='1'/><link name='ground'/><link name='block'><inertial>"
       "<mass value='2'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/>"
       "</inertial></link><joint name='slide' type='prismatic'><parent link='ground'/><child "
       "link='block'/><axis xyz='1 0 0'/><limit lower='-5' upper='5' effort='0' velocity='0'/>"
       "<codesign:friction model='gonthier' mu_static='0.39' codesign:mu_static='${1.3*mu}' "
       "mu_dynamic='0.3' codesign:mu_dynamic='${mu}' transition_velocity='0.01' "
       "joint_length='0.1' joint_width='0.1'/></joint></robot>"});
  return make_system(
      robot,
      read_study({"study.yaml",
                  std::string("duration: ") + of.duration + "\ninitial_state: {slide: {velocity: " +
                      of.velocity + "}}\nloads: [{joint: slide, effort: \"${" + of.effort +
                      "}\"}]\ncontrollers: {hold: {type: pid, input: slide/position, setpoint: "
                      "0.5, output: slide, gains: {p: \"${Kp}\", d: \"${Kd}\"}}}\nparameters: {Kp: "
                      "{initial: " +
                      of.p + ", lower: 0, upper: 200}, Kd: {initial: " + of.d +
                      ", lower: 0, upper: 50}, mu: {}}\nobjective: {integral: [{signal: "
                      "slide/position, reference: 0.5, weight: 100}], terminal: [{signal: "
                      "slide/velocity}]}\nsolver: {" +
                      solver + "}"},
                 robot));
}

TEST(BristleKinks, HaveGradientsOfFourDigitsByAllMethods) {
  const Stick cases[] = {{"comes to rest",
                          "2.0",
                          "1.0",
                          "50.0",
                          "2.0",
                          "0.0*t",
                          4.7383084770,
                          {-0.0847038695, 0.0239061614, 9.03279517}},
                         {"is torn off",
                          "2.5",
                          "0.5",
                          "20.0",
                          "1.0",
                          "12*sin(4*t)",
                          46.6103112279,
                          {2.0334138470, -24.1629797696, -296.783694}}};
  for (const Stick& of : cases)
    for (const char* solver : {"", "method: rodas4", "method: rodas5p", "gradient: adjoint",
                               "gradient: adjoint, method: rodas4",
                               "relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-10"}) {
      SCOPED_TRACE(std::string(of.name) + "; " + solver);
      const auto system = sticking(of, solver);
      const Evaluation result =
          evaluator_of(system).evaluate_design(system->parameters(), true, nullptr);
      ASSERT_TRUE(result.status.ok()) << describe(result.status);
      EXPECT_NEAR(result.objective, of.objective, 1e-6 * of.objective);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(result.gradient[k], of.gradient[k], 5e-5 * std::abs(of.gradient[k])) << k;
    }
}

}  // namespace
}  // namespace codesign
