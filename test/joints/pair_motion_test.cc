// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/pair_motion.h"

#include <gtest/gtest.h>

#include "joints/two_bodies.h"

namespace codesign {
namespace {

TEST(PairMotion, SharedVectorsMoveAsTheirOwn) {
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const auto i = local_body<double>(q, v, a, 0), j = local_body<double>(q, v, a, kBodySize);
  PairConstants<double> c;
  c.s_i = Vector3<double>(0.1, -0.2, 0.3);
  c.s_j = Vector3<double>(-0.3, 0.1, 0.2);
  const PairRows<double> rows = pair_rows(PairKind::kPrismatic, c);
  PairMotion<double> shared;
  shared.update(rows, i, j);
  for (const ProductRow<double>& row : rows.products) {
    for (const PairVector<double>* x : {&row.X, &row.Y}) {
      const VectorMotion<double> one = shared.of(*x), other = motion_of(*x, i, j);
      EXPECT_LT((one.x - other.x).norm() + (one.xd - other.xd).norm() + (one.xdd - other.xdd).norm(), 1e-14);
    }
  }
}

TEST(PairMotion, VectorsOnTheGroundRest) {
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const auto j = local_body<double>(q, v, a, kBodySize);
  const PairRows<double> rows = pair_rows(PairKind::kPlanar, PairConstants<double>());
  PairMotion<double> shared;
  BodyKinematics<double> ground;
  ground.at_rest = true;
  shared.update(rows, ground, j);
  const VectorMotion<double> z = shared.of(rows.products.front().X);
  EXPECT_EQ(z.x, Vector3<double>::UnitZ());
  EXPECT_EQ(z.xd, Vector3<double>::Zero());
  EXPECT_EQ(z.xdd, Vector3<double>::Zero());
}

}  // namespace
}  // namespace codesign
