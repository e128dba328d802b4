// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/reference.h"

#include "control/reference_fixture.h"

namespace codesign {
namespace {

/// A function of each kind.
std::vector<ReferenceDescription> kinds() {
  using Kind = ReferenceDescription::Kind;
  std::vector<ReferenceDescription> all(7, ReferenceDescription(0.3));
  for (std::size_t k = 0; k < all.size(); ++k) all[k].kind = static_cast<Kind>(k);
  all[1].sine = {2.0, 0.4, 0.5, 0.25, false};
  all[2].waypoints = {Interpolation::kQuintic, {0.0, 0.5, 1.2}, {1.0, -2.0, 0.5}, {}, {}};
  all[3].sampled.samples = std::make_shared<const SampledFunction>(
      std::vector<double>{0.0, 0.4, 0.8, 1.2}, std::vector<double>{1.0, 3.0, -2.0, 0.5});
  all[4].live = {std::make_shared<const LiveFunction>(),
                 std::make_shared<const ReferenceDescription>(all[2])};
  all[5].integral = {std::make_shared<const ReferenceDescription>(all[1]), 0.7, 2.0};
  all[6].expression = expression_of("exp(-t)*sin(3*t)", {"t"}).expression;
  return all;
}

void expect_same(const ReferenceMotion<double>& a, const ReferenceMotion<double>& b) {
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.rate, b.rate);
  EXPECT_EQ(a.acceleration, b.acceleration);
  EXPECT_EQ(a.jerk, b.jerk);
}

TEST(Reference, IsZeroAtFirst) { expect_same(Reference<double>().at(1.0), {}); }

TEST(Reference, BecomesAnyKindAfterAnyOther) {
  const std::vector<ReferenceDescription> all = kinds();
  for (const ReferenceDescription& first : all)
    for (const ReferenceDescription& second : all) {
      SCOPED_TRACE(static_cast<int>(first.kind) * 10 + static_cast<int>(second.kind));
      Reference<double> reference(first, {});
      reference.set(second, {});
      const Reference<double> copy = reference;
      for (const double t : {-0.1, 0.3, 0.7, 1.9}) {
        expect_same(reference.at(t), Reference<double>(second, {}).at(t));
        expect_same(copy.at(t), reference.at(t));
      }
    }
}

TEST(Reference, EveryKindHasThreeDerivatives) {
  for (const ReferenceDescription& description : kinds()) {
    SCOPED_TRACE(static_cast<int>(description.kind));
    expect_derivatives(Reference<double>(description, {}), 0.65);
  }
}

}  // namespace
}  // namespace codesign
