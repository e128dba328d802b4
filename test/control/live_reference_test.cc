// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/live_reference.h"

#include "control/reference_fixture.h"

namespace codesign {
namespace {

TEST(Reference, ACommandTakesThePlaceOfThePlannedFunction) {
  const auto function = std::make_shared<LiveFunction>();
  ReferenceDescription description, planned;
  planned.kind = ReferenceDescription::Kind::kSine;
  planned.sine = {2.0, 0.4, 0.5, 0.25, false};
  description.kind = ReferenceDescription::Kind::kLive;
  description.live = {function, std::make_shared<const ReferenceDescription>(planned)};
  const Reference<double> reference(description, {}), sine(planned, {});
  EXPECT_EQ(reference.at(0.8).value, sine.at(0.8).value);
  EXPECT_EQ(reference.at(0.8).jerk, sine.at(0.8).jerk);
  *function = {true, 0.5, {1.0, -2.0, 0.0, 4.0, 0.0, 0.0}};
  expect_derivatives(reference, 0.8);
  EXPECT_NEAR(reference.at(0.8).value, 1.0 - 2.0 * 0.3 + 4.0 * 0.027, 1e-15);
  EXPECT_EQ(LiveReference<double>::commanded_at(*function, 0.8).rate, reference.at(0.8).rate);
}

}  // namespace
}  // namespace codesign
