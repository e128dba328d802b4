// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/parameter_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const std::string kConstraints =
    "constraints: [\"Kp*sqrt(mass) >= Kd**2/5\", {expression: \"${Kp + Kd}\", between: [10, "
    "100]}]\n"
    "runs: {light: {set: {mass: 1}}, heavy: {set: {mass: 4}}, also_heavy: {set: {mass: 4}, weight: "
    "2}}\n";

TEST(ParameterRows, DifferWhereRunsChangeWhatTheyRead) {
  const Problem problem = block(kConstraints);
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  const ParameterRows rows(study_of(problem), scenarios);
  ASSERT_EQ(rows.rows().size(), 4U)
      << "two masses of the first constraint, one row each of the others";
  const Eigen::VectorXd rho = Eigen::Vector2d(20.0, 5.0);
  EXPECT_DOUBLE_EQ(rows.margin(rows.rows()[0], rho, nullptr), 20.0 - 5.0);
  EXPECT_DOUBLE_EQ(rows.margin(rows.rows()[1], rho, nullptr), 40.0 - 5.0);
  EXPECT_EQ(rows.margins(rho), Eigen::Vector3d(15.0, 15.0, 75.0)) << "the smallest of each";
}

TEST(ParameterRows, DerivativesMeetTheComplexStep) {
  const Problem problem = block(kConstraints);
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  const ParameterRows rows(study_of(problem), scenarios);
  const Eigen::VectorXd rho = Eigen::Vector2d(17.0, 3.0);
  for (const ParameterRows::Row& row : rows.rows()) {
    Eigen::VectorXd by_rho;
    rows.margin(row, rho, &by_rho);
    ASSERT_EQ(by_rho.size(), 2);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::vector<double> parameters = scenarios[row.scenario].parameters(rho);
      std::vector<std::complex<double>> moved(parameters.begin(), parameters.end());
      moved[static_cast<std::size_t>(study_of(problem).tuned[k])] +=
          std::complex<double>(0.0, 1e-30);
      const double reference =
          study_of(problem).constraints[row.constraint].margin->value(moved).imag() / 1e-30;
      EXPECT_NEAR(by_rho[static_cast<Eigen::Index>(k)], reference, 1e-12 * std::abs(reference));
    }
  }
  Eigen::VectorXd by_rho;
  rows.margin(rows.rows()[0], rho, &by_rho);
  EXPECT_NEAR(by_rho[0], 1.0, 1e-14) << "sqrt(mass)";
  EXPECT_NEAR(by_rho[1], -2.0 * 3.0 / 5.0, 1e-14);
}

TEST(ParameterRows, AMarginThatIsNoNumberIsNamedWithItsRun) {
  const Problem problem = block(
      "constraints: [\"sqrt(3 - mass)*Kp >= 0\"]\nruns: {light: {}, heavy: {set: {mass: 4}}}\n");
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  const ParameterRows rows(study_of(problem), scenarios);
  EXPECT_TRUE(std::isnan(rows.margins(problem.start())[0]));
  try {
    rows.require_numbers_at(problem.start());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not a number at the start in run \"heavy\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace codesign
