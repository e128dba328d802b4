// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "description/solver_names.h"
#include "description/study.h"
#include "description/tuned_parameters.h"
#include "mechanism_codesign/gradient.h"
#include "paths.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/idas_gradient.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

// Lanes are evaluated in groups of eight and four.
TEST(GradientCost, GrowsByGroups) {
  EXPECT_EQ(direct_cost(1), direct_cost(4));
  EXPECT_LT(direct_cost(4), direct_cost(5));
  EXPECT_EQ(direct_cost(5), direct_cost(8));
  EXPECT_LT(direct_cost(8), direct_cost(9));
}

TEST(GradientCost, TheAdjointHasToEarnItsWayBack) {
  EXPECT_LT(direct_cost(8), kAdjointCost);
  EXPECT_LT(kAdjointCost, direct_cost(16));
}

const char* const kEngineRosenbrock =
    "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: "
    "1.0e-10}";

std::string idas(const std::string& tolerance) {
  return "{integrator: idas, relative_tolerance: " + tolerance +
         ", absolute_tolerance: " + tolerance + "}";
}

TEST(GradientEngine, TheStudyChooses) {
  EXPECT_NE(dynamic_cast<RosenbrockGradient*>(make_gradient_engine(*servo("{}")).get()), nullptr);
  EXPECT_NE(dynamic_cast<IdasGradient*>(make_gradient_engine(*servo("{integrator: idas}")).get()),
            nullptr);
}

// An extra state, terminal terms with accelerations, friction, a parameter in the initial state and
// one in the objective alone.
TEST(GradientEngine, TheStudyChoosesTheDirection) {
  EXPECT_NE(
      dynamic_cast<AdjointGradient*>(make_gradient_engine(*servo("{gradient: adjoint}")).get()),
      nullptr);
  EXPECT_NE(
      dynamic_cast<RosenbrockGradient*>(make_gradient_engine(*servo("{gradient: direct}")).get()),
      nullptr);
  EXPECT_FALSE(prefers_adjoint(*servo("{integrator: idas}")));
}

// gradient: auto chooses direct sensitivities for few parameters and the adjoint for many.
TEST(GradientEngine, ManyLocalParametersGoBackwards) {
  const auto prefers = [](int tuned) {
    const GeneratedCase chain = parametric_chain(12, tuned);
    const GradientCase test = from_texts("chain", chain.urdf.text, chain.study.text);
    return prefers_adjoint(*test.compile("rodas4", "auto"));
  };
  EXPECT_FALSE(prefers(8));
  EXPECT_TRUE(prefers(9));
  EXPECT_TRUE(prefers(48));
}

// Trees of some size are differentiated by a program of their own, which knows the kinks, too.
TEST(GradientEngine, LossesOfALargeTree) {
  const GeneratedCase chain = parametric_chain(12, 6);
  GradientCase test = from_texts("chain", chain.urdf.text, chain.study.text);
  test.study.duration = 0.2;
  test.study.solver.coordinates = CoordinatesKind::kJoint;
  test.study.integral.resize(1);
  for (const LossKind& loss : losses()) {
    ObjectiveTerm term = test.study.integral.front();
    term.reference = -0.1;
    term.scale = 0.05;
    term.loss = loss;
    test.study.integral.push_back(term);
  }
  for (const char* gradient : {"direct", "adjoint"}) {
    const auto system = test.compile("rodas4", gradient);
    const GradientCheck check =
        check_gradient(system, start_of(system->study()), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-10) << gradient;
    EXPECT_GE(check.evaluation.events.count, 3) << gradient;
  }
}

TEST(GradientEngine, TheIntegratorsAgreeToTheToleranceAskedFor) {
  const auto exact = servo(kEngineRosenbrock);
  const GradientRun reference =
      run_gradient(make_gradient_engine(*exact).get(), *exact, exact->parameters());
  ASSERT_TRUE(reference.status.ok()) << reference.status.cause;
  const double scale = reference.gradient.cwiseAbs().maxCoeff();
  for (const auto& [tolerance, bound] :
       {std::pair{"1.0e-5", 2e-3}, std::pair{"1.0e-7", 5e-5}, std::pair{"1.0e-9", 1e-6}}) {
    const auto system = servo(idas(tolerance));
    const GradientRun result =
        run_gradient(make_gradient_engine(*system).get(), *system, system->parameters());
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_NEAR(result.objective, reference.objective, bound * reference.objective) << tolerance;
    EXPECT_LT((result.gradient - reference.gradient).cwiseAbs().maxCoeff(), bound * scale)
        << tolerance;
  }
}

