// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/stuck_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "equations/compiled.h"

namespace codesign {
namespace {

const char* const kTwoCoordinates[] = {"joint", "absolute"};
const char* const kStickingLaws[] = {"gonthier", "lugre"};
constexpr double kWeight = 9.81;

std::string crate(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='2'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' "
         "izz='0.02'/></inertial></link>";
}

/// A slide along x that is inclined by `slope` about y.
std::string inclined(const std::string& name, const std::string& parent, const std::string& child,
                     double slope, const std::string& type = "prismatic") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin rpy='0 " + std::to_string(slope) +
         " 0'/><axis xyz='" + (type == "planar" ? "0 0 1" : "1 0 0") +
         "'/><limit lower='-9' upper='9' effort='9' velocity='9'/><codesign:friction "
         "mu_static='0.4' "
         "mu_dynamic='0.3' transition_velocity='0.01' smoothing='1e-12'" +
         (type == "planar" ? "" : " joint_length='0.2' joint_width='0.1'") + "/></joint>";
}

std::string block_on_slope(double slope) {
  return robot(crate("box") + inclined("slide", "ground", "box", slope));
}

std::string held_bars(const std::string& left, const std::string& right) {
  std::string urdf = four_bar();
  const auto rub = [&urdf](const std::string& joint, const std::string& limit) {
    const std::string end = "</joint>";
    const std::size_t at = urdf.find(end, urdf.find("<joint name='" + joint));
    urdf.insert(at, "<codesign:friction model='lugre' coulomb='" + limit + "'/>");
  };
  if (!left.empty()) rub("left_hinge", left);
  if (!right.empty()) rub("right_hinge", right);
  const std::string loop = "<loop name='right_pin'";
  urdf.insert(urdf.find(loop) + loop.size(), " codesign:out_of_plane='zero'");
  return urdf;
}

/// A start, and what it found.
struct HeldStart {
  Compiled compiled;
  Status status;

  HeldStart(const std::string& urdf, const std::string& initial, const std::string& signal,
            const std::string& coordinates, const std::string& more = "")
      : compiled(urdf,
                 let_go(initial, signal, "solver: {coordinates: " + coordinates + "}\n" + more)),
        status(compiled.start()) {}

