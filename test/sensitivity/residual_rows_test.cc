// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/residual_rows.h"

#include "description/study.h"
#include "elements/state_view.h"
#include "integration/rosenbrock_integrator.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kComplexStep = 1e-30;

struct Rooted {
  GradientRun run;
  Eigen::MatrixXd root;
  std::vector<double> steps;
};

Rooted run_with_root(RosenbrockGradient* engine, const CompiledSystem& system) {
  Rooted result;
  result.run.status = engine->start(system.parameters(), Derivatives::kGaussNewton);
  while (result.run.status.ok() && engine->time() < system.study().duration) {
    result.run.status = engine->advance(system.study().duration);
    result.steps.push_back(engine->step_size());
  }
  if (!result.run.status.ok()) return result;
  result.run.objective = engine->objective();
  engine->gradient(&result.run.gradient);
  engine->jacobian_root(&result.root);
  return result;
}

/// The residuals in complex arithmetic: the run with steps of the same sizes, the residuals at each
/// point.
class Replay {
 public:
  explicit Replay(const CompiledSystem& system)
      : integrator_(system), step_(system, integrator_.step().tableau()) {}

  VectorX<Complex> residuals(const std::vector<Complex>& parameters,
                             const std::vector<double>& real, const std::vector<double>& steps) {
    residuals_.clear();
    step_.equations().set_design(parameters);
    integrator_.start(real);
    State<Complex> state;
    integrator_.assembly().extend(parameters, integrator_.initial_state(), &step_.equations(),
                                  &state);
    step_.start(state);
    for (double h : steps) {
      step_.attempt(h);
      step_.accept();
      step_.track_turns();
      for (const double sign : {-1.0, 1.0}) add_point(0.5 + sign / std::sqrt(12.0));
    }
    add(ObjectivePart::kTerminal, step_.state(), 1.0);
    return Eigen::Map<const VectorX<Complex>>(residuals_.data(),
                                              static_cast<Eigen::Index>(residuals_.size()));
  }

 private:
  void add_point(double theta) {
    State<Complex> state;
    Complex psi;
    step_.interpolate(theta, &state, &psi);
    add(ObjectivePart::kIntegral, state, 0.5 * step_.step_size());
  }
  void add(ObjectivePart part, const State<Complex>& state, double factor) {
    VectorX<Complex> residuals;
    step_.equations().residuals(part, state, &residuals);
    for (const Complex& residual : residuals) residuals_.push_back(std::sqrt(factor) * residual);
  }

  RosenbrockIntegrator integrator_;
  OneStep<Complex> step_;
  std::vector<Complex> residuals_;
};

class ResidualRowsTest : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ResidualRowsTest, AreTheComplexStepOfTheResiduals) {
  const GradientCase test = gradient_cases().at(GetParam());
  for (const char* method : {"rodas4", "rodas5p", "dopri5"}) {
    const auto system = test.compile(method, "auto");
    RosenbrockGradient engine(*system);
    const Rooted rooted = run_with_root(&engine, *system);
    ASSERT_TRUE(rooted.run.status.ok()) << rooted.run.status.cause;
    const std::vector<double> parameters = system->parameters();
    const auto count = static_cast<Eigen::Index>(system->study().tuned.size());
    Replay replay(*system);
    Eigen::MatrixXd J;
    Eigen::VectorXd r;
    for (Eigen::Index k = 0; k < count; ++k) {
      std::vector<Complex> perturbed(parameters.begin(), parameters.end());
      perturbed[static_cast<std::size_t>(system->study().tuned[static_cast<std::size_t>(k)])] +=
          Complex(0.0, kComplexStep);
      const VectorX<Complex> residuals = replay.residuals(perturbed, parameters, rooted.steps);
      if (J.size() == 0) J.resize(residuals.size(), count);
      J.col(k) = residuals.imag() / kComplexStep;
      r = residuals.real();
    }
    const Eigen::MatrixXd expected = J.transpose() * J, H = rooted.root.transpose() * rooted.root;
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index k = 0; k < count; ++k)
        EXPECT_NEAR(H(i, k), expected(i, k), 1e-9 * std::sqrt(expected(i, i) * expected(k, k)))
            << method << " " << i << " " << k;
    // The sum of squares of the residuals is the objective, except for the errors of both
    // quadratures.
    EXPECT_NEAR(r.squaredNorm(), rooted.run.objective, 1e-3 * rooted.run.objective) << method;
  }
}

