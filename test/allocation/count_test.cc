// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "allocation/count.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace codesign {
namespace {

TEST(Count, SeesEveryWayToAskForMemory) {
  struct alignas(64) Wide {
    double x[8];
  };
  std::int64_t before = allocations();
  const auto expect_more = [&before](const char* what) {
    EXPECT_GT(allocations(), before) << what;
    before = allocations();
  };
  std::vector<double> numbers(100);
  expect_more("vector");
  Eigen::VectorXd x = Eigen::VectorXd::Zero(50);
  expect_more("Eigen");
  const auto wide = std::make_unique<Wide>();
  expect_more("aligned new");
  numbers.resize(1000);
  expect_more("growth");
  EXPECT_EQ(wide->x[0] + numbers[0] + x[0], wide->x[0]);
}

TEST(Count, NothingIsNothing) {
  Eigen::VectorXd x = Eigen::VectorXd::Ones(50), y = x;
  const std::int64_t before = allocations();
  y += 2.0 * x;
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(y[7], 3.0);
}

}  // namespace
}  // namespace codesign
