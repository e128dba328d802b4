// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/straight_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace codesign {
namespace {

constexpr int kRows = 40, kArrays = 5;

/// Computes the sums by loops.
void interpret(const std::vector<Sum>& sums, int width, std::vector<double> (&arrays)[kArrays]) {
  const auto number = [&arrays](const Place& place) {
    return arrays[place.array][static_cast<std::size_t>(place.index)];
  };
  const auto row = [&](const Place& place, int k) -> double& {
    return arrays[place.array][static_cast<std::size_t>(width * place.index + k)];
  };
  for (const Sum& sum : sums)
    for (int k = 0; k < width; ++k) {
      double result = sum.start.array < 0 ? 0.0 : row(sum.start, k);
      if (sum.start_scale.array >= 0) result *= number(sum.start_scale);
      for (const Sum::Product& product : sum.products) {
        const double x =
            row(product.row, k) * (product.factor.array < 0 ? 1.0 : number(product.factor));
        result += product.added ? x : -x;
      }
      if (sum.scale.array >= 0) result *= number(sum.scale);
      row(sum.target, k) = sum.reciprocal ? 1.0 / result : result;
    }
}

/// Sums of 0 to 20 products. Their rows are earlier targets (array 0) and given rows (array 1),
/// their factors are in array 2. If `wide`, some products are added and some have no factor.
std::vector<Sum> some_sums(bool wide) {
  std::mt19937 random(7);
  const auto below = [&random](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
  };
  std::vector<Sum> sums;
  for (int target = 1; target < kRows; ++target) {
    Sum sum;
    sum.target = {0, target};
    if (below(4) > 0) sum.start = {1, below(kRows)};
    if (sum.start.array >= 0 && below(2) > 0) sum.start_scale = {2, below(kRows)};
    if (below(3) == 0) sum.scale = {3, below(kRows)};
    for (int k = below(21); k > 0; --k)
      sum.products.push_back(
          {below(2) > 0 ? Place{0, below(target)} : Place{1, below(kRows)}, {2, below(kRows)}});
    for (Sum::Product& product : sum.products) {
      product.added = wide && below(2) > 0;
      if (wide && below(4) == 0) product.factor = {};
    }
    sum.reciprocal = !wide && sum.start.array >= 0 && below(5) == 0;
    sums.push_back(sum);
  }
  return sums;
}

class StraightLineTest : public ::testing::TestWithParam<int> {};

TEST_P(StraightLineTest, ComputesWhatTheLoopsDo) {
  const int width = GetParam();
  const std::vector<Sum> sums = some_sums(width > 1);
  const std::unique_ptr<StraightLine> code = StraightLine::compile(sums, width);
  if (!code) GTEST_SKIP() << "no machine code on this processor";
  std::vector<double> expected[kArrays], actual[kArrays];
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.5, 1.0);
  for (std::vector<double>& array : expected) {
    array.resize(static_cast<std::size_t>(width * kRows));
    for (double& x : array) x = 0.2 * number(random);
  }
  for (int k = 0; k < kArrays; ++k) actual[k] = expected[k];
  interpret(sums, width, expected);
  code->run(
      {actual[0].data(), actual[1].data(), actual[2].data(), actual[3].data(), actual[4].data()});
  for (int k = 0; k < kArrays; ++k)
    for (std::size_t e = 0; e < expected[k].size(); ++e)
      EXPECT_NEAR(actual[k][e], expected[k][e], 1e-12 * (1.0 + std::abs(expected[k][e])))
          << "array " << k << ", number " << e;
}

INSTANTIATE_TEST_SUITE_P(Widths, StraightLineTest, ::testing::Values(1, 4, 8));

TEST(StraightLine, FindsRowsThatLieApart) {
  Sum sum;
  sum.target = {0, 1};
  sum.products = {{{1, 2}, {}, false}, {{1, 1}, {2, 0}, true}};
  StraightLine::RowLayouts layouts;
  layouts.fill({4, 0});
  layouts[1] = {5, 1};
  EXPECT_EQ(StraightLine::compile({sum}, 4, layouts, 100), nullptr) << "too long";
  const std::unique_ptr<StraightLine> code = StraightLine::compile({sum}, 4, layouts, 4096);
  if (!code) GTEST_SKIP() << "no machine code on this processor";
  std::vector<double> to(8, -1.0), from;
  for (int k = 0; k < 15; ++k) from.push_back(k);
  const double factor = 10.0;
  code->run({to.data(), from.data(), &factor});
  EXPECT_EQ(to, (std::vector<double>{-1, -1, -1, -1, 60 - 11, 70 - 12, 80 - 13, 90 - 14}));
}

TEST(StraightLine, MoreCodeThanLoopsWouldNeedIsNotCompiled) {
  Sum sum;
  sum.target = sum.start = {0, 0};
  sum.products.assign(1000000, {{0, 1}, {1, 0}});
  EXPECT_EQ(StraightLine::compile({sum}, 8), nullptr);
}

TEST(LazyStraightLine, AsksForItsSumsOnce) {
  LazyStraightLine lazy;
  int asked = 0;
  const auto sums = [&asked] {
    ++asked;
    return some_sums(false);
  };
  const StraightLine* const code = lazy.get(sums, 4);
  EXPECT_EQ(lazy.get(sums, 4), code);
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace codesign
