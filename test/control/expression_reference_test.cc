// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/expression_reference.h"

#include "control/reference_fixture.h"

namespace codesign {
namespace {

TEST(Reference, AnExpressionHasThreeDerivatives) {
  const ReferenceDescription description =
      expression_of("A*sin(3*t)*exp(-t) + (t < 1 ? t^2 : 2*t - 1)", {"A", "t"});
  const Reference<double> reference(description, {0.7});
  for (double t : {0.4, 1.6}) {
    expect_derivatives(reference, t);
    EXPECT_NEAR(reference.at(t).value,
                0.7 * std::sin(3.0 * t) * std::exp(-t) + (t < 1.0 ? t * t : 2.0 * t - 1.0), 1e-15);
  }
  using L = Lanes<4>;
  const Reference<L> lanes(description, {L(0.7, L::Vector{1.0, 0.0, 0.0, 0.0})});
  EXPECT_NEAR(lanes.at(0.4).rate.v[0], std::exp(-0.4) * (3.0 * std::cos(1.2) - std::sin(1.2)),
              1e-14);
  EXPECT_EQ(dependencies(description), std::vector<int>{0});
}

}  // namespace
}  // namespace codesign
