// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/inertial_numbers.h"

#include <gtest/gtest.h>

#include "mechanism/mass_properties.h"

namespace codesign {
namespace {

const Eigen::Matrix<double, 10, 1> kBody =
    (Eigen::Matrix<double, 10, 1>() << 0.3, -1.5, -1.2, -1.9, 0.05, -0.03, 0.02, 0.1, -0.2, 0.15)
        .finished();

TEST(InertialNumbers, AreThoseOfTheBody) {
  std::array<double, 10> numbers;
  for (int k = 0; k < 10; ++k) numbers[static_cast<std::size_t>(k)] = kBody[k];
  const MassProperties<double> body = properties_of(numbers);
  const auto values = inertial_numbers(kBody).values;
  EXPECT_NEAR(values[0], body.mass, 1e-12);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(values[1 + k], body.mass * body.centre[k], 1e-12);
  const double x = body.centre[0], y = body.centre[1], z = body.centre[2];
  EXPECT_NEAR(values[4], body.inertia(0, 0) + body.mass * (y * y + z * z), 1e-12);
  EXPECT_NEAR(values[5], body.inertia(1, 1) + body.mass * (x * x + z * z), 1e-12);
  EXPECT_NEAR(values[7], body.inertia(0, 1) - body.mass * x * y, 1e-12);
  EXPECT_NEAR(values[8], body.inertia(1, 2) - body.mass * y * z, 1e-12);
  EXPECT_NEAR(values[9], body.inertia(0, 2) - body.mass * x * z, 1e-12);
}

TEST(InertialNumbers, DerivativesAgreeWithDifferences) {
  constexpr double kStep = 1e-6;
  const InertialNumbers here = inertial_numbers(kBody);
  for (int k = 0; k < 10; ++k) {
    Eigen::Matrix<double, 10, 1> step = Eigen::Matrix<double, 10, 1>::Zero();
    step[k] = kStep;
    const Eigen::Matrix<double, 10, 1> slope =
        (inertial_numbers(kBody + step).values - inertial_numbers(kBody - step).values) /
        (2.0 * kStep);
    EXPECT_LT((slope - here.derivatives.col(k)).norm(), 1e-8) << k;
  }
}

TEST(InertialNumbers, OnlyWholeFreeInertiasAreChanged) {
  std::vector<std::string> names = {"viscous"};
  Eigen::VectorXd x(11);
  x << 0.4, kBody;
  for (const char* name : kLogCholeskyNames) names.push_back(std::string("bar_") + name);
  const Eigen::MatrixXd by_numbers = Eigen::MatrixXd::Random(30, 11);
  Eigen::MatrixXd jacobian = by_numbers;
  jacobian.rightCols(10) = by_numbers.rightCols(10) * inertial_numbers(kBody).derivatives;
  const LinearNumbers changed = with_inertial_numbers(names, x, jacobian);
  EXPECT_TRUE(changed.is_changed);
  EXPECT_EQ(changed.names[1], "bar_m");
  EXPECT_LT((changed.jacobian - by_numbers).norm(), 1e-8);
  names[3] = "bar_other";
  EXPECT_FALSE(with_inertial_numbers(names, x, jacobian).is_changed);
}

}  // namespace
}  // namespace codesign