  double deflection(std::size_t contact = 0, int direction = 0) const {
    const CompiledSystem& system = compiled.system;
    return compiled.state.s[system.bristles()[system.stuck()[contact].bristle].first + direction];
  }
  double acceleration() const { return compiled.state.z.head(compiled.system.layout().n).norm(); }
  double rates_of_bristles() const {
    return compiled.state.z.tail(compiled.system.layout().states).cwiseAbs().maxCoeff();
  }
};

TEST(StuckStart, ABlockOnASlopeRestsOnTheDeflectionThatItsLoadNeeds) {
  for (const char* law : kStickingLaws)
    for (const char* coordinates : kTwoCoordinates) {
      const HeldStart s(with_friction_model(block_on_slope(0.25), law), "{slide: {stuck: true}}",
                        "slide/position", coordinates);
      ASSERT_TRUE(s.status.ok()) << s.status.cause;
      // Load m g sin over the normal force m g cos.
      EXPECT_NEAR(s.deflection(), std::tan(0.25), 1e-12) << law << coordinates;
      EXPECT_LT(s.acceleration(), 1e-12) << law << coordinates;
      EXPECT_LT(s.rates_of_bristles(), 1e-12) << law << coordinates;
      EXPECT_TRUE(s.compiled.assembly.warnings().empty());
    }
}

TEST(StuckStart, AContactThatHoldsHasRested) {
  // tan(0.33) lies between mu_d and mu_s: Gonthier's contact holds it only after a rest.
  const HeldStart s(with_friction_model(block_on_slope(0.33), "gonthier"), "{slide: {stuck: true}}",
                    "slide/position", "joint");
  ASSERT_TRUE(s.status.ok()) << s.status.cause;
  EXPECT_NEAR(s.deflection(), std::tan(0.33), 1e-12);
  EXPECT_EQ(s.deflection(0, 1), 1.0) << "the dwell state";
  EXPECT_LT(s.acceleration(), 1e-12);
}

TEST(StuckStart, BeyondItsFrictionAJointSlidesWithTheLargestDeflection) {
  for (const char* law : kStickingLaws)
    for (const double slope : {0.5, -0.5})
      for (const char* coordinates : kTwoCoordinates) {
        const HeldStart s(with_friction_model(block_on_slope(slope), law), "{slide: {stuck: true}}",
                          "slide/position", coordinates);
        ASSERT_TRUE(s.status.ok()) << s.status.cause;
        EXPECT_NEAR(s.deflection(), slope > 0.0 ? 0.4 : -0.4, 1e-12) << law << coordinates;
        EXPECT_NEAR(s.acceleration(), kWeight * (std::sin(0.5) - 0.4 * std::cos(0.5)), 1e-6)
            << law << coordinates;
        ASSERT_EQ(s.compiled.assembly.warnings().size(), 1u);
        EXPECT_EQ(s.compiled.assembly.warnings()[0].code, "start_slides");
      }
}

TEST(StuckStart, StackedJointsEachHoldWhatLiesAboveThem) {
  const std::string urdf =
      robot(crate("lower") + crate("upper") + inclined("first", "ground", "lower", 0.2) +
            inclined("second", "lower", "upper", -0.5));
  for (const char* law : kStickingLaws)
    for (const char* coordinates : kTwoCoordinates) {
      const HeldStart s(with_friction_model(urdf, law),
                        "{second: {stuck: true}, first: {stuck: true, position: 0.3}}",
                        "first/position", coordinates);
      ASSERT_TRUE(s.status.ok()) << s.status.cause;
      EXPECT_NEAR(s.deflection(0), std::tan(-0.3), 1e-12) << law << coordinates;
      EXPECT_NEAR(s.deflection(1), std::tan(0.2), 1e-12) << law << coordinates;
      EXPECT_LT(s.acceleration(), 1e-11) << law << coordinates;
    }
}

TEST(StuckStart, APlaneHoldsInTheDirectionOfTheLoadAndSlidesAlongIt) {
  const std::string urdf = robot(crate("box") + inclined("plane", "ground", "box", 0.0, "planar"));
  for (const char* law : kStickingLaws)
    for (const char* coordinates : kTwoCoordinates) {
      const HeldStart held(with_friction_model(urdf, law), "{plane: {stuck: true}}",
                           "plane/friction", coordinates, "gravity: [1.2, -0.9, -5.0]\n");
      ASSERT_TRUE(held.status.ok()) << held.status.cause;
      EXPECT_NEAR(held.deflection(0, 0), 1.2 / 5.0, 1e-9) << law << coordinates;
      EXPECT_NEAR(held.deflection(0, 1), -0.9 / 5.0, 1e-9) << law << coordinates;
      EXPECT_LT(held.acceleration(), 1e-11) << law << coordinates;

      const HeldStart slides(with_friction_model(urdf, law), "{plane: {stuck: true}}",
                             "plane/friction", coordinates, "gravity: [4.0, -3.0, -5.0]\n");
      ASSERT_TRUE(slides.status.ok()) << slides.status.cause;
      EXPECT_NEAR(slides.deflection(0, 0), 0.4 * 0.8, 1e-9) << law << coordinates;
      EXPECT_NEAR(slides.deflection(0, 1), -0.4 * 0.6, 1e-9) << law << coordinates;
    }
}

TEST(StuckStart, ALoopIsHeldByOneOfItsHinges) {
  // By virtual work, a parallelogram of three bars turned by theta pulls at its hinges with
  // 2 m g l sin(theta).
  const double torque = 2.0 * kWeight * std::sin(0.3);
  for (const char* coordinates : kTwoCoordinates) {
    const HeldStart s(held_bars("8", ""), "{left_hinge: {position: -0.3, stuck: true}}",
                      "left_hinge/velocity", coordinates);
    ASSERT_TRUE(s.status.ok()) << s.status.cause;
    EXPECT_NEAR(s.deflection(), torque, 1e-10) << coordinates;
    EXPECT_LT(s.acceleration(), 1e-10) << coordinates;
  }
}

TEST(StuckStart, TheFirstJointsOfTheStudyTakeTheLoadOthersTheRest) {
  const double torque = 2.0 * kWeight * std::sin(0.3);
  const std::string both =
      "{right_hinge: {stuck: true, guess: -0.3}, left_hinge: {position: -0.3, stuck: true}}";
  for (const char* coordinates : kTwoCoordinates) {
    const HeldStart enough(held_bars("8", "7"), both, "left_hinge/velocity", coordinates);
    ASSERT_TRUE(enough.status.ok()) << enough.status.cause;
    EXPECT_NEAR(enough.deflection(0), torque, 1e-10) << coordinates;
    EXPECT_EQ(enough.deflection(1), 0.0) << coordinates;

    const HeldStart shared(held_bars("8", "4"), both, "left_hinge/velocity", coordinates);
    ASSERT_TRUE(shared.status.ok()) << shared.status.cause;
    EXPECT_NEAR(shared.deflection(0), 4.0, 1e-10) << coordinates;
    EXPECT_NEAR(shared.deflection(1), torque - 4.0, 1e-10) << coordinates;
    EXPECT_LT(shared.acceleration(), 1e-10) << coordinates;
    EXPECT_TRUE(shared.compiled.assembly.warnings().empty());

    const HeldStart too_little(held_bars("1", "4"), both, "left_hinge/velocity", coordinates);
    ASSERT_TRUE(too_little.status.ok()) << too_little.status.cause;
    EXPECT_NEAR(too_little.deflection(0), 4.0, 1e-10) << coordinates;
    EXPECT_NEAR(too_little.deflection(1), 1.0, 1e-10) << coordinates;
    EXPECT_EQ(too_little.compiled.assembly.warnings().size(), 2u);
  }
}

TEST(StuckStart, TheFlanksOfAGearHoldWhatItTransmits) {
  // 0.02 N m at the motor's shaft of 1:40 hold 0.8 N m at the joint.
  const std::string urdf = pendulum(
      "<codesign:actuator gear_ratio='40' rotor_inertia='1e-4' coulomb='0.02' model='lugre'/>");
  for (const char* coordinates : kTwoCoordinates) {
    const HeldStart s(urdf, "{hinge: {position: 0.1, stuck: true}}", "hinge/velocity", coordinates);
    ASSERT_TRUE(s.status.ok()) << s.status.cause;
    EXPECT_NEAR(s.deflection(), -0.5 * kWeight * std::sin(0.1) / 0.8, 1e-12) << coordinates;
    EXPECT_LT(s.acceleration(), 1e-12) << coordinates;
  }
}

TEST(StuckStart, AJointOfALoopThatMovesIsRefused) {
  std::string urdf = held_bars("8", "");
  urdf.insert(urdf.find("</loop>"), "<codesign:friction model='lugre' coulomb='3'/>");
  const HeldStart moves(urdf,
                        "{left_hinge: {position: -0.3, velocity: 1.0}, right_pin: {stuck: true}}",
                        "left_hinge/velocity", "joint");
  EXPECT_EQ(moves.status.code, StatusCode::kInitialVelocityFailed);
  EXPECT_NE(moves.status.cause.find("right_pin"), std::string::npos);
  const HeldStart rests(urdf, "{left_hinge: {position: -0.1}, right_pin: {stuck: true}}",
                        "left_hinge/velocity", "joint");
  ASSERT_TRUE(rests.status.ok()) << rests.status.cause;
  // The pin between the right bar and the coupler turns as the bar does.
  EXPECT_NEAR(std::abs(rests.deflection()), 2.0 * kWeight * std::sin(0.1), 1e-10);
  EXPECT_LT(rests.acceleration(), 1e-10);
}

}  // namespace
}  // namespace codesign
