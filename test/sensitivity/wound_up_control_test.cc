// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Integrals of limited controllers, theory (50)-(51a), against solutions by scipy.
#include <gtest/gtest.h>

#include <string>

#include "assembly/make_system.h"
#include "description/tuned_parameters.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kCart = R"(<robot name="cart"><link name="ground"/>
  <link name="body"><inertial><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="x" type="prismatic"><parent link="ground"/><child link="body"/>
    <axis xyz="1 0 0"/><limit effort="50" velocity="1000"/><dynamics damping="0.3"/></joint>
</robot>)";

struct WindupCase {
  const char* name;
  const char* keys;
  double velocity, integral, position;  ///< at 5 s
};

/// A cart whose speed a PI sets to 0.8, and from 2 s on to -0.5, with forces from -0.5 to 1.
std::shared_ptr<const CompiledSystem> compiled(const WindupCase& of, const std::string& terms,
                                               const std::string& solver) {
  const RobotDescription robot = read_urdf({"test.urdf", kCart});
  const std::string text =
      "duration: 5\ngravity: [0, 0, 0]\ncontrollers:\n  servo: {type: pid, input: x/velocity, "
      "setpoint: \"${t < 2 ? 0.8 : -0.5}\", output: x, gains: {p: \"${p}\", i: \"${i}\"}, "
      "output_limit: [\"${lower}\", \"${upper}\"]" +
      std::string(of.keys) +
      "}\nparameters: {p: {initial: 2}, i: {initial: 3}, lower: {initial: -0.5}, upper: {initial: "
      "1}}\nobjective: {terminal: [" +
      terms + "]}\nsolver: {" + solver + "}\n";
  return make_system(robot, read_study({"test.yaml", text}, robot));
}

std::string term(const char* signal, double reference) {
  return std::string("{signal: ") + signal + ", reference: " + to_decimal(reference) + "}";
}

// References: the same equations by DOP853 with rtol 1e-12 and steps of at most 1 ms; the sampled
// ones by their recursions with the exact motion of the cart between samples.
class WindupTest : public ::testing::TestWithParam<WindupCase> {};

TEST_P(WindupTest, IsTheSolutionByScipy) {
  for (const char* solver :
       {"method: dopri5, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11",
        "method: rodas5p, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11",
        "integrator: idas, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-12"}) {
    const auto system = compiled(GetParam(),
                                 term("x/velocity", GetParam().velocity) + ", " +
                                     term("servo/integral", GetParam().integral) + ", " +
                                     term("x/position", GetParam().position),
                                 solver);
    const Evaluation found = evaluator_of(system).evaluate(start_of(system->study()), false);
    ASSERT_TRUE(found.status.ok()) << found.status.cause;
    EXPECT_LT(std::sqrt(found.objective), 2e-7) << solver;
  }
}

TEST_P(WindupTest, HasTheGradientOfDifferences) {
  for (const char* solver :
       {"gradient: direct", "gradient: adjoint", "gradient: direct, method: rodas5p"}) {
    const auto system =
        compiled(GetParam(), "{signal: x/position}, {signal: x/velocity}, {signal: servo/integral}",
                 std::string(solver) + ", relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10");
    const GradientCheck check =
        check_gradient(system, start_of(system->study()), CheckMethod::kRidders);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-6) << solver;
    EXPECT_GT(check.evaluation.gradient.cwiseAbs().maxCoeff(), 1e-2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, WindupTest,
    ::testing::Values(
        WindupCase{"back_calculation", ", antiwindup: back_calculation", -0.5763557042560203,
                   -0.14464909920390032, 1.4518757168431975},
        WindupCase{"tracking_time", ", antiwindup: back_calculation, tracking_time: 0.2",
                   -0.5190548077707561, -0.09248497270228584, 1.3684768773131026},
        WindupCase{"conditional", ", antiwindup: conditional", -0.5148247601372199,
                   -0.08976611040906879, 1.336645562006474},
        WindupCase{"sampled", ", sample_time: 0.05", -0.5874170802596246, -1.6205177920964864,
                   1.7057956516601416},
        WindupCase{"sampled_back_calculation", ", sample_time: 0.05, antiwindup: back_calculation",
                   -0.5706443830085924, -0.1349944484071455, 1.439987365414937},
        WindupCase{"sampled_conditional", ", sample_time: 0.05, antiwindup: conditional",
                   -0.5116281964802293, -0.0844137997212528, 1.321903838570322}),
    [](const ::testing::TestParamInfo<WindupCase>& test) { return test.param.name; });

}  // namespace
}  // namespace codesign