TEST_P(ResidualRowsTest, ChangeNothingElse) {
  const GradientCase test = gradient_cases().at(GetParam());
  const auto system = test.compile("rodas4", "direct");
  RosenbrockGradient with(*system), without(*system), parts(*system, 1);
  const Rooted rooted = run_with_root(&with, *system);
  const GradientRun plain = run_gradient(&without, *system, system->parameters());
  ASSERT_TRUE(rooted.run.status.ok() && plain.status.ok());
  EXPECT_EQ(rooted.run.objective, plain.objective);
  EXPECT_EQ(rooted.run.gradient, plain.gradient);
  EXPECT_EQ(run_with_root(&parts, *system).root, rooted.root)
      << "though gradients alone are in parts";
  EXPECT_EQ(run_gradient(&with, *system, system->parameters()).gradient, plain.gradient)
      << "after a run with rows";
  EXPECT_EQ(run_with_root(&with, *system).root, rooted.root);
}

TEST_P(ResidualRowsTest, AreThoseOfTheOtherIntegrator) {
  const GradientCase test = gradient_cases().at(GetParam());
  Study study = test.study;
  study.solver.relative_tolerance = 1e-7;
  study.solver.absolute_tolerance = 1e-8;
  study.solver.gradient = GradientMethod::kAuto;
  Eigen::MatrixXd H[2];
  for (const IntegratorKind kind : {IntegratorKind::kRosenbrock, IntegratorKind::kIdas}) {
    study.solver.integrator = kind;
    Evaluator evaluator = evaluator_of(make_system(test.robot, study));
    const Evaluation evaluation = evaluator.evaluate_design(
        make_system(test.robot, study)->parameters(), Derivatives::kGaussNewton);
    ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
    H[kind == IntegratorKind::kIdas] =
        evaluation.jacobian_root.transpose() * evaluation.jacobian_root;
  }
  for (Eigen::Index i = 0; i < H[0].rows(); ++i)
    for (Eigen::Index k = 0; k < H[0].cols(); ++k)
      EXPECT_NEAR(H[1](i, k), H[0](i, k), 2e-3 * std::sqrt(H[0](i, i) * H[0](k, k)));
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, ResidualRowsTest,
                         ::testing::Range(std::size_t{0}, gradient_cases().size()),
                         [](const auto& instance) {
                           return gradient_cases().at(instance.param).name;
                         });

/// A block on a smooth rail under a constant force, x = F t^2 / (2 m).
GradientCase block_on_rail(const std::string& integral, const std::string& terminal) {
  return from_texts(
      "block", R"(<robot name="block" xmlns:codesign="urn:mechanism_codesign">
  <link name="ground"/>
  <link name="block"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="block"/><axis xyz="1 0 0"/>
    <limit lower="-50" upper="50" effort="100" velocity="100"/></joint>
</robot>)",
      "duration: 2.0\nloads: [{joint: slide, effort: \"${force}\"}]\n"
      "initial_state: {slide: {position: 0.0, velocity: \"0.0\"}}\n"
      "parameters: {force: {initial: 3.0, lower: -10.0, upper: 10.0}, w: {initial: 0.5, lower: "
      "-1.0, upper: 1.0}}\n"
      "solver: {relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9, maximum_step: 0.05}\n"
      "objective: {integral: [" +
          integral + "], terminal: [" + terminal + "]}\n");
}

TEST(ResidualRows, HaveTheSquaresOfSensitivitiesThatAreKnown) {
  const GradientCase test = block_on_rail("{signal: slide/position, weight: \"${w}\"}",
                                          "{signal: slide/velocity, reference: 1.0, weight: 4}");
  const Evaluation evaluation = evaluator_of(test.compile("rodas5p", "auto"))
                                    .evaluate(Eigen::Vector2d(3.0, 0.5), Derivatives::kGaussNewton);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  const Eigen::MatrixXd H = evaluation.jacobian_root.transpose() * evaluation.jacobian_root;
  // x_F = t^2 / 4, v_F = t / 2, t = 2 s, F = 3 N. By w: r = sqrt(w) x, r_w = x / (2 sqrt(w)).
  const double by_force = 0.5 * (32.0 / 5.0) / 16.0 + 4.0 * 1.0;
  EXPECT_NEAR(H(0, 0), by_force, 1e-6 * by_force);
  EXPECT_NEAR(H(1, 1), 9.0 / 16.0 * (32.0 / 5.0) / (4.0 * 0.5), 1e-5);
  EXPECT_NEAR(H(0, 1), 0.5 * 3.0 / 16.0 * (32.0 / 5.0), 1e-5);
}