TEST(GradientEngine, IdasStartsAnewToTheLastBitWithAndWithoutGradient) {
  const auto system = servo(idas("1.0e-6"));
  const auto engine = make_gradient_engine(*system);
  const GradientRun first = run_gradient(engine.get(), *system, system->parameters()),
                    alone = run_gradient(engine.get(), *system, system->parameters(), false);
  const GradientRun second = run_gradient(engine.get(), *system, system->parameters()),
                    alone_again = run_gradient(engine.get(), *system, system->parameters(), false);
  ASSERT_TRUE(first.status.ok() && alone.status.ok());
  EXPECT_EQ(first.objective, second.objective);
  EXPECT_EQ(first.gradient, second.gradient);
  EXPECT_EQ(first.steps, second.steps);
  EXPECT_EQ(alone.objective, alone_again.objective);
  EXPECT_EQ(alone.gradient.size(), 0);
  EXPECT_NEAR(alone.objective, first.objective, 1e-3 * first.objective);
}

TEST(GradientEngine, NothingTunedIsNoGradient) {
  const auto system = compile(pendulum(),
                              "duration: 0.1\nparameters: {}\nobjective: {integral: [{signal: "
                              "hinge/velocity}]}\nsolver: {integrator: idas}\n");
  const GradientRun result = run_gradient(make_gradient_engine(*system).get(), *system, {});
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.gradient.size(), 0);
}

TEST(GradientEngine, ACancelledEvaluationCanBeRepeated) {
  const std::atomic<bool> cancel{true};
  const auto system = servo("{gradient: adjoint}");
  Evaluator evaluator = evaluator_of(system);
  Eigen::VectorXd rho(static_cast<Eigen::Index>(system->study().tuned.size()));
  for (Eigen::Index k = 0; k < rho.size(); ++k)
    rho[k] = system->parameters()[static_cast<std::size_t>(
        system->study().tuned[static_cast<std::size_t>(k)])];
  EXPECT_EQ(evaluator.evaluate(rho, true, &cancel).status.code, StatusCode::kCancelled);
  EXPECT_TRUE(evaluator.evaluate(rho, true).status.ok());
}

struct Case {
  RobotDescription robot;
  Study study;
  Eigen::VectorXd rho;
};

Case shipped(const std::string& name) {
  const std::string root = source_dir();
  Case c;
  c.robot = read_urdf(read_source(root + "/urdf/" + name + ".urdf"));
  c.study = read_study(read_source(root + "/config/" + name + ".yaml"), c.robot);
  c.rho.resize(static_cast<Eigen::Index>(c.study.tuned.size()));
  for (std::size_t k = 0; k < c.study.tuned.size(); ++k)
    c.rho[static_cast<Eigen::Index>(k)] =
        c.study.parameters[static_cast<std::size_t>(c.study.tuned[k])].value;
  return c;
}

/// References: an independent solution of the same data by other formulations and tolerances down
/// to 1e-12.
void expect_reference(const std::string& name, const std::string& integrator, double objective,
                      const std::vector<double>& gradient) {
  Case c = shipped(name);
  c.study.solver.integrator = integrator_named(integrator);
  const Evaluation evaluation = evaluator_of(make_system(c.robot, c.study)).evaluate(c.rho, true);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_NEAR(evaluation.objective, objective, 1e-7 * objective);
  ASSERT_EQ(static_cast<std::size_t>(evaluation.gradient.size()), gradient.size());
  for (std::size_t k = 0; k < gradient.size(); ++k)
    EXPECT_NEAR(evaluation.gradient[static_cast<Eigen::Index>(k)], gradient[k],
                1e-5 * std::abs(gradient[k]))
        << k;
}

