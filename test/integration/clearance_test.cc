// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Joints that play: the start of the ideal joint, its limit, free flight, rest on the bearing,
// signals of the orbit, and the energy balance.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/energy_balance.h"
#include "integration/mechanisms.h"
#include "integration/playing.h"
#include "integration/signals_at.h"

namespace codesign {
namespace {

constexpr double kEarthGravity = 9.81;

TEST(Clearance, StartsAsTheIdealJoint) {
  const std::vector<std::string> signals = {"turn/position", "elbow/position", "slider/position/x",
                                            "turn/velocity", "elbow/velocity", "slider/velocity/x"};
  const std::vector<double> ideal =
      signals_at(playing_problem(playing_slider_crank("", ""), playing_study("")), 0.0, signals);
  for (const bool in_loop : {true, false}) {
    const Problem problem = playing_problem(
        in_loop ? playing_slider_crank("", kPlayingPin) : playing_slider_crank(kPlayingPin, ""),
        playing_study(""));
    const std::vector<double> start = signals_at(problem, 0.0, signals);
    for (std::size_t k = 0; k < signals.size(); ++k)
      EXPECT_NEAR(start[k], ideal[k], 1e-12 * (1.0 + std::abs(ideal[k]))) << signals[k];
    const std::string name = in_loop ? "pin" : "elbow";
    const std::vector<double> journal = signals_at(
        problem, 0.0, {name + "_clearance/gap", name + "_x/position", name + "_y/velocity"});
    EXPECT_NEAR(journal[0], 5e-4, 2e-12);
    EXPECT_NEAR(journal[1], 0.0, 1e-15);
    EXPECT_NEAR(journal[2], 0.0, 1e-12);
  }
}

TEST(Clearance, OfPlainZeroIsTheIdealJoint) {
  const char* const none = "<codesign:clearance radial='0'/>";
  const std::vector<std::string> signals = {"turn/position", "slider/position/x"};
  EXPECT_EQ(
      signals_at(playing_problem(playing_slider_crank("", ""), playing_study("")), 0.03, signals),
      signals_at(playing_problem(playing_slider_crank(none, none), playing_study("")), 0.03,
                 signals));
}

// A smaller clearance in a stiffer bearing, whose rattle friction ends, moves like the ideal joint.
TEST(Clearance, TendsToTheIdealJoint) {
  const auto miss = [](const std::string& c, const std::string& stiffness) {
    const std::string play = "<codesign:clearance radial='" + c + "' radius='0.01' stiffness='" +
                             stiffness + "' dissipation='20'/>";
    const std::vector<std::string> signals = {"turn/position"};
    return std::abs(signals_at(playing_problem(playing_slider_crank("", play), playing_study("")),
                               0.03, signals)[0] -
                    signals_at(playing_problem(playing_slider_crank("", ""), playing_study("")),
                               0.03, signals)[0]);
  };
  const double wide = miss("1e-4", "1e9"), narrow = miss("1e-6", "1e11");
  EXPECT_LT(wide, 0.02);
  EXPECT_LT(narrow, 0.05 * wide);
}

/// A pendulum of 1 kg at 0.2 m on a joint of the tree.
std::string on_pin(const std::string& joint, const std::string& inside) {
  return robot(
      "<link name='arm'><inertial><origin xyz='0 0 -0.2'/><mass value='1'/><inertia "
      "ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link>" +
      joint + inside);
}

// It falls freely by the clearance, c = g t^2/2, and comes to rest on the bearing by its weight:
// k delta^1.5 = m g.
TEST(Clearance, APendulumFallsAndRestsOnItsBearing) {
  const double c = 1e-3, stiffness = 1e6;
  const std::string play =
      "<codesign:clearance radial='1e-3' radius='0.02' stiffness='1e6' dissipation='30'/>";
  const double flight = std::sqrt(2.0 * c / kEarthGravity),
               depth = std::pow(kEarthGravity / stiffness, 2.0 / 3.0);
  for (const bool is_ball : {false, true}) {
    const Problem problem = playing_problem(
        is_ball
            ? on_pin("<joint name='free' type='floating'><parent link='ground'/><child "
                     "link='arm'/></joint><loop name='pin' type='codesign:spherical'><predecessor "
                     "link='ground'/><successor link='arm'/>" +
                         play + "</loop>",
                     "")
            : on_pin("<joint name='pin' type='continuous'><parent link='ground'/><child "
                     "link='arm'/><axis xyz='0 1 0'/>" +
                         play + "</joint>",
                     ""),
        "duration: 0.5\nsolver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-12}\n");
    EXPECT_NEAR(signals_at(problem, 0.9 * flight, {"arm/position/z"})[0],
                -0.5 * kEarthGravity * 0.81 * flight * flight, 1e-10)
        << is_ball;
    const std::vector<double> rest = signals_at(
        problem, 0.5, {"arm/position/z", "pin_clearance/gap", "pin_clearance/normal_force"});
    EXPECT_NEAR(rest[0], -c - depth, 1e-7) << is_ball;
    EXPECT_NEAR(rest[1], -depth, 1e-7) << is_ball;
    EXPECT_NEAR(rest[2], kEarthGravity, 1e-3) << is_ball;
  }
}

// With axial clearance a hinge along gravity sinks by it.
TEST(Clearance, AJournalSinksByItsAxialClearance) {
  const Problem problem = playing_problem(
      on_pin("<joint name='pin' type='continuous'><parent link='ground'/><child "
             "link='arm'/><axis xyz='0 0 1'/><codesign:clearance radial='1e-3' axial='2e-4' "
             "radius='0.02' stiffness='1e7' dissipation='30'/></joint>",
             ""),
      "duration: 0.3\n");
  const std::vector<double> rest = signals_at(
      problem, 0.3, {"pin_z/position", "pin_axial_clearance/normal_force", "pin_x/position"});
  EXPECT_NEAR(rest[0], -2e-4 - std::pow(kEarthGravity / 1e7, 2.0 / 3.0), 1e-6);
  EXPECT_NEAR(rest[1], kEarthGravity, 1e-2);
  EXPECT_NEAR(rest[2], 0.0, 1e-9);
}

// A block in a level guide falls by the clearance onto its four lower corners, and turns by the
// clearance over its length where its centre of mass is beside them.
TEST(Clearance, ABlockRestsInItsGuide) {
  const auto block = [](const std::string& centre) {
    return robot("<link name='block'><inertial><origin xyz='" + centre +
                 " 0 0'/><mass value='1'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' "
                 "izz='0.01'/></inertial></link><joint name='slide' type='prismatic'><parent "
                 "link='ground'/><child link='block'/><axis xyz='1 0 0'/><limit lower='-1' "
                 "upper='1' effort='0' velocity='0'/><codesign:clearance radial='5e-4' "
                 "length='0.1' width='0.04' transverse_axis='0 0 1' stiffness='1e7' "
                 "dissipation='30'/></joint>");
  };
  const std::vector<std::string> signals = {"slide_x/position", "slide_turn/position",
                                            "slide_clearance/normal_force", "slide/position"};
  const std::vector<double> flat =
      signals_at(playing_problem(block("0"), "duration: 0.4\n"), 0.4, signals);
  const double depth = std::pow(kEarthGravity / 4.0 / 1e7, 2.0 / 3.0);
  EXPECT_NEAR(flat[0], -5e-4 - depth, 1e-7);
  EXPECT_NEAR(flat[1], 0.0, 1e-9);
  EXPECT_NEAR(flat[2], kEarthGravity, 1e-2);
  // The upper corner behind and the lower one in front carry it: lever 0.08 m over their distance.
  const std::vector<double> tilted =
      signals_at(playing_problem(block("0.08"), "duration: 0.4\n"), 0.4, signals);
  const double up = std::pow(0.3 * kEarthGravity / 2.0 / 1e7, 2.0 / 3.0),
               down = std::pow(1.3 * kEarthGravity / 2.0 / 1e7, 2.0 / 3.0),
               turn = std::abs(tilted[1]);
  EXPECT_NEAR(turn, (1e-3 + up + down) / 0.1, 5e-5);
  EXPECT_NEAR(
      tilted[2],
      kEarthGravity * 0.16 * std::cos(turn) / (0.1 * std::cos(turn) - 0.04 * std::sin(turn)), 1e-2);
}

TEST(Clearance, TakesExactlyItsWork) {
  for (const bool in_loop : {true, false}) {
    const std::string urdf =
        in_loop ? playing_slider_crank("", kPlayingPin) : playing_slider_crank(kPlayingPin, "");
    const Balance b = balance(urdf, playing_study("solver: " + std::string(kFriction) + "\n"));
    ASSERT_TRUE(b.status.ok()) << in_loop << b.status.cause;
    EXPECT_GT(b.friction_work, 1e-6) << in_loop;
    EXPECT_NEAR(b.end - b.start, b.work, 1e-6 * std::abs(b.work)) << in_loop;
  }
}

}  // namespace
}  // namespace codesign
