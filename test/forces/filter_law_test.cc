// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/filter_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

// theory (49), by hand
TEST(FilterLaw, ShapesByHand) {
  const double turn = 2.0 * M_PI;
  const auto shape = [](const FilterKind& kind, const FilterNumbers<double>& numbers) {
    return kind->shape.of<double>(numbers);
  };
  EXPECT_DOUBLE_EQ(shape(FilterKind::kLowPass, {3.0}).rate, 3.0 * turn);
  EXPECT_EQ(shape(FilterKind::kLowPass, {3.0}).lead, 0.0);
  EXPECT_EQ(shape(FilterKind::kLowPass2, {3.0, 0.4}).damping, 0.8);
  const FilterShape<double> notch = shape(FilterKind::kNotch, {3.0, 0.4, 0.25});
  EXPECT_EQ(notch.lead, 1.0);
  EXPECT_DOUBLE_EQ(notch.middle / notch.damping, 0.25) << "the gain at its frequency";
  const FilterShape<double> lead = shape(FilterKind::kLeadLag, {2.0, 10.0});
  EXPECT_DOUBLE_EQ(lead.rate, 10.0 * turn);
  EXPECT_DOUBLE_EQ(lead.lead, 5.0) << "the gain at high frequencies";
}

// What a table says of a row, and what its function does, agree.
TEST(FilterLaw, RowsAgreeWithTheirFunctions) {
  for (const FilterKind& kind : filter_laws()) {
    const FilterShape<double> shape = kind->shape.of<double>(FilterNumbers<double>{2.0, 0.3, 0.1});
    EXPECT_EQ(shape.lead != 0.0, kind->passes_steps) << kind->name;
    EXPECT_EQ(shape.damping != 0.0, kind->order == 2) << kind->name;
    EXPECT_GE(kind->count(), 1U);
  }
}

}  // namespace
}  // namespace codesign
