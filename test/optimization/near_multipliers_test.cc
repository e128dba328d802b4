// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "optimization/near_multipliers.h"

namespace codesign {
namespace {

using Eigen::Index;

constexpr double kDigits = 1e-6;  // of |g|: where many rows are near, rounding leaves that

/// Random rows by the first variables and some others, with distances from `nearest` on, bounds and
/// one equality.
class Rows {
 public:
  Rows(Index leading, Index slacks, int count, double nearest, unsigned seed) : random_(seed) {
    const Index size = leading + slacks;
    gradient = Eigen::VectorXd::NullaryExpr(size, [this] { return normal_(random_); });
    for (int k = 0; k < count; ++k) {
      Holder row = random_row(leading);
      if (slacks > 0 && k % 3 != 0) row.others.emplace_back(leading + k % slacks, 1.0);
      row.distance = nearest * std::pow(10.0, 3.0 * std::abs(normal_(random_)));
      holders.push_back(row);
    }
    Holder equality = random_row(leading);
    equality.any_sign = true;
    holders.push_back(equality);
    for (Index i = 0; i < size; ++i) {
      Holder bound;
      bound.others.emplace_back(i, i % 2 == 0 ? 1.0 : -1.0);
      bound.is_bound = true;
      bound.distance = i % 3 == 0 ? 0.0 : std::abs(normal_(random_));
      holders.push_back(bound);
    }
  }

  Eigen::VectorXd direction(std::size_t k) const {
    Eigen::VectorXd a = Eigen::VectorXd::Zero(gradient.size());
    a.head(holders[k].leading.size()) = holders[k].leading;
    for (const auto& [variable, entry] : holders[k].others) a[variable] = entry;
    return a;
  }

  Eigen::VectorXd gradient;
  std::vector<Holder> holders;

 private:
  Holder random_row(Index leading) {
    Holder row;
    row.leading = Eigen::VectorXd::NullaryExpr(leading, [this] { return normal_(random_); });
    return row;
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

/// The conditions of the minimum: c_k >= 0, and the slope along c_k is zero, or positive where c_k
/// = 0.
void expect_least(const Rows& rows, const Multipliers& found, double tolerance) {
  const double size = rows.gradient.norm();
  Eigen::VectorXd rest = rows.gradient;
  double sum = 0.0;
  for (std::size_t k = 0; k < rows.holders.size(); ++k) {
    const double c = found.values[static_cast<Index>(k)], product = c * rows.holders[k].distance;
    rest -= c * rows.direction(k);
    sum += product * product;
  }
  EXPECT_LT((rest - found.rest).norm(), 1e-12 * size);
  EXPECT_NEAR(found.residual, std::sqrt(rest.squaredNorm() + sum), 1e-12 * size);
  for (std::size_t k = 0; k < rows.holders.size(); ++k) {
    const double c = found.values[static_cast<Index>(k)], d = rows.holders[k].distance;
    const Eigen::VectorXd a = rows.direction(k);
    const double slope = (c * d * d - a.dot(rest)) / (a.norm() * size);
    if (!rows.holders[k].any_sign) {
      EXPECT_GE(c, 0.0) << k;
    }
    EXPECT_GE(slope, -tolerance) << k;
    if (c != 0.0) {
      EXPECT_LE(slope, tolerance) << k;
    }
  }
}

TEST(Multipliers, MeetTheConditionsOfTheMinimum) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double nearest : {1e-12, 1e-7, 1e-4, 1.0}) {
      const Rows rows(4, seed % 2 == 0 ? 0 : 6, 60, nearest, seed);
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", nearest " << nearest);
      expect_least(rows, least_multipliers(rows.gradient, rows.holders, nullptr), kDigits);
    }
}

// The work of Lawson and Hanson alone, one multiplier after the other, would be some thousand
// matrices with a column for each.
TEST(Multipliers, OfManyRowsTakeFewMatricesOfTheVariables) {
  const Rows rows(4, 33, 20000, 0.1, 1);
  const Multipliers found = least_multipliers(rows.gradient, rows.holders, nullptr);
  expect_least(rows, found, kDigits);
  EXPECT_GT((found.values.array() > 0.0).count(), 3000);
  EXPECT_LT(found.factorizations, 100);
}

// Rows of an unstable start, all of which are near by the length of their directions.
TEST(Multipliers, OfManyNearRowsTakeFewMatrices) {
  Rows rows(4, 0, 3000, 0.1, 2);
  for (Holder& holder : rows.holders)
    if (!holder.is_bound) holder.leading *= 1e9;
  const Multipliers found = least_multipliers(rows.gradient, rows.holders, nullptr);
  EXPECT_LT(found.factorizations, 100);
  EXPECT_LE(found.residual, rows.gradient.norm());
}

TEST(Multipliers, ACancelEndsThemWithTheirSigns) {
  const Rows rows(4, 10, 2000, 0.1, 3);
  const std::atomic<bool> cancel{true};
  const Multipliers found = least_multipliers(rows.gradient, rows.holders, &cancel);
  EXPECT_LE(found.factorizations, 3);
  for (std::size_t k = 0; k < rows.holders.size(); ++k)
    if (!rows.holders[k].any_sign) {
      EXPECT_GE(found.values[static_cast<Index>(k)], 0.0);
    }
  EXPECT_LE(found.residual, rows.gradient.norm() * (1.0 + 1e-12));
}

}  // namespace

}  // namespace codesign