TEST(ResidualRows, WeightsOfZeroHaveNone) {
  const GradientCase test = block_on_rail("{signal: slide/position, weight: \"${w}\"}", "");
  const Evaluation evaluation = evaluator_of(test.compile("rodas5p", "auto"))
                                    .evaluate(Eigen::Vector2d(3.0, 0.0), Derivatives::kGaussNewton);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_EQ(evaluation.jacobian_root, Eigen::MatrixXd::Zero(2, 2));
}

TEST(ResidualRows, ANegativeWeightIsNoSumOfSquares) {
  const GradientCase test =
      block_on_rail("{signal: slide/velocity}, {signal: slide/position, weight: \"${w}\"}", "");
  Evaluator evaluator = evaluator_of(test.compile("rodas5p", "auto"));
  const Evaluation evaluation =
      evaluator.evaluate(Eigen::Vector2d(3.0, -0.5), Derivatives::kGaussNewton);
  EXPECT_EQ(evaluation.status.code, StatusCode::kInvalidDesign);
  EXPECT_NE(evaluation.status.cause.find("objective.integral[1] is -0.5"), std::string::npos)
      << evaluation.status.cause;
  EXPECT_TRUE(evaluator.evaluate(Eigen::Vector2d(3.0, -0.5), true).status.ok())
      << "a gradient has nothing against it";
}

TEST(ResidualRows, ASoftBoundHasThoseOfItsSide) {
  const GradientCase test = block_on_rail(
      "{signal: slide/position, reference: 0.75, loss: above}, {signal: "
      "slide/velocity, reference: 1.5, loss: below, weight: 2}",
      "{signal: slide/velocity, reference: 4.0, loss: above}");
  const Evaluation evaluation = evaluator_of(test.compile("rodas5p", "auto"))
                                    .evaluate(Eigen::Vector2d(3.0, 0.5), Derivatives::kGaussNewton);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  // x = 3 t^2 / 4 passes 0.75 at 1 s, and so does v = 3 t / 2 pass 1.5; the end is below 4.
  const double by_force = (32.0 - 1.0) / 5.0 / 16.0 + 2.0 / 3.0 / 4.0;
  EXPECT_NEAR(evaluation.jacobian_root(0, 0), std::sqrt(by_force), 1e-7);
  EXPECT_EQ(evaluation.events.count, 2);
}

TEST(ResidualRows, ALossThatIsNoSquareIsNoSumOfSquares) {
  const GradientCase test =
      block_on_rail("{signal: slide/velocity}", "{signal: slide/position, loss: absolute}");
  Evaluator evaluator = evaluator_of(test.compile("rodas5p", "auto"));
  const Evaluation evaluation =
      evaluator.evaluate(Eigen::Vector2d(3.0, 0.5), Derivatives::kGaussNewton);
  EXPECT_EQ(evaluation.status.code, StatusCode::kInvalidDesign);
  EXPECT_NE(evaluation.status.cause.find("objective.terminal[0] is absolute"), std::string::npos)
      << evaluation.status.cause;
}

TEST(ResidualRows, AStudyThatAsksForTheAdjointHasThem) {
  const GradientCase test = gradient_cases().back();
  const auto adjoint = test.compile("rodas4", "adjoint"), direct = test.compile("rodas4", "direct");
  Evaluator evaluator = evaluator_of(adjoint);
  const Evaluation first = evaluator.evaluate_design(adjoint->parameters(), true);
  const Evaluation a = evaluator.evaluate_design(adjoint->parameters(), Derivatives::kGaussNewton);
  const Evaluation b =
      evaluator_of(direct).evaluate_design(direct->parameters(), Derivatives::kGaussNewton);
  ASSERT_TRUE(a.status.ok() && b.status.ok());
  // Other directions control the steps.
  const Eigen::MatrixXd H = a.jacobian_root.transpose() * a.jacobian_root,
                        expected = b.jacobian_root.transpose() * b.jacobian_root;
  EXPECT_LT((H - expected).norm(), 1e-5 * expected.norm());
  EXPECT_EQ(a.objective, first.objective) << "the same steps as the adjoint";
  EXPECT_EQ(evaluator.evaluate_design(adjoint->parameters(), true).gradient, first.gradient);
}

}  // namespace
}  // namespace codesign
