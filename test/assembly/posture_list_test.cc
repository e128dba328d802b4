// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/posture_list.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

/// The postures of the parallelogram four_bar() at angles of its left hinge.
struct ListOfPostures {
  LoopsToClose c;
  FirstPosture first{c.loops};
  LoopClosure closure{c.loops};
  StartPositions positions{c.loops, &closure};
  PostureList list{c.loops, &first, &closure, &positions};
  Posture posture = c.at({});
  State<double> state;
  Warnings warnings;

  explicit ListOfPostures(const std::string& angles)
      : c(four_bar(), "{right_hinge: {guess: 0.6}, left_pin: {guess: -0.6}}", 1e-9,
          "positions: {left_hinge: " + angles + "}\n") {
    first.set(c.design.parameters, &posture);
    EXPECT_TRUE(positions.find(c.design, &first, &posture, &warnings).ok());
    state.resize(c.compiled.system.layout());
    std::vector<LinkMotion<double>> links;
    place(c.loops, c.design, posture, &links, &state);
    list.begin(c.design, posture, state);
  }
};

TEST(PostureList, GoesOnAlongTheBranch) {
  ListOfPostures p("[0.6, 1.2, -0.4]");
  for (const double angle : {1.2, -0.4}) {
    ASSERT_TRUE(p.list.go_on(p.c.design, &p.posture, &p.state, &p.warnings).ok());
    EXPECT_NEAR(p.posture.theta[0], angle, 1e-15);
    EXPECT_NEAR(p.posture.theta[1], angle, 1e-10);
    EXPECT_NEAR(p.posture.theta[2], -angle, 1e-10);
    EXPECT_FALSE(p.list.is_singular(p.c.design, p.posture));
    p.list.add(p.posture, p.state, false);
  }
  EXPECT_EQ(p.posture.number, 2.0);
  EXPECT_EQ(p.posture.time, 2.0);
}

TEST(PostureList, KnowsASingularPostureByTheOthers) {
  ListOfPostures p("[0.6, 1.5707963267948966]");
  const Posture flat = p.c.at({0.5 * M_PI, 0.5 * M_PI, -0.5 * M_PI});
  EXPECT_TRUE(p.list.is_singular(p.c.design, flat));
  p.list.begin(p.c.design, flat, p.state);
  EXPECT_FALSE(p.list.is_singular(p.c.design, flat)) << "the only one so far";
  EXPECT_FALSE(p.list.is_singular(p.c.design, p.posture));
  EXPECT_TRUE(p.list.is_singular(p.c.design, flat));
}

TEST(PostureList, WarnsOfASingularPostureByItsPositions) {
  const ListOfPostures p("[0.6, 1.25]");
  for (const bool has_forces : {true, false}) {
    Warnings warnings;
    p.list.warn_of_singular(p.c.design.parameters, 1.0, has_forces, &warnings);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].code, "singular_posture");
    EXPECT_NE(warnings[0].message.find("posture 1 (left_hinge = 1.25)"), std::string::npos)
        << warnings[0].message;
    EXPECT_EQ(warnings[0].message.find("0 is shown") == std::string::npos, has_forces);
  }
}

}  // namespace
}  // namespace codesign
