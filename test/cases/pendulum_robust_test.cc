// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

#include "cases/shipped.h"
#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {
namespace {

/// The case with other numbers in its study, each `pattern` replaced.
Problem pendulum_with(const std::vector<std::pair<std::string, std::string>>& changes,
                      const ParameterSettings& settings = {}) {
  return shipped_problem("pendulum_robust", changes, settings);
}

double worst_of(const Ensemble& ensemble, const Eigen::Vector3d& gains) {
  return ensemble.evaluate(gains, false).total.objective;
}

TEST(PendulumRobust, AtTheNominalCoefficientItIsTheShippedPendulum) {
  const std::vector<std::pair<std::string, std::string>> exact = {
      {"relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7",
       "relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11"},
      {"samples: 32", "samples: 1"}};
  const Ensemble robust(pendulum_with(exact));
  EXPECT_NEAR(worst_of(robust, {750.0, 200.0, 10.0}) / 8249.6225551550, 1.0, 1e-8);
  const Ensemble smooth(pendulum_with(exact, {{"mu_static", 0.0}}));
  EXPECT_NEAR(worst_of(smooth, {750.0, 200.0, 10.0}) / 14494.3670139029, 1.0, 1e-8);
}

TEST(PendulumRobust, SamplesCoverBothLawsAndAllCoefficients) {
  int gonthier = 0;
  double least = 1.0, most = 0.0;
  for (const Scenario& scenario : make_scenarios(pendulum_with({}))) {
    gonthier += scenario.friction_law == "gonthier";
    least = std::min(least, scenario.values.at(0).second);
    most = std::max(most, scenario.values.at(0).second);
  }
  EXPECT_EQ(gonthier, 18) << "with the corners";
  EXPECT_LT(least, 0.02);
  EXPECT_GT(most, 0.48);
}

// doc/case_studies.md has the numbers for 1000 fresh samples.
TEST(PendulumRobust, TheWorstCaseOnFreshSamplesIsBetterThanThatOfTheNominalGains) {
  const Problem problem = pendulum_with({{"validate: 1000", "validate: 100"}});
  const OptimizationResult robust = optimize(problem);
  ASSERT_TRUE(robust.status.ok()) << robust.status.cause;
  EXPECT_LE(robust.best.objective, 3751.0);
  const Eigen::Vector3d gains(579.35, 787.73, 98.47);
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_NEAR(robust.best.rho[k], gains[k], 0.01 * gains[k]) << k;
  const OptimizationResult nominal =
      optimize(pendulum_with({{"validate: 1000", "validate: 100"}, {"samples: 32", "samples: 1"}}));
  ASSERT_TRUE(robust.ensemble.validation && nominal.ensemble.validation);
  EXPECT_EQ(robust.ensemble.validation->failed + nominal.ensemble.validation->failed, 0);
  EXPECT_LT(robust.ensemble.validation->worst, nominal.ensemble.validation->worst);
  EXPECT_GT(nominal.ensemble.validation->worst, 1.1 * nominal.ensemble.validation->promised);
  EXPECT_LE(robust.ensemble.validation->worst, robust.ensemble.validation->promised);
}

}  // namespace
}  // namespace codesign
