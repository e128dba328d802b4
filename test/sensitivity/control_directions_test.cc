// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/control_directions.h"

#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

std::shared_ptr<const CompiledSystem> chain(int tuned, const std::string& gradient) {
  const GeneratedCase made = parametric_chain(6, tuned);
  GradientCase test = from_texts("chain", made.urdf.text, made.study.text);
  test.study.duration = 0.1;
  return test.compile("auto", gradient);
}

TEST(ControlDirections, AreTheParametersUpToEight) {
  for (const int count : {1, 4, 8})
    EXPECT_EQ(control_directions(*chain(count, "auto")), Eigen::MatrixXd::Identity(count, count));
}

TEST(ControlDirections, AreEightCombinationsOfMoreAndTwoForTheAdjoint) {
  const Eigen::MatrixXd direct = control_directions(*chain(9, "direct")),
                        adjoint = control_directions(*chain(9, "auto")),
                        few = control_directions(*chain(3, "adjoint"));
  EXPECT_EQ(direct.cols(), 8);
  EXPECT_EQ(adjoint.cols(), 2);
  EXPECT_EQ(few.rows(), 3);
  EXPECT_EQ(few.cols(), 2);
  EXPECT_EQ(direct, control_directions(*chain(9, "direct"))) << "fixed";
  EXPECT_EQ((direct.array() == 0.0).count(), 0) << "each parameter is in each of them";
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(direct).rank(), 8);
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(adjoint).rank(), 2);
}

// In units of the ranges.
TEST(ControlDirections, HaveTheSizeOfTheRanges) {
  const auto system = chain(9, "direct");
  const Eigen::MatrixXd directions = control_directions(*system);
  for (int k = 0; k < 9; ++k) {
    const auto& p = system->study().parameters[static_cast<std::size_t>(
        system->study().tuned[static_cast<std::size_t>(k)])];
    const double range = p.upper - p.lower;
    EXPECT_GE(directions.row(k).cwiseAbs().minCoeff(), 0.5 * range);
    EXPECT_LE(directions.row(k).cwiseAbs().maxCoeff(), 1.5 * range);
  }
}

TEST(ControlDirections, GiveDirectAndAdjointGradientsTheSameSteps) {
  for (const auto& system : {chain(9, "auto"), chain(12, "direct"), chain(3, "adjoint")}) {
    RosenbrockGradient direct(*system);
    AdjointGradient adjoint(*system);
    const GradientRun a = run_gradient(&direct, *system, system->parameters()),
                      b = run_gradient(&adjoint, *system, system->parameters());
    ASSERT_TRUE(a.status.ok() && b.status.ok());
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.objective, b.objective);
    EXPECT_LT((a.gradient - b.gradient).norm(), 1e-10 * a.gradient.norm());
  }
}

}  // namespace
}  // namespace codesign
