// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/posture_efforts.h"

#include <cmath>
#include <limits>

#include "description/study.h"
#include "problem/load_problem.h"
#include "statics/statics_cases.h"

namespace codesign {
namespace {

/// The efforts in all postures of a study with a grid.
std::vector<std::vector<PostureEffort>> efforts_of(const Problem& problem) {
  const PostureGrid& grid = study_of(problem).grid;
  PostureStatics statics(*system_of(problem), grid, problem.parameters(), {});
  EXPECT_TRUE(statics.begin(posture(grid, 0)).ok());
  std::vector<std::vector<PostureEffort>> all(count_postures(grid));
  Frame frame;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Status status = statics.show(posture(grid, k), &frame, &all[k]);
    EXPECT_TRUE(status.ok()) << status.cause;
  }
  return all;
}

TEST(PostureGrid, HasEveryCombination) {
  const PostureGrid grid = {{"a", {1.0, 2.0}, {}}, {"b", {5.0, 6.0, 7.0}, {}}};
  ASSERT_EQ(count_postures(grid), 6U);
  EXPECT_EQ(posture(grid, 0), Eigen::Vector2d(1.0, 5.0));
  EXPECT_EQ(posture(grid, 2), Eigen::Vector2d(1.0, 7.0));
  EXPECT_EQ(posture(grid, 3), Eigen::Vector2d(2.0, 5.0));
  EXPECT_EQ(count_postures({}), 0U);
}

TEST(PostureEffort, HoldsWithTheLeastMagnitude) {
  EXPECT_EQ((PostureEffort{3.0, 2.0, 4.0}).holding(), 2.0);
  EXPECT_EQ((PostureEffort{-3.0, -4.0, -2.0}).holding(), -2.0);
  EXPECT_EQ((PostureEffort{1.0, -1.0, 3.0}).holding(), 0.0);
}

// Coulomb friction of 0.5 N m; the damping of 0.3 N m s/rad does not count at rest.
TEST(PostureStatics, HoldsAPendulum) {
  const Problem problem =
      loaded(pendulum_urdf(), "duration: 1\nefforts: {grid: {hinge: [-0.5, 0.0, 0.02, 1.0]}}\n");
  const auto efforts = efforts_of(problem);
  const double angles[] = {-0.5, 0.0, 0.02, 1.0};
  for (std::size_t k = 0; k < 4; ++k) {
    const double rest = 2.0 * kGravity * 0.5 * std::sin(angles[k]);
    EXPECT_NEAR(efforts[k][0].rest, rest, 1e-12);
    EXPECT_NEAR(efforts[k][0].upper, rest + 0.5, 1e-9);
    EXPECT_NEAR(efforts[k][0].lower, rest - 0.5, 1e-9);
  }
  EXPECT_EQ(efforts[2][0].holding(), 0.0) << "friction holds alone";
  EXPECT_NEAR(efforts[3][0].holding(), kGravity * std::sin(1.0) - 0.5, 1e-9);
}

// Friction of a pin by the load that it carries, with its static coefficient: of a law with states,
// too, whose states no posture determines.
TEST(PostureStatics, SlipsAtTheStaticCoefficient) {
  constexpr double kWeight = 2.0 * kGravity, kSmoothing = 1e-6;
  for (const std::string law : {"brown_mcphee", "gonthier", "lugre"}) {
    const std::string friction = "<codesign:friction model=\"" + law +
                                 R"(" mu_static="0.3" mu_dynamic="0.1" joint_length="0.1"
         pin_radius="0.02" preload="5" smoothing="1e-6"/>)";
    const Problem problem = loaded(
        "<robot name=\"p\" xmlns:codesign=\"urn:mechanism_codesign\"><link name=\"base\"/>" +
            body("bar", 2.0, "0 0 -0.5") +
            joint("hinge", "continuous", "base", "bar", "0 0 0", "0 1 0", friction) + "</robot>",
        "duration: 1\nefforts: {grid: {hinge: [0.7]}}\n");
    const PostureEffort effort = efforts_of(problem)[0][0];
    const double normal =
        kPi * kPi * kPi / 24.0 * (std::hypot(kWeight, kSmoothing) + kSmoothing) + 5.0 + kSmoothing;
    const double rest = 0.5 * kWeight * std::sin(0.7);
    EXPECT_NEAR(effort.rest, rest, 1e-12) << law;
    EXPECT_NEAR(effort.upper, rest + 0.02 * 0.3 * normal, 1e-9) << law;
    EXPECT_NEAR(effort.lower, rest - 0.02 * 0.3 * normal, 1e-9) << law;
  }
}

// Each joint begins to move while the other rests: the friction of the other does not count.
TEST(PostureStatics, HoldsAnArmOfTwoLinks) {
  const Problem problem = loaded(arm_urdf(),
                                 "duration: 1\nefforts: {grid: {elbow: [0.4, -1.1], shoulder: "
                                 "{from: -1, to: 2, count: 4}}}\n");
  const auto efforts = efforts_of(problem);
  ASSERT_EQ(efforts.size(), 8U);
  for (std::size_t k = 0; k < efforts.size(); ++k) {
    const Eigen::VectorXd at = posture(study_of(problem).grid, k);
    const double elbow = 2.0 * kGravity * 0.2 * std::sin(at[0] + at[1]),
                 shoulder = 2.0 * kGravity * (0.2 + 0.4) * std::sin(at[1]) + elbow;
    EXPECT_NEAR(efforts[k][0].rest, elbow, 1e-12);
    EXPECT_NEAR(efforts[k][1].rest, shoulder, 1e-12);
    EXPECT_NEAR(efforts[k][0].upper, elbow + 0.5, 1e-9);
    EXPECT_NEAR(efforts[k][1].lower, shoulder - 0.5, 1e-9);
  }
}

