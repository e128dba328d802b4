// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/method_choice.h"

#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

/// An arm on a vertical pin with dry friction, pulled to and fro by a spring whose other end moves:
/// it sticks, slips, and sticks again.
GradientCase stick_slip(const std::string& coordinates) {
  GradientCase test = from_texts(
      "stick_slip",
      "<robot name='arm' xmlns:codesign='https://mechanism-codesign.org/urdf'><link "
      "name='base'/><link name='arm'><inertial>"
      "<origin xyz='0.3 0 0'/><mass value='2'/><inertia ixx='0.01' iyy='0.1' izz='0.1' ixy='0' "
      "ixz='0' iyz='0'/></inertial></link>"
      "<joint name='hinge' type='continuous'><parent link='base'/><child link='arm'/><axis xyz='0 "
      "0 1'/>"
      "<codesign:friction mu_static='0.3' mu_dynamic='0.2' transition_velocity='1e-5' "
      "pin_radius='0.02' "
      "joint_length='0.1'/></joint></robot>",
      "duration: 6.0\ninitial_state: {hinge: {velocity: 2.0}}\nparameters: {stiffness: {initial: "
      "3.0, lower: 1.0, upper: 5.0, tune: "
      "true}}\n"
      "controllers: {spring: {type: pid, input: hinge/position, setpoint: {type: sine, amplitude: "
      "0.4, period: 3.0}, output: hinge,\n"
      "  gains: {p: \"${stiffness}\", d: 0.3}}}\n"
      "objective: {integral: [{signal: hinge/position}], terminal: [{signal: hinge/velocity}]}\n");
  test.study.solver.coordinates =
      coordinates == "joint" ? CoordinatesKind::kJoint : CoordinatesKind::kAbsolute;
  test.study.solver.relative_tolerance = test.study.solver.absolute_tolerance = 1e-8;
  return test;
}

/// The steps at which the method changed.
std::vector<int> changes(const CompiledSystem& system) {
  RosenbrockIntegrator integrator(system);
  EXPECT_TRUE(integrator.start(system.parameters()).ok());
  std::vector<int> changes;
  bool was_explicit = true;
  while (integrator.state().t < system.study().duration) {
    const Status status = integrator.advance(system.study().duration);
    EXPECT_TRUE(status.ok()) << status.cause;
    if (!status.ok()) break;
    if (integrator.step().tableau().is_explicit() != was_explicit)
      changes.push_back(static_cast<int>(integrator.statistics().steps));
    was_explicit = integrator.step().tableau().is_explicit();
  }
  return changes;
}

class MethodChoiceTest : public ::testing::TestWithParam<const char*> {};

TEST_P(MethodChoiceTest, ChangesOverBothWaysWithinARun) {
  const auto system = stick_slip(GetParam()).compile("auto", "direct");
  EXPECT_GE(changes(*system).size(), 2U);
  EXPECT_EQ(changes(*system), changes(*system));
}

TEST_P(MethodChoiceTest, TheRunKnowsWhichMethodTookWhichSteps) {
  const auto system = stick_slip(GetParam()).compile("auto", "direct");
  Simulation simulation = simulation_of(system, system->parameters());
  ASSERT_TRUE(simulation.start().ok());
  ASSERT_TRUE(simulation.advance(system->study().duration).ok());
  const std::vector<MethodChange>& methods = simulation.methods();
  // The run begins implicitly, since it has dry friction, which changes() counts as a change.
  ASSERT_EQ(methods.size(), changes(*system).size());
  for (std::size_t k = 0; k < methods.size(); ++k) {
    EXPECT_STREQ(methods[k].method, k % 2 == 0 ? "rodas5p" : "dopri5");
    EXPECT_TRUE(k == 0 ? methods[k].time == 0.0 : methods[k].time > methods[k - 1].time);
  }
}

TEST_P(MethodChoiceTest, FindsWhatTheImplicitMethodFinds) {
  const GradientCase test = stick_slip(GetParam());
  const auto automatic = test.compile("auto", "direct"),
             implicit = test.compile("rodas5p", "direct");
  RosenbrockGradient a(*automatic), b(*implicit);
  const GradientRun changing = run_gradient(&a, *automatic, automatic->parameters()),
                    fixed = run_gradient(&b, *implicit, implicit->parameters());
  ASSERT_TRUE(changing.status.ok() && fixed.status.ok());
  EXPECT_NEAR(changing.objective, fixed.objective, 1e-6 * fixed.objective);
  EXPECT_NEAR(changing.gradient[0], fixed.gradient[0], 1e-4 * std::abs(fixed.gradient[0]));
  EXPECT_GT(a.statistics().explicit_steps, 0);
  EXPECT_LT(a.statistics().explicit_steps, a.statistics().steps);
  EXPECT_EQ(b.statistics().explicit_steps, 0);
}

