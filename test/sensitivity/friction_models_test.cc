// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients through friction laws with states: of their own coefficients, of gains, and of a start
// that slides.
#include <gtest/gtest.h>

#include "edited_text.h"
#include "equations/compiled_system.h"
#include "integration/servo.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// The servo's shoulder and elbow rub under a law whose six coefficients are parameters too.
std::string rubbing(const std::string& model) {
  const std::string coefficients =
      "<codesign:friction model='" + model +
      "' mu_static='0.2' codesign:mu_static='${mu_s}' mu_dynamic='0.15' transition_velocity='0.02' "
      "codesign:transition_velocity='${v_s}' "
      "joint_length='0.05' pin_radius='0.02' bristle_stiffness='2000' "
      "codesign:bristle_stiffness='${sigma_0}' bristle_damping='4' "
      "codesign:bristle_damping='${sigma_1}'" +
      (model == "gonthier" ? " dwell_time='0.5' codesign:dwell_time='${tau}'" : "") + "/>";
  const auto parameter = [](const char* name, const char* value) {
    return std::string("<codesign:parameter name='") + name + "' value='" + value + "'/>";
  };
  return replaced_all(double_pendulum(coefficients), "<link name='ground'/>",
                      "<link name='ground'/>" + parameter("mu_s", "0.2") +
                          parameter("v_s", "0.02") + parameter("sigma_0", "2000") +
                          parameter("sigma_1", "4") + parameter("tau", "0.5"));
}

std::shared_ptr<const CompiledSystem> rubbing_servo(const std::string& model,
                                                    const std::string& solver) {
  std::string study = replaced_all(servo_study(solver), "duration: 0.6", "duration: 0.25");
  study.replace(study.find("parameters: {"), 13,
                std::string("parameters: {mu_s: {tune: true}, v_s: {tune: true}, sigma_0: {tune: "
                            "true}, sigma_1: {tune: true}, ") +
                    (model == "gonthier" ? "tau: {tune: true}, " : ""));
  return compile(rubbing(model), study);
}

Eigen::VectorXd start_of(const CompiledSystem& system) {
  const std::vector<double> all = system.parameters();
  Eigen::VectorXd rho(static_cast<Eigen::Index>(system.study().tuned.size()));
  for (std::size_t k = 0; k < system.study().tuned.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] = all[static_cast<std::size_t>(system.study().tuned[k])];
  return rho;
}

const char* const kRosenbrock =
    "{integrator: rosenbrock, method: rodas4p2, relative_tolerance: 1.0e-6, absolute_tolerance: "
    "1.0e-7}";
const char* const kIdas =
    "{integrator: idas, relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}";

class FrictionLaws : public ::testing::TestWithParam<const char*> {};

TEST_P(FrictionLaws, GradientIsThatOfTheStepsTaken) {
  const auto system = rubbing_servo(GetParam(), kRosenbrock);
  const GradientCheck check = check_gradient(system, start_of(*system), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-9);
  EXPECT_GT(check.evaluation.gradient.cwiseAbs().minCoeff(), 1e-10) << "every coefficient counts";
}

TEST_P(FrictionLaws, BothIntegratorsFindTheSameObjective) {
  const auto a = rubbing_servo(GetParam(), kRosenbrock), b = rubbing_servo(GetParam(), kIdas);
  const Evaluation rosenbrock = evaluator_of(a).evaluate(start_of(*a), false),
                   idas = evaluator_of(b).evaluate(start_of(*b), false);
  ASSERT_TRUE(rosenbrock.status.ok() && idas.status.ok())
      << rosenbrock.status.cause << idas.status.cause;
  EXPECT_NEAR(idas.objective / rosenbrock.objective, 1.0, 1e-5);
}

// Gonthier's corners make the sensitivities' error test of idas creep; the LuGre model has none in
// sliding.
TEST(FrictionModels, IdasFindsTheSameGradient) {
  const auto a = rubbing_servo("lugre", kRosenbrock), b = rubbing_servo("lugre", kIdas);
  const Evaluation rosenbrock = evaluator_of(a).evaluate(start_of(*a), true),
                   idas = evaluator_of(b).evaluate(start_of(*b), true);
  ASSERT_TRUE(rosenbrock.status.ok() && idas.status.ok())
      << rosenbrock.status.cause << idas.status.cause;
  for (Eigen::Index k = 0; k < idas.gradient.size(); ++k)
    EXPECT_NEAR(idas.gradient[k], rosenbrock.gradient[k], 1e-3 * std::abs(rosenbrock.gradient[k]))
        << k;
}

INSTANTIATE_TEST_SUITE_P(Models, FrictionLaws, ::testing::Values("gonthier", "lugre"),
                         [](const auto& law) { return std::string(law.param); });

/// A puck that slides and turns on a slope, drawn with its axes along the slope or turned about the
/// normal by the angle whose sine is 0.6.
Evaluation slide(const std::string& model, bool turned) {
  std::string urdf = with_friction_model(puck(), model);
  urdf =
      replaced_all(urdf, "rpy='0 0.6 0'", turned ? "rpy='0 0 0.6435011087932844'" : "rpy='0 0 0'");
  if (turned)
    urdf = replaced_all(urdf, "xyz='0 0.1 0'", "xyz='0.06 0.08 0' rpy='0 0 -0.6435011087932844'");
  const std::string study =
      "duration: 0.3\ngravity: [5.5, 0.0, -8.1]\ninitial_state: {}\ncontrollers: {}\nparameters: "
      "{weight: {initial: 1.0}}\n"
      "objective: {integral: [{signal: puck/velocity/x, weight: \"${weight}\"}, {signal: "
      "slope/friction, weight: 0.01}], terminal: []}\n"
      "solver: {integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-8, "
      "absolute_tolerance: 1.0e-9}\n";
  const auto system = compile(urdf, study);
  return evaluator_of(system).evaluate(start_of(*system), true);
}

TEST_P(FrictionLaws, ThePlaneHasNoDirectionOfItsOwn) {
  const Evaluation plain = slide(GetParam(), false), turned = slide(GetParam(), true);
  ASSERT_TRUE(plain.status.ok() && turned.status.ok()) << plain.status.cause << turned.status.cause;
  EXPECT_NEAR(turned.objective / plain.objective, 1.0, 1e-6);
}

}  // namespace
}  // namespace codesign
