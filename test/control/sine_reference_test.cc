// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/sine_reference.h"

#include "control/reference_fixture.h"

namespace codesign {
namespace {

TEST(Reference, AConstantStays) {
  const Reference<double> reference(ReferenceDescription(0.3), {});
  EXPECT_EQ(reference.at(0.0).value, 0.3);
  EXPECT_EQ(reference.at(7.0).value, 0.3);
  EXPECT_EQ(reference.at(7.0).rate, 0.0);
}

TEST(Reference, ASineHasFrequencyOrPeriodPhaseAndOffset) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kSine;
  description.sine = {2.0, M_PI / 6.0, 0.5, 0.25, false};
  const Reference<double> by_frequency(description, {});
  EXPECT_NEAR(by_frequency.at(0.0).value, 1.5, 1e-14);
  EXPECT_NEAR(by_frequency.at(4.0 / 6.0).value, 0.5 + 2.0 * std::sin(M_PI / 2.0), 1e-14);
  description.sine.frequency = 4.0;
  description.sine.is_period = true;
  EXPECT_NEAR(Reference<double>(description, {}).at(0.9).value, by_frequency.at(0.9).value, 1e-14);
  expect_derivatives(by_frequency, 0.77);
}

TEST(Reference, ParametersReachEveryNumber) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kSine;
  const std::vector<std::string> names{"A", "f"};
  description.sine.amplitude = Quantity(2.0, std::make_shared<const Expression>("A", names));
  description.sine.frequency = Quantity(0.5, std::make_shared<const Expression>("f", names));
  std::vector<Lanes<4>> parameters{2.0, 0.5};
  parameters[0].v[0] = 1.0;
  parameters[1].v[1] = 1.0;
  const ReferenceMotion<Lanes<4>> m = Reference<Lanes<4>>(description, parameters).at(0.3);
  const double angle = 2.0 * M_PI * 0.5 * 0.3;
  EXPECT_NEAR(m.value.v[0], std::sin(angle), 1e-14);
  EXPECT_NEAR(m.value.v[1], 2.0 * std::cos(angle) * 2.0 * M_PI * 0.3, 1e-13);
}

}  // namespace
}  // namespace codesign
