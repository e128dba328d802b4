// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "control/reference.h"
#include "math/differences.h"

namespace codesign {

inline Reference<double> through(const WaypointsDescription& points) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kWaypoints;
  description.waypoints = points;
  return Reference<double>(description, {});
}

/// Compares each derivative with differences of the one before it.
inline void expect_derivatives(const Reference<double>& reference, double t) {
  const auto difference = [t](const auto& f) { return ridders_derivative(f, t, 1e-2).value; };
  const ReferenceMotion<double> m = reference.at(t);
  EXPECT_NEAR(m.rate, difference([&](double x) { return reference.at(x).value; }),
              1e-8 * (1.0 + std::abs(m.rate)));
  EXPECT_NEAR(m.acceleration, difference([&](double x) { return reference.at(x).rate; }),
              1e-8 * (1.0 + std::abs(m.acceleration)));
  EXPECT_NEAR(m.jerk, difference([&](double x) { return reference.at(x).acceleration; }),
              1e-8 * (1.0 + std::abs(m.jerk)));
}

/// @param names parameters, and last the time.
inline ReferenceDescription expression_of(const std::string& text,
                                          const std::vector<std::string>& names) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kExpression;
  description.expression = {std::make_shared<const Expression>(text, names),
                            static_cast<int>(names.size()) - 1};
  return description;
}

}  // namespace codesign
