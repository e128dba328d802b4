// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/sampled_reference.h"

#include "control/reference_fixture.h"

namespace codesign {
namespace {

/// scale f(t + delay) - offset by the parameters of these names.
ReferenceDescription sampled() {
  const std::vector<std::string> names{"scale", "delay", "offset"};
  const auto number = [&](double value, const std::string& name) {
    return Quantity(value, std::make_shared<const Expression>(name, names));
  };
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kSampled;
  description.sampled = {
      std::make_shared<const SampledFunction>(std::vector<double>{0.0, 0.1, 0.2, 0.3},
                                              std::vector<double>{1.0, 3.0, -2.0, 0.5}),
      number(2.0, "scale"), number(0.02, "delay"), number(0.3, "offset")};
  return description;
}

TEST(Reference, SamplesAreScaledEarlyByTheDelayAndLessTheOffset) {
  const Reference<double> reference(sampled(), {2.0, 0.02, 0.3});
  EXPECT_NEAR(reference.at(0.08).value, 2.0 * 3.0 - 0.3, 1e-13);
  EXPECT_NEAR(reference.at(0.5).value, 2.0 * 0.5 - 0.3, 1e-13) << "held";
  EXPECT_EQ(reference.at(0.5).rate, 0.0);
  for (double t : {0.03, 0.13, 0.22}) expect_derivatives(reference, t);
}

TEST(Reference, SamplesHaveDerivativesByScaleDelayAndOffset) {
  std::vector<Lanes<4>> parameters{2.0, 0.02, 0.3};
  for (int k = 0; k < 3; ++k) parameters[static_cast<std::size_t>(k)].v[k] = 1.0;
  const ReferenceMotion<Lanes<4>> m = Reference<Lanes<4>>(sampled(), parameters).at(0.13);
  const std::vector<double> at{2.0, 0.02, 0.3};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = [&](double x) {
      std::vector<double> moved = at;
      moved[k] = x;
      return Reference<double>(sampled(), moved).at(0.13).value;
    };
    EXPECT_NEAR(m.value.v[static_cast<int>(k)], ridders_derivative(value, at[k], 1e-2).value, 1e-9)
        << k;
  }
}

}  // namespace
}  // namespace codesign
