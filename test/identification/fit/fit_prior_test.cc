// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/fit_prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace codesign {
namespace {

using TenOfPrior = RelativeInertia::Ten;

const TenOfPrior kBefore =
    (TenOfPrior() << 0.3, -1.5, -1.2, -1.9, 0.05, -0.03, 0.02, 0.1, -0.2, 0.15).finished();

/// A variable with a prior of its own, then the ten numbers of a body.
FitPrior weak_and_stated(double mass, double centre, double moments) {
  FitPrior prior;
  prior.deviations = prior.known =
      Eigen::VectorXd::Constant(11, std::numeric_limits<double>::infinity());
  prior.known << 2.0, kBefore;
  prior.deviations[0] = 0.5;
  prior.inertias.push_back(
      {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, RelativeInertia(kBefore), 0.05, mass, centre, moments});
  return prior;
}

Eigen::VectorXd with_body(double variable, const TenOfPrior& shift) {
  Eigen::VectorXd x(11);
  x << variable, kBefore + shift;
  return x;
}

TEST(FitPrior, IsTheDivergenceOfTheInertia) {
  const double none = std::numeric_limits<double>::infinity();
  const FitPrior weak = weak_and_stated(none, none, none);
  EXPECT_NEAR(weak.cost(with_body(2.0, TenOfPrior::Zero())), 0.0, 1e-20);
  EXPECT_NEAR(weak.cost(with_body(3.0, TenOfPrior::Zero())), 4.0, 1e-12);
  for (const double size : {1e-5, 1e-3, 0.1, 1.0}) {
    const TenOfPrior shift =
        size * (TenOfPrior() << 1.0, -2.0, 0.5, 3.0, 0.1, -0.2, 0.05, 0.3, 0.1, -0.2).finished();
    const Eigen::Matrix4d E = weak.inertias[0].relative.matrix(kBefore + shift);
    const double divergence = E.trace() - std::log(E.determinant()) - 4.0;
    EXPECT_NEAR(weak.cost(with_body(2.0, shift)), 0.05 * divergence, 1e-9 * divergence + 1e-15)
        << size;
  }
}

TEST(FitPrior, CountsWhatIsStatedOfMassCentreAndMoments) {
  TenOfPrior heavier = TenOfPrior::Zero();
  heavier[0] = 0.5 * std::log(1.2);  // moments grow with the mass
  const double weak = weak_and_stated(1e9, 1e9, 1e9).cost(with_body(2.0, heavier));
  EXPECT_NEAR(weak_and_stated(0.1, 1e9, 1e9).cost(with_body(2.0, heavier)) - weak, 4.0, 1e-9);
  EXPECT_NEAR(weak_and_stated(1e9, 1e9, 0.1).cost(with_body(2.0, heavier)) - weak, 12.0, 1e-9);
  TenOfPrior moved = TenOfPrior::Zero();
  moved.tail<3>() << 0.5 * kBefore[6], 0.5 * kBefore[5], 0.5 * std::exp(kBefore[3]);
  EXPECT_NEAR(weak_and_stated(1e9, 0.1, 1e9).cost(with_body(2.0, moved)) -
                  weak_and_stated(1e9, 1e9, 1e9).cost(with_body(2.0, moved)),
              25.0, 1e-9);
}

TEST(FitPrior, SlopesAgreeWithDifferences) {
  constexpr double kStep = 1e-6;
  const FitPrior all = weak_and_stated(0.3, 0.5, 0.7);
  for (const double size : {0.0, 1e-4, 0.5}) {
    const Eigen::VectorXd x = with_body(
        2.3,
        size * (TenOfPrior() << 1.0, -2.0, 0.5, 3.0, 0.1, -0.2, 0.05, 0.3, 0.1, -0.2).finished());
    const Eigen::MatrixXd slopes = all.jacobian(x);
    for (int k = 0; k < 11; ++k) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(11, k);
      EXPECT_LT(((all.rows(x + step) - all.rows(x - step)) / (2.0 * kStep) - slopes.col(k)).norm(),
                1e-6)
          << k << " at " << size;
    }
  }
}

}  // namespace
}  // namespace codesign
