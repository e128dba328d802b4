// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients through bounces on stiff stops at the default tolerances. Sensitivities of velocities
// are thousands of times larger within a contact than beside it, theory (18f).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "assembly/make_system.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

struct Bounces {
  const char* name;
  const char* joint;   ///< the lines of URDF that differ
  const char* keys;    ///< of the limits
  double duration;     ///< [s]
  const char* solver;  ///< further keys
};

std::shared_ptr<const CompiledSystem> bouncing(const Bounces& of, const std::string& tolerances) {
  const RobotDescription robot = read_urdf(
      {"ball.urdf",
       std::string("<robot name='ball' xmlns:codesign='urn:mechanism_codesign'>") +
           "<codesign:parameter name='mass' value='1' lower='0.1' upper='10'/>"
           "<link name='ground'/><link name='body'><inertial><origin xyz='0.3 0 0'/>"
           "<mass value='1' codesign:value='${mass}'/><inertia ixx='0.01' ixy='0' ixz='0' "
           "iyy='0.01' iyz='0' izz='0.01'/></inertial></link>" +
           of.joint + "</robot>"});
  return make_system(
      robot, read_study({"study.yaml",
                         "duration: " + std::to_string(of.duration) +
                             "\ninitial_state: {joint: {position: \"${x0}\"}}\nlimits: {position: "
                             "true, " +
                             of.keys +
                             "}\nparameters: {x0: {initial: 0.5, lower: 0.3, upper: 0.7}, mass: {}}"
                             "\nobjective: {terminal: [{signal: joint/position, reference: 2.0}], "
                             "integral: [{signal: joint/position}]}\nsolver: {" +
                             of.solver + tolerances + "}"},
                        robot));
}

constexpr const char* kDrop =
    "<joint name='joint' type='prismatic'><parent link='ground'/><child link='body'/><axis xyz='0 "
    "0 1'/><limit lower='0' upper='100' effort='0' velocity='0'/></joint>";
constexpr const char* kFlap =
    "<joint name='joint' type='revolute'><parent link='ground'/><child link='body'/><axis xyz='0 "
    "-1 0'/><limit lower='0' upper='3' effort='0' velocity='0'/></joint>";

// The reference has steps a few hundred times shorter in each contact, by a method of another kind.
TEST(Bounces, HaveGradientsOfFourDigitsAtTheDefaultTolerances) {
  for (const Bounces& of : {
           Bounces{"soft", kDrop, "stiffness: 1.0e+4, dissipation: 0.0", 0.5, ""},
           Bounces{"three soft ones", kDrop, "stiffness: 1.0e+4, dissipation: 0.3", 1.6, ""},
           Bounces{"one", kDrop, "stiffness: 1.0e+6, dissipation: 0.3", 0.5, ""},
           Bounces{"five", kDrop, "stiffness: 1.0e+6, dissipation: 0.0", 2.9, ""},
           Bounces{"stiff", kDrop, "stiffness: 1.0e+8, dissipation: 0.0", 0.5, ""},
           Bounces{"five stiff ones", kDrop, "stiffness: 1.0e+8, dissipation: 0.0", 2.9, ""},
           Bounces{"implicit", kDrop, "stiffness: 1.0e+8, dissipation: 0.1", 1.6,
                   "method: rodas5p, "},
           Bounces{"free bodies", kDrop, "stiffness: 1.0e+6, dissipation: 0.1", 1.6,
                   "coordinates: absolute, "},
           Bounces{"a flap", kFlap, "stiffness: 1.0e+6, dissipation: 0.1", 1.0, ""},
           Bounces{"a stiff flap", kFlap, "stiffness: 1.0e+8, dissipation: 0.1", 1.6,
                   "method: rodas4, "},
       }) {
    const auto system = bouncing(of, "");
    const Evaluation run =
        evaluator_of(system).evaluate_design(system->parameters(), true, nullptr);
    const Evaluation plain =
        evaluator_of(system).evaluate_design(system->parameters(), false, nullptr);
    const auto fine = bouncing(of,
                               "relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-13, "
                               "sensitivity_tolerance: 1.0e-9, maximum_steps: 1000000");
    const Evaluation right = evaluator_of(fine).evaluate_design(fine->parameters(), true, nullptr);
    ASSERT_TRUE(run.status.ok() && plain.status.ok() && right.status.ok()) << of.name;
    const Eigen::Vector2d range(0.4, 9.9);
    const double size = right.gradient.cwiseProduct(range).cwiseAbs().maxCoeff();
    EXPECT_LT((run.gradient - right.gradient).cwiseProduct(range).cwiseAbs().maxCoeff(),
              1e-4 * size)
        << of.name << ": " << run.gradient.transpose() << " for " << right.gradient.transpose();
    EXPECT_LT(run.statistics.steps, 4 * plain.statistics.steps) << of.name;
  }
}

}  // namespace
}  // namespace codesign