TEST(Evaluation, SliderCrankMeetsTheReference) {
  for (const char* integrator : {"rosenbrock", "idas"})
    expect_reference("slider_crank", integrator, 0.05925272691,
                     {1.674310, 0.0386376, 0.895474, 3.578859, -0.1185753});
}

TEST(Evaluation, HaugsSliderCrankMeetsTheReference) {
  for (const char* integrator : {"rosenbrock", "idas"})
    expect_reference("slider_crank_haug", integrator, 0.717975196477,
                     {32.0105032, -15.462857, -0.0754624, -0.3394216, -1.0274846});
}

TEST(Evaluation, TangentIsExactForEveryMethod) {
  for (const char* method : {"rodas4", "rodas4p2", "rodas5p", "dopri5"}) {
    Case c = shipped("slider_crank");
    c.study.solver.method = method_named(method);
    c.study.solver.relative_tolerance = 1e-5;
    c.study.solver.absolute_tolerance = 1e-6;
    c.study.duration = 0.4;
    const GradientCheck check =
        check_gradient(make_system(c.robot, c.study), c.rho, CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-10) << method;
  }
}

TEST(Evaluation, RiddersDifferencesAgree) {
  Case c = shipped("slider_crank");
  c.study.duration = 0.3;
  const GradientCheck check =
      check_gradient(make_system(c.robot, c.study), c.rho, CheckMethod::kRidders);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-4);
}

// With idas every check is by Ridders' differences of the other integrator, since there is no
// complex step through IDAS.
TEST(Evaluation, AGradientByIdasIsCheckedByTheOtherIntegrator) {
  Case c = shipped("slider_crank");
  c.study.duration = 0.3;
  c.study.solver.integrator = IntegratorKind::kIdas;
  for (CheckMethod method : {CheckMethod::kComplexStep, CheckMethod::kRidders}) {
    const GradientCheck check = check_gradient(make_system(c.robot, c.study), c.rho, method);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_EQ(check.method, CheckMethod::kRidders);
    EXPECT_GT(check.largest_relative_difference, 0.0);
    EXPECT_LT(check.largest_relative_difference, 1e-5);
  }
}

// A rod too short for a whole turn: the crank stops, held by friction, and the mechanism stays
// there.
TEST(Evaluation, AJammedDesignHasTheSameValueWithBothIntegrators) {
  double objective[2];
  for (int k = 0; k < 2; ++k) {
    Case c = shipped("slider_crank_haug");
    c.study.solver.integrator = k ? IntegratorKind::kIdas : IntegratorKind::kRosenbrock;
    c.rho[1] = 0.24;
    const Evaluation evaluation =
        evaluator_of(make_system(c.robot, c.study)).evaluate(c.rho, false);
    ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
    objective[k] = evaluation.objective;
  }
  EXPECT_GT(objective[0], 100.0);
  EXPECT_NEAR(objective[0], objective[1], 1e-6 * objective[0]);
}

void expect_failures_are_statuses(const std::string& integrator) {
  Case c = shipped("slider_crank_haug");
  c.study.duration = 0.02;
  c.study.solver.integrator = integrator_named(integrator);
  Evaluator evaluator = evaluator_of(make_system(c.robot, c.study));
  Eigen::VectorXd rho = c.rho;
  // The rod does not reach the slider's rail.
  rho[1] = 0.05;
  const Evaluation impossible = evaluator.evaluate(rho, true);
  EXPECT_EQ(impossible.status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(impossible.status.cause.find("slider_pin"), std::string::npos);
  // Impossible friction geometry.
  rho = c.rho;
  rho[2] = -0.05;
  EXPECT_EQ(evaluator.evaluate(rho, false).status.code, StatusCode::kInvalidDesign);
  const std::atomic<bool> cancelled{true};
  EXPECT_EQ(evaluator.evaluate(c.rho, false, &cancelled).status.code, StatusCode::kCancelled);
  // The workspace can be used again afterwards.
  EXPECT_TRUE(evaluator.evaluate(c.rho, true).status.ok());
}

TEST(Evaluation, FailuresAreStatuses) {
  for (const char* integrator : {"rosenbrock", "idas"}) expect_failures_are_statuses(integrator);
}

}  // namespace

}  // namespace codesign
