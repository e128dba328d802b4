// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/line_vector.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace codesign {
namespace {

TEST(LineVector, BeginsWithACacheLineWhateverItsSize) {
  for (std::size_t size : {1U, 7U, 100U, 10001U}) {
    const LineVector x(size, 2.0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(x.data()) % 64, 0U);
    EXPECT_EQ(x.back(), 2.0);
  }
}

TEST(LineVector, CopiesAndMovesAsOthersDo) {
  LineVector x(3, 1.0);
  LineVector y = x;
  y[0] = 5.0;
  EXPECT_EQ(x[0], 1.0);
  x = std::move(y);
  EXPECT_EQ(x[0], 5.0);
}

}  // namespace
}  // namespace codesign
