// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace codesign {
namespace {

TEST(OrderFloor, SmallNormsGrowWithTheirNumber) {
  OrderFloor floor;
  EXPECT_EQ(floor.raise(0.0), 0.0);
  floor.set_active(true);
  for (int round = 0; round < 2; ++round) {
    floor.begin();
    EXPECT_EQ(floor.raise(0.0), 1e-6);
    EXPECT_EQ(floor.raise(2e-6), 4e-6);
    EXPECT_EQ(floor.raise(3e-6), 16e-6);
    EXPECT_EQ(floor.raise(0.0), 0.0);
  }
}

TEST(OrderFloor, OtherNormsStayAsTheyAre) {
  OrderFloor floor;
  floor.set_active(true);
  EXPECT_EQ(floor.raise(0.25), 0.25);
  EXPECT_TRUE(std::isnan(floor.raise(std::numeric_limits<double>::quiet_NaN())));
}

TEST(OrderFloor, ClonesHaveTheFloorOfTheirVector) {
  const ContextHandle context = make_context();
  OrderFloor floor;
  floor.set_active(true);
  const VectorHandle vector = make_vector(3, context.get()), mask = make_vector(3, context.get());
  N_VConst(1.0, mask.get());
  set_order_floor(vector.get(), &floor);
  const VectorHandle clone(N_VClone(vector.get()));
  N_VConst(0.0, clone.get());
  EXPECT_EQ(N_VWrmsNormMask(clone.get(), mask.get(), mask.get()), 1e-6);
  EXPECT_EQ(N_VWrmsNorm(clone.get(), mask.get()), 0.0);
  N_VConst(2.0, clone.get());
  EXPECT_EQ(N_VWrmsNormMask(clone.get(), mask.get(), mask.get()), 2.0);
  set_order_floor(clone.get(), nullptr);
  const VectorHandle plain(N_VClone(clone.get()));
  N_VConst(0.0, plain.get());
  EXPECT_EQ(N_VWrmsNormMask(plain.get(), mask.get(), mask.get()), 0.0);
}

}  // namespace
}  // namespace codesign
