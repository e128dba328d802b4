// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "identification/fit/fit_variables.h"
#include "math/differences.h"

namespace codesign {
namespace {

RecordedEffort uneven() { return {{0.0, 0.1, 0.25, 0.3, 0.5}, {1.0, 2.0, -1.0, 0.5, 0.0}}; }

TEST(EffortSensor, SignsByHand) {
  // A motor constant of 2 N m per A and an offset of 0.5 N m: 3.5 N m show as 2 A, 0.1 s late.
  const RecordedEffort recorded({0.0, 1.0}, {1.9, 2.9});
  const EffortSensor sensor{2.0, 0.5, 0.1, 2.0};
  EXPECT_NEAR(effort_residual(sensor, recorded, 0.0, 3.5).value, 0.0, 1e-15);
  EXPECT_NEAR(effort_residual(sensor, recorded, 0.0, 3.7).value, 0.2, 1e-15);
}

TEST(EffortSensor, DerivativesAgreeWithDifferences) {
  const RecordedEffort recorded = uneven();
  const double time = 0.2, effort = 1.3;
  const EffortSensor sensor{2.5, 0.4, 0.03, 2.0};
  const EffortResidual r = effort_residual(sensor, recorded, time, effort);
  const auto residual = [&](double scale, double offset, double delay, double at) {
    return effort_residual({scale, offset, delay, 2.0}, recorded, time, at).value;
  };
  const auto slope = [](const auto& of, double x) { return ridders_derivative(of, x, 1e-3).value; };
  EXPECT_NEAR(r.by_scale, slope([&](double x) { return residual(x, 0.4, 0.03, effort); }, 2.5),
              1e-9);
  EXPECT_NEAR(r.by_effort, slope([&](double x) { return residual(2.5, x, 0.03, effort); }, 0.4),
              1e-9);
  EXPECT_NEAR(r.by_effort, slope([&](double x) { return residual(2.5, 0.4, 0.03, x); }, effort),
              1e-9);
  EXPECT_NEAR(r.by_delay, slope([&](double x) { return residual(2.5, 0.4, x, effort); }, 0.03),
              1e-7);
}

}  // namespace

}  // namespace codesign
