// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Loads that a long step could pass over, theory (17e).
#include "integration/expression_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"

namespace codesign {
namespace {

// A smooth pulse by the position: 2 kg with 3 m/s, the potential -A w sqrt(pi) erf((x - 1)/w)/2.
// Behind it m v^2/2 has grown by A w sqrt(pi).
TEST(ExpressionWatch, PulsesByAPositionAreNotPassedOver) {
  for (double width : {0.1, 0.03, 0.01})
    for (double place : {0.7, 1.0, 1.234, 2.9}) {
      const std::string text =
          "duration: 2.0\ngravity: [0, 0, 0]\ninitial_state: {slide: {velocity: 3.0}}\nloads: "
          "[{joint: slide, effort: \"${-20*exp(-((slide/position - " +
          std::to_string(place) + ")/" + std::to_string(width) + ")**2)}\"}]\n";
      const double work = -20.0 * width * std::sqrt(M_PI);
      EXPECT_NEAR(end_of(robot(mass("piston", 2.0) + lift("slide", "piston", 0.0)), text, 2.0,
                         {"slide/velocity"})[0],
                  std::sqrt(9.0 + work), 2e-5)
          << width << " m at " << place << " m";
    }
}

}  // namespace
}  // namespace codesign