constexpr const char* kPress =
    "duration: 1\ngravity: [0, 0, 0]\ninitial_state: {slider_joint: {guess: 0.35}}\n"
    "loads: [{joint: slider_joint, effort: -10}]\nefforts: {grid: {crank_joint: [0.3, 1.2, "
    "2.4]}}\n";

/// The torque of the crank against a load of 10 N that pushes the slider to it, where the guide
/// rubs with mu: the rod's force S has S cos(phi) = 10 -+ mu S sin(phi).
double crank_torque(double angle, double mu, double direction) {
  const double phi = std::asin(std::sin(angle) / 3.0);
  return -0.1 * std::sin(angle + phi) * 10.0 / (std::cos(phi) + direction * mu * std::sin(phi));
}

std::string guide(const std::string& mu) {
  return "<codesign:friction mu_static=\"" + mu +
         R"(" mu_dynamic="0.1" joint_length="0.1" joint_width="0.05" smoothing="1e-9"/>)";
}

TEST(PostureStatics, HoldsASliderCrankWithAndWithoutFriction) {
  const auto efforts = efforts_of(loaded(planar_slider_crank(guide("0.3")), kPress));
  const double angles[] = {0.3, 1.2, 2.4};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(efforts[k][0].rest, crank_torque(angles[k], 0.0, 1.0), 1e-9);
    EXPECT_NEAR(efforts[k][0].upper, crank_torque(angles[k], 0.3, 1.0), 1e-8);
    EXPECT_NEAR(efforts[k][0].lower, crank_torque(angles[k], 0.3, -1.0), 1e-8);
  }
}

// Where tan(phi) is more than 1/mu the rod presses the slider against its guide harder than it
// pushes it: no torque of the crank moves the slider outwards.
TEST(PostureStatics, LocksWhereFrictionGrowsFasterThanTheEffort) {
  const auto efforts = efforts_of(loaded(planar_slider_crank(guide("4")), kPress));
  EXPECT_NEAR(efforts[0][0].lower, crank_torque(0.3, 4.0, -1.0), 1e-7);
  EXPECT_EQ(efforts[1][0].lower, -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(efforts[1][0].upper, crank_torque(1.2, 4.0, 1.0), 1e-8);
}

// A power of the speed below one is large beside the speed; friction at rest has none of it.
TEST(PostureStatics, ViscousFrictionWithAnExponentDoesNotHold) {
  std::string urdf = pendulum_urdf();
  const std::string end = "</joint>";
  urdf.insert(urdf.find(end),
              "<codesign:friction coulomb=\"0\" viscous=\"1\" "
              "viscous_exponent=\"0.1\"/>");
  const auto efforts = efforts_of(loaded(urdf, "duration: 1\nefforts: {grid: {hinge: [0.0]}}\n"));
  EXPECT_NEAR(efforts[0][0].upper, 0.5, 1e-9) << "the constant friction alone";
}

// To lift, the motor needs 1/eta of the torque; when the load drives, eta_b of it holds.
TEST(PostureStatics, BreaksAwayAgainstTheLossesOfAGear) {
  std::string urdf = pendulum_urdf();
  urdf.insert(urdf.find("</joint>"),
              R"(<codesign:actuator gear_ratio="10" rotor_inertia="1e-5" efficiency="0.8"
                 backdrive_efficiency="0.6" smoothing="1e-6"/>)");
  const auto efforts = efforts_of(loaded(urdf, "duration: 1\nefforts: {grid: {hinge: [1.0]}}\n"));
  const double weight = kGravity * std::sin(1.0);
  EXPECT_NEAR(efforts[0][0].upper, (weight + 0.5) / 0.8, 1e-8);
  EXPECT_NEAR(efforts[0][0].lower, (weight - 0.5) * 0.6, 1e-8);
}

TEST(PostureStatics, RefusesAGridThatDoesNotDetermineThePosture) {
  const auto statics = [](const std::string& urdf, const std::string& grid) {
    return refused([&] {
      const Problem problem = loaded(urdf, "duration: 1\nefforts: {grid: " + grid + "}\n");
      PostureStatics(*system_of(problem), study_of(problem).grid, problem.parameters(), {});
    });
  };
  const std::string open = statics(arm_urdf(), "{shoulder: [0.1]}");
  EXPECT_NE(open.find("model.urdf:1: <joint name=\"elbow\">: its position is not determined"),
            std::string::npos)
      << open;
  EXPECT_NE(open.find("in efforts.grid"), std::string::npos) << open;
  const std::string many =
      statics(planar_slider_crank(), "{crank_joint: [0.3], slider_joint: [0.35]}");
  EXPECT_NE(many.find("study.yaml:2: efforts.grid: more joints have an effort"), std::string::npos)
      << many;
}

}  // namespace
}  // namespace codesign
