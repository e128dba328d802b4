// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/relative_inertia.h"

#include <gtest/gtest.h>

#include "identification/fit/inertial_numbers.h"

namespace codesign {
namespace {

using TenNumbers = RelativeInertia::Ten;

const TenNumbers
    kKnownBody =
        (TenNumbers() << 0.3, -1.5, -1.2, -1.9, 0.05, -0.03, 0.02, 0.1, -0.2, 0.15).finished(),
    kOtherBody =
        (TenNumbers() << -0.4, -2.5, -1.0, -4.0, -0.04, 0.06, 0.01, 0.3, 0.0, -0.05).finished();

TEST(RelativeInertia, IsTheIdentityWhereItIsKnown) {
  const RelativeInertia relative(kKnownBody);
  EXPECT_LT((relative.matrix(kKnownBody) - Eigen::Matrix4d::Identity()).norm(), 1e-14);
  TenNumbers heavier = kKnownBody;
  heavier[0] += 0.5 * std::log(3.0);
  EXPECT_LT((relative.matrix(heavier) - 3.0 * Eigen::Matrix4d::Identity()).norm(), 1e-13)
      << "three times the mass in the same places";
  TenNumbers moved = kKnownBody;
  moved[9] += 0.5 * std::exp(kKnownBody[3]);  // along z, where the factor has its last row
  EXPECT_NEAR(relative.matrix(moved)(2, 3), 0.5, 1e-13);
  EXPECT_NEAR(relative.matrix(moved)(3, 3), 1.0, 1e-13);
}

TEST(RelativeInertia, ItsNumbersAreThoseOfTheBody) {
  const RelativeInertia relative(kKnownBody);
  EXPECT_LT((relative.numbers(relative.matrix(kOtherBody)) - kOtherBody).norm(), 1e-12);
}

TEST(RelativeInertia, InertialNumbersAreLinearInIt) {
  const RelativeInertia relative(kKnownBody);
  const Eigen::Matrix4d at_body = relative.matrix(kOtherBody);
  const TenNumbers middle = relative.numbers(0.25 * Eigen::Matrix4d::Identity() + 0.75 * at_body);
  const TenNumbers mixed =
      0.25 * inertial_numbers(kKnownBody).values + 0.75 * inertial_numbers(kOtherBody).values;
  EXPECT_LT((inertial_numbers(middle).values - mixed).norm(), 1e-13);
}

TEST(RelativeInertia, SlopesAgreeWithDifferences) {
  constexpr double kStep = 1e-6;
  const RelativeInertia relative(kKnownBody);
  const SymmetricNumbers e = symmetric_numbers(relative.matrix(kOtherBody));
  EXPECT_NEAR(e.norm(), relative.matrix(kOtherBody).norm(), 1e-14);
  for (int k = 0; k < 10; ++k) {
    const SymmetricNumbers step = 1e-3 * kStep * SymmetricNumbers::Unit(k);
    const TenNumbers slope = (relative.numbers(symmetric_matrix(e + step)) -
                              relative.numbers(symmetric_matrix(e - step))) /
                             (2e-3 * kStep);
    EXPECT_LT((slope - relative.numbers_by_matrix(kOtherBody).col(k)).norm(), 1e-5 * slope.norm())
        << k;
    TenNumbers up = kOtherBody, down = kOtherBody;
    up[k] += kStep;
    down[k] -= kStep;
    EXPECT_LT(((relative.factor(up) - relative.factor(down)) / (2.0 * kStep) -
               relative.factor_slope(kOtherBody, k))
                  .norm(),
              1e-8)
        << k;
  }
}

}  // namespace
}  // namespace codesign
