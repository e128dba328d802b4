// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/independent_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "description/motion_study.h"

namespace codesign {
namespace {

MotionStudy study_of(const std::vector<codesign::Parameter>& parameters) {
  MotionStudy study;
  study.parameters = parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) study.tuned.push_back(static_cast<int>(k));
  return study;
}

codesign::Parameter between(double lower, double value, double upper) {
  codesign::Parameter parameter;
  parameter.value = value;
  parameter.lower = lower;
  parameter.upper = upper;
  return parameter;
}

Eigen::VectorXd starts(const MotionStudy& study) {
  Eigen::VectorXd rho(study.parameters.size());
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] = study.parameters[k].value;
  return rho;
}

LineDifferences of(const std::function<double(double)>& f, double h, int levels,
                   bool is_two_sided = true) {
  LineDifferences differences(f(0.0), is_two_sided);
  for (int k = 0; k < levels; ++k, h /= LineDifferences::kShrink)
    differences.add(h, f(h), is_two_sided ? f(-h) : 0.0);
  return differences;
}

TEST(CheckedLine, OfOneParameterIsItsAxis) {
  const MotionStudy study = study_of({between(0.0, 5.0, 10.0)});
  const CheckedLine line = checked_line(study, starts(study), Eigen::VectorXd::Constant(1, -3.0));
  EXPECT_DOUBLE_EQ(line.direction[0], 1.0);
  EXPECT_TRUE(line.is_two_sided);
  EXPECT_NEAR(line.first_step, 5.0 / 128.0, 1e-15);
  EXPECT_NEAR(line.per_range, 0.1, 1e-15);
}

TEST(CheckedLine, AddsTermsOfOneSign) {
  const MotionStudy study = study_of({between(0.0, 5.0, 10.0), between(-1e-3, 1e-4, 1e-3),
                                      between(1e5, 2e5, 3e5), between(-1.0, 0.0, 1.0)});
  const Eigen::VectorXd gradient = (Eigen::VectorXd(4) << 2.0, -3e4, 1e-5, 0.0).finished();
  const CheckedLine line = checked_line(study, starts(study), gradient);
  const Eigen::VectorXd terms = line.direction.cwiseProduct(gradient);
  EXPECT_GE(terms.minCoeff(), 0.0);
  // Of parts with c_k from 0.5 to 1.5; that of the third one, 0.2 of the first, counts as much.
  EXPECT_GT(terms.head(3).minCoeff(), terms.maxCoeff() / 3.1);
  EXPECT_NE(line.direction[3], 0.0) << "a derivative that is wrongly zero shows, too";
}

TEST(CheckedLine, LeavesNoBounds) {
  const MotionStudy study = study_of({between(1.0, 1.0, 2.0), between(0.0, 5.0, 5.0)});
  for (const double sign : {-1.0, 1.0}) {
    const CheckedLine line = checked_line(study, starts(study), Eigen::Vector2d(sign, 2.0 * sign));
    EXPECT_FALSE(line.is_two_sided);
    EXPECT_GT(line.first_step, 0.0);
    const Eigen::VectorXd end = starts(study) + line.first_step * line.direction;
    EXPECT_GT(end[0], 1.0);
    EXPECT_LT(end[1], 5.0);
  }
}

TEST(LineDifferences, AreRightWithinTheirError) {
  const auto f = [](double x) { return std::exp(2.0 * x) + std::sin(3.0 * x); };
  for (const bool two_sided : {true, false}) {
    const LineDifferences differences = of(f, 0.01, 4, two_sided);
    EXPECT_NEAR(differences.value(), 5.0, 1e-8);
    EXPECT_LE(std::abs(differences.value() - 5.0), differences.error() + 1e-10);
    EXPECT_LT(differences.error(), 1e-3);
    EXPECT_NEAR(differences.curvature(), 4.0, 0.1);
  }
  EXPECT_FALSE(std::isfinite(of(f, 0.01, 1).error())) << "one level tells no error";
}

TEST(LineDifferences, CountAKinkAsAnError) {
  const LineDifferences differences = of([](double x) { return x > 0.0 ? 3.0 * x : x; }, 0.01, 3);
  EXPECT_NEAR(differences.value(), 2.0, 1e-12);
  EXPECT_NEAR(differences.error(), 1.0, 1e-9) << "the slopes are 1 and 3";
}

// Beside a root singularity quotients with long steps tell nothing of the derivative; short ones
// replace them.
TEST(LineDifferences, TakeShortStepsBesideASingularPoint) {
  const auto f = [](double x) { return std::sqrt(std::abs(x + 1e-4)); };
  const double exact = 0.5 / std::sqrt(1e-4);
  const LineDifferences fine = of(f, 0.01, 8);
  EXPECT_NEAR(fine.value(), exact, 1e-4 * exact);
  EXPECT_LT(fine.error(), 1e-2 * exact);
}

// With steps that are all longer than the distance to the singular point, quotients tell nothing,
// and their last change is no error: the derivative is five times as large.
TEST(LineDifferences, SayThatTheyDiverge) {
  const auto f = [](double x) { return std::sqrt(std::abs(x + 1e-4)); };
  const LineDifferences coarse = of(f, 0.01, 3);
  EXPECT_GT(std::abs(coarse.value() - 50.0), coarse.error());
  EXPECT_TRUE(coarse.diverges());
  EXPECT_FALSE(of(f, 0.01, 8).diverges());
  EXPECT_TRUE(of([](double x) { return std::sqrt(x); }, 0.01, 4, false).diverges());
  for (const bool two_sided : {true, false}) {
    EXPECT_FALSE(of([](double x) { return std::exp(9.0 * x); }, 0.1, 4, two_sided).diverges());
    EXPECT_FALSE(of([](double x) { return std::abs(x); }, 0.1, 4, two_sided).diverges());
    EXPECT_FALSE(of([](double x) { return 1e3 * x * x + x; }, 0.1, 4, two_sided).diverges());
  }
}

TEST(LineDifferences, TakeTheLevelOfLeastRounding) {
  double sign = 1.0;
  const auto f = [&sign](double x) { return x + x * x * x + 1e-9 * (sign = -sign); };
  const LineDifferences differences = of(f, 0.01, 8);
  EXPECT_LE(std::abs(differences.value() - 1.0), differences.error());
  EXPECT_LT(differences.error(), 1e-4);
}

TEST(AllowedDifference, IsRelativeToTheGradientTheObjectiveAndTheCurvature) {
  CheckedLine line;
  line.per_range = 0.1;
  IndependentCheck check;
  check.size = 10.0;
  EXPECT_NEAR(allowed_difference(check, line, 0.0, 0.0), 0.01, 1e-15);
  EXPECT_NEAR(allowed_difference(check, line, 1e4, 0.0), 0.1, 1e-15);
  EXPECT_NEAR(allowed_difference(check, line, 0.0, 1e3), 1.0, 1e-15);
}

}  // namespace
}  // namespace codesign
