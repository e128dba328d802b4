// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/flat_directions.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

const Eigen::MatrixXd kNoRows(3, 0);

TEST(FlatDirections, AProductLeavesTwoOfThree) {
  // r = k a b - 1 at (1, 2, 0.5): J = (1, 0.5, 2).
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(3, 3);
  root.row(0) << 1.0, 0.5, 2.0;
  const Eigen::MatrixXd flat = flat_directions(root, kNoRows, {false, false, false});
  ASSERT_EQ(flat.cols(), 2);
  EXPECT_LT((root * flat).norm(), 1e-14);
  for (int d = 0; d < 2; ++d) EXPECT_EQ(flat.col(d).cwiseAbs().maxCoeff(), 1.0);
  EXPECT_EQ((flat.array() == 1.0).rowwise().any().count(), 2) << "each direction has a parameter of its own";
}

TEST(FlatDirections, CurvatureAboveTheLimitIsNone) {
  Eigen::MatrixXd root = Eigen::Vector3d(1.0, 1e-3, 2e-4).asDiagonal();
  EXPECT_EQ(flat_directions(root, kNoRows, {false, false, false}).cols(), 0);
  root(2, 2) = 0.5e-4;
  EXPECT_EQ(flat_directions(root, kNoRows, {false, false, false}), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(flat_directions(root, kNoRows, {false, false, true}).cols(), 0) << "held";
  EXPECT_EQ(flat_directions(root, Eigen::Vector3d(0.0, 0.0, 1e-6), {false, false, false}).cols(), 0) << "an active constraint";
}

}  // namespace
}  // namespace codesign
