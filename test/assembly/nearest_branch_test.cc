// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Of several branches the one nearest to the guesses, theory (19c), against closed forms.
#include "assembly/nearest_branch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/assembly.h"
#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

/// A crank of a and a rod of b about z, and a slider along x.
std::string crank_and_slider(double a, double b) {
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' "
      "izz='0.01'/></inertial>";
  const auto number = [](double value) { return std::to_string(value); };
  return robot("<link name='crank'>" + mass + "</link><link name='rod'>" + mass +
               "</link><link name='slider'>" + mass +
               "</link><joint name='q' type='continuous'><parent link='ground'/><child "
               "link='crank'/><axis xyz='0 0 1'/></joint><joint name='r' type='continuous'><parent "
               "link='crank'/><child link='rod'/><origin xyz='" +
               number(a) +
               " 0 0'/><axis xyz='0 0 1'/></joint><joint name='s' type='prismatic'><parent "
               "link='ground'/><child link='slider'/><axis xyz='1 0 0'/><limit lower='-9' "
               "upper='9' effort='0' velocity='0'/></joint><loop name='pin' type='revolute' "
               "codesign:out_of_plane='zero'><predecessor link='rod'><origin xyz='" +
               number(b) +
               " 0 0'/></predecessor><successor link='slider'/><axis xyz='0 0 1'/></loop>");
}

std::string start_of(double q, const std::string& guesses) {
  return "duration: 1.0\ninitial_state: {q: {position: " + std::to_string(q) + "}" + guesses +
         "}\n";
}

TEST(NearestBranch, TheSliderIsOnTheSideOfItsGuess) {
  for (const double a : {0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 0.9999})
    for (const double q : {0.3, 1.0, 1.4, 1.57, 2.5, -1.2})
      for (const double off : {-0.4, 0.05, 0.3}) {
        const double middle = a * std::cos(q), half = std::sqrt(1.0 - std::pow(a * std::sin(q), 2));
        for (const double side : {1.0, -1.0}) {
          const double nearest = middle + side * half, other = middle - side * half;
          const double guess = nearest + off * half;
          if (std::abs(guess - nearest) > 0.45 * std::abs(guess - other)) continue;
          Compiled c(crank_and_slider(a, 1.0),
                     start_of(q, ", s: {guess: " + std::to_string(guess) + "}"));
          const Status status = c.start();
          ASSERT_TRUE(status.ok()) << a << " " << q << " " << guess << ": " << status.cause;
          EXPECT_NEAR(c.assembly.theta()[2], nearest, 2e-5)
              << a << " " << q << ", guess " << guess << ", other " << other;
        }
      }
}

// The guess of the rod's angle: the slider follows.
TEST(NearestBranch, OfAnotherJointOfTheLoop) {
  for (const double a : {0.5, 0.9, 0.99})
    for (const double guess : {-2.0, -0.9, -3.3, 2.9}) {
      Compiled c(crank_and_slider(a, 1.0),
                 start_of(1.0, ", r: {guess: " + std::to_string(guess) + "}"));
      ASSERT_TRUE(c.start().ok());
      const double lean = std::asin(a * std::sin(1.0)), forward = -1.0 - lean,
                   back = M_PI - 1.0 + lean;
      const auto apart = [guess](double angle) {
        return std::abs(std::remainder(angle - guess, 2.0 * M_PI));
      };
      EXPECT_NEAR(apart(c.assembly.theta()[1]), std::min(apart(forward), apart(back)), 2e-6)
          << a << " " << guess;
    }
}

// From a slider far from any solution, Newton's method did not close the loop.
TEST(NearestBranch, ALoopClosesFromAGuessThatIsFarOff) {
  for (const double guess : {0.01, -0.01, 3.0, -3.0}) {
    Compiled c(crank_and_slider(0.5, 1.0),
               start_of(1.5707963267948966, ", s: {guess: " + std::to_string(guess) + "}"));
    const Status status = c.start();
    ASSERT_TRUE(status.ok()) << guess << ": " << status.cause;
    EXPECT_NEAR(c.assembly.theta()[2], std::copysign(std::sqrt(0.75), guess), 1e-6) << guess;
  }
}

TEST(NearestBranch, IsTheSameInBothCoordinates) {
  for (const char* coordinates : {"absolute", "joint"}) {
    Compiled c(crank_and_slider(0.9, 1.0),
               start_of(1.0, ", s: {guess: 1.2}") + "solver: {coordinates: " + coordinates + "}\n");
    ASSERT_TRUE(c.start().ok());
    EXPECT_NEAR(c.assembly.theta()[2], 1.1393115, 1e-5) << coordinates;
  }
}

TEST(NearestBranch, TakesThePlaceOfAFarSolution) {
  LoopsToClose c(triangle(), "{left_hinge: {guess: -0.5}, right_hinge: {guess: 0.5}}");
  LoopClosure closure(c.loops);
  const double below = std::asin(0.6), above = M_PI - below;
  Posture posture = c.at({-above, above});
  posture.dependent = posture.moved = {0, 1};
  const Eigen::VectorXd guesses = Eigen::Vector2d(-0.5, 0.5);
  EXPECT_EQ(take_nearest_branch(c.loops, c.design, Closure::kClosed, guesses, &closure, &posture),
            Closure::kClosed);
  EXPECT_NEAR(posture.theta[0], -below, 1e-12);
  // Without guesses every solution is as good.
  posture = c.at({-above, above});
  posture.given.guess = {false, false};
  EXPECT_EQ(take_nearest_branch(c.loops, c.design, Closure::kNear, guesses, &closure, &posture),
            Closure::kNear);
  EXPECT_EQ(posture.theta[0], -above);
}

}  // namespace
}  // namespace codesign