TEST_P(MethodChoiceTest, TheTangentOfAChangingRunIsExactAndTheAdjointTheSame) {
  const auto system = stick_slip(GetParam()).compile("auto", "direct");
  const Eigen::VectorXd rho = Eigen::VectorXd::Constant(1, system->parameters()[0]);
  const GradientCheck check = check_gradient(system, rho, CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-10);
  AdjointGradient adjoint(*system);
  const GradientRun back = run_gradient(&adjoint, *system, system->parameters());
  ASSERT_TRUE(back.status.ok()) << back.status.cause;
  EXPECT_NEAR(back.gradient[0], check.evaluation.gradient[0], 1e-9 * std::abs(back.gradient[0]));
}

INSTANTIATE_TEST_SUITE_P(Coordinates, MethodChoiceTest, ::testing::Values("joint", "absolute"));

TEST(MethodChoice, BeginsImplicitlyWithDryFrictionAndReturnsWhereItIsNotStiff) {
  const auto system = shipped_case("two_link_arm", 0.5).compile("auto", "direct");
  const std::vector<int> steps = changes(*system);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0], 1);
}

/// A chain of hinges that swings in its plane.
std::string hanging_chain(int links) {
  std::string model = "<robot name='chain'><link name='link0'/>";
  for (int k = 1; k <= links; ++k) {
    const std::string own = std::to_string(k), parent = std::to_string(k - 1);
    model += "<link name='link" + own +
             "'><inertial><origin xyz='0 0 -0.05'/><mass value='1'/><inertia ixx='0.001' "
             "iyy='0.001' izz='0.0005' ixy='0' ixz='0' iyz='0'/></inertial></link><joint "
             "name='hinge" +
             own + "' type='continuous'><parent link='link" + parent + "'/><child link='link" +
             own + "'/><origin xyz='0 0 " + (k == 1 ? "0" : "-0.1") +
             "'/><axis xyz='0 1 0'/></joint>";
  }
  return model + "</robot>";
}

TEST(MethodChoice, StaysExplicitWhereNothingIsStiffAndAProgramGivesTheAccelerations) {
  const auto system = from_texts("chain", hanging_chain(2),
                                 "duration: 2\ninitial_state: {hinge1: {position: 0.5}}\n"
                                 "objective: {integral: [{signal: hinge1/position}]}\n")
                          .compile("auto", "direct");
  EXPECT_TRUE(changes(*system).empty());
}

// The pair takes about twice as many steps there, and each costs more.
TEST(MethodChoice, AChainWhoseExplicitStagesFactorAMatrixGoesOnImplicitlyAfterATrial) {
  const GradientCase test = from_texts(
      "chain", hanging_chain(30),
      "duration: 0.5\ninitial_state: {hinge1: {position: 0.5}}\nobjective: {integral: [{signal: "
      "hinge1/position}]}\n");
  const auto system = test.compile("auto", "direct"), pair = test.compile("dopri5", "direct");
  const std::vector<int> steps = changes(*system);
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps[0], 25);
  Simulation chosen = simulation_of(system, system->parameters()),
             explicitly = simulation_of(pair, pair->parameters());
  ASSERT_TRUE(chosen.start().ok() && chosen.advance(0.5).ok());
  ASSERT_TRUE(explicitly.start().ok() && explicitly.advance(0.5).ok());
  EXPECT_LT(chosen.statistics().steps, 0.8 * static_cast<double>(explicitly.statistics().steps));
  EXPECT_LT(chosen.statistics().explicit_steps,
            0.5 * static_cast<double>(chosen.statistics().steps));
  EXPECT_NEAR(chosen.objective(), explicitly.objective(), 1e-6 * explicitly.objective());
}

// Absolute coordinates have no program for accelerations; the pair's steps are the longer ones.
TEST(MethodChoice, ThePairGoesOnWhereItsStepsAreLongEnough) {
  GradientCase test = from_texts(
      "chain", hanging_chain(6),
      "duration: 3\ninitial_state: {hinge2: {position: 0.5}}\nobjective: {integral: [{signal: "
      "hinge1/position}]}\n");
  test.study.solver.coordinates = CoordinatesKind::kAbsolute;
  const auto system = test.compile("auto", "direct");
  Simulation simulation = simulation_of(system, system->parameters());
  ASSERT_TRUE(simulation.start().ok() && simulation.advance(3.0).ok());
  EXPECT_GT(simulation.methods().size(), 2U);
  EXPECT_GT(simulation.statistics().explicit_steps,
            0.7 * static_cast<double>(simulation.statistics().steps));
}

TEST(MethodChoice, LoopsThatShareReactionsStayImplicit) {
  const auto system = compile(
      four_bar(), motion_study(0.5, "{left_hinge: {position: 0.4}}", "left_hinge/velocity", "{}"));
  EXPECT_EQ(changes(*system), std::vector<int>{1});
}

}  // namespace
}  // namespace codesign
