// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Motions that are given: the effort against closed forms, in both coordinates and by both
// integrators.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "integration/driven_slides.h"

namespace codesign {
namespace {

constexpr double kEarth = 9.81;

class MotionGiven : public ::testing::TestWithParam<const char*> {
 protected:
  std::string solver(double tolerance = 1e-9) const {
    return std::string("solver: {") + GetParam() +
           ", relative_tolerance: " + std::to_string(tolerance * 1e9) + "e-9" +
           ", absolute_tolerance: " + std::to_string(tolerance * 1e8) + "e-9}\n";
  }
};

class MotionGivenToLoops : public MotionGiven {};

// Two bars that swing and a coupler that they carry around: (2 (I + 1/4) + 1) theta'' + 2 g sin
// theta.
double parallelogram_effort(double position, double acceleration) {
  return (2.0 * (0.0834 + 0.25) + 1.0) * acceleration + 2.0 * kEarth * std::sin(position);
}

TEST_P(MotionGivenToLoops, OfALoopsJointTakesTheEffortOfItsClosedForm) {
  const double t = 0.8, position = 0.3 + 0.5 * std::sin(3.0 * t), rate = 1.5 * std::cos(3.0 * t);
  const std::vector<double> s =
      end_of(four_bar(),
             "duration: 1.0\ninitial_state: {right_hinge: {guess: 0.3}}\n"
             "motion: {left_hinge: {position: \"${0.3 + 0.5*sin(3*t)}\"}}\n" +
                 solver(),
             t,
             {"left_hinge/position", "left_hinge/velocity", "right_hinge/position",
              "left_hinge/effort", "left_hinge/actuator_power", "mechanism/actuator_power"});
  const double effort = parallelogram_effort(position, -4.5 * std::sin(3.0 * t));
  EXPECT_NEAR(s[0], position, 1e-10);
  EXPECT_NEAR(s[1], rate, 1e-9);
  EXPECT_NEAR(s[2], position, 1e-9);
  EXPECT_NEAR(s[3], effort, 2e-6 * std::abs(effort));
  EXPECT_NEAR(s[4], effort * rate, 2e-6 * std::abs(effort));
  EXPECT_NEAR(s[5], s[4], 1e-9);
}

TEST_P(MotionGivenToLoops, TurnsAtConstantSpeedManyTimes) {
  const double t = 3.0, position = 0.2 + 7.0 * t;
  const std::vector<double> s =
      end_of(four_bar(),
             "duration: 3.0\ninitial_state: {left_hinge: {position: 0.2}, right_hinge: {guess: "
             "0.2}}\nmotion: {left_hinge: {velocity: 7.0}}\n" +
                 solver(),
             t, {"left_hinge/position", "left_hinge/effort"});
  EXPECT_NEAR(s[0], position, 1e-9 * position);
  EXPECT_NEAR(s[1], parallelogram_effort(position, 0.0), 5e-5);
}

// The pin of the loop itself is at -pi/2 - theta in the parallelogram.
TEST_P(MotionGivenToLoops, OfTheLoopsOwnJoint) {
  const double t = 0.6, position = 0.3 + 0.5 * std::sin(3.0 * t);
  const std::vector<double> s =
      end_of(four_bar(),
             "duration: 1.0\ninitial_state: {left_hinge: {guess: 0.3}, right_hinge: {guess: "
             "0.3}, left_pin: {guess: -0.3}}\n"
             "motion: {right_pin: {position: \"${-pi/2 - 0.3 - 0.5*sin(3*t)}\"}}\n" +
                 solver(),
             t, {"left_hinge/position", "right_pin/effort"});
  EXPECT_NEAR(s[0], position, 1e-8);
  // The same power at the opposite rate.
  const double effort = -parallelogram_effort(position, -4.5 * std::sin(3.0 * t));
  EXPECT_NEAR(s[1], effort, 1e-5 * std::abs(effort));
}

std::string spring_between(const std::string& name, const std::string& from, const std::string& to,
                           double stiffness, double damping) {
  return "<codesign:spring_damper name='" + name + "' stiffness='" + std::to_string(stiffness) +
         "' damping='" + std::to_string(damping) + "' free_length='1'><predecessor link='" + from +
         "'/><successor link='" + to + "'/></codesign:spring_damper>";
}

// After the transient a quarter car follows the harmonic road by its complex transfer functions.
TEST_P(MotionGiven, OfARoadMovesAQuarterCarByItsTransferFunction) {
  using Complex = std::complex<double>;
  const double wheel = 40.0, body = 300.0, k = 20000.0, c = 4000.0, tyre = 150000.0, w = 9.0,
               amplitude = 0.03, t = 4.0;
  const Complex i(0.0, 1.0), s = k + i * w * c;
  const Complex ratio = s / (s - body * w * w);  // body over wheel
  const Complex up = tyre / (tyre + s - wheel * w * w - s * ratio);
  const auto at = [&](const Complex& gain) {
    return (gain * amplitude * std::exp(i * w * t)).imag();
  };
  const std::vector<double> values = end_of(
      robot(mass("road", 1.0) + mass("wheel", wheel) + mass("body", body) +
            lift("road_height", "road", 0.0) + lift("wheel_height", "wheel", 1.0) +
            lift("body_height", "body", 2.0) + spring_between("tyre", "road", "wheel", tyre, 0.0) +
            spring_between("strut", "wheel", "body", k, c)),
      "duration: 4.0\ngravity: [0, 0, 0]\nmotion: {road_height: {position: {type: sine, "
      "amplitude: 0.03, frequency: " +
          std::to_string(w / (2.0 * M_PI) * 1e6) + "e-6}}}\n" + solver(),
      t,
      {"wheel_height/position", "body_height/position", "road_height/effort", "tyre/force",
       "tyre/length", "strut/speed"});
  EXPECT_NEAR(values[0], at(up), 1e-8);
  EXPECT_NEAR(values[1], at(up * ratio), 1e-8);
  const double force = tyre * (at(up) - at(1.0));
  EXPECT_NEAR(values[2], -force - 1.0 * w * w * at(1.0), 1e-5 * tyre * amplitude);
  EXPECT_NEAR(values[3], force, 1e-5 * tyre * amplitude);
  EXPECT_NEAR(values[4], 1.0 + at(up) - at(1.0), 1e-8);
  EXPECT_NEAR(values[5], at(i * w * (up * ratio - up)), 1e-6);
}

// A follower on a spring leaves its cam where the effort that the lift needs becomes negative, at
// the top of y = h/2 (1 - cos wt) for w^2 > 2 (k (h + d) + m g)/(m h).
TEST_P(MotionGiven, OfACamNeedsNoPullBelowTheSpeedOfJump) {
  const double m = 0.5, k = 2000.0, h = 0.02, d = 0.01,
               jump = std::sqrt(2.0 * (k * (h + d) + m * kEarth) / (m * h));
  for (const double speed : {0.99 * jump, 1.01 * jump}) {
    const double top = M_PI / speed;
    const std::string model =
        robot(mass("follower", m) + lift("lift", "follower", 0.0) +
              "<codesign:spring_damper name='return' stiffness='2000' damping='0' "
              "free_length='1'><predecessor link='ground'><origin xyz='0 0 0.99'/></predecessor>"
              "<successor link='follower'/></codesign:spring_damper>");
    const double force =
        end_of(model,
               "duration: 1.0\nparameters: {w: {initial: " + std::to_string(speed * 1e6) +
                   "e-6, tune: false}}\nmotion: {lift: {position: "
                   "\"${0.01*(1 - cos(w*t))}\"}}\n" +
                   solver(),
               top, {"lift/effort"})[0];
    EXPECT_EQ(force > 0.0, speed < jump) << speed;
    EXPECT_NEAR(force, k * (h + d) + m * kEarth - 0.5 * m * h * speed * speed, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, MotionGiven,
                         ::testing::Values("coordinates: absolute, method: rodas5p",
                                           "coordinates: joint, method: rodas5p",
                                           "coordinates: joint, method: dopri5",
                                           "coordinates: absolute, integrator: idas"));

// The parallelogram has three redundant constraints.
INSTANTIATE_TEST_SUITE_P(Solvers, MotionGivenToLoops,
                         ::testing::Values("coordinates: absolute, method: rodas5p",
                                           "coordinates: joint, method: rodas5p",
                                           "coordinates: joint, method: dopri5"));

void expect_refused_motion(const std::string& study, const std::string& message) {
  try {
    compile(four_bar(), study);
    ADD_FAILURE() << study;
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "motion.right_hinge") << error.what();
    EXPECT_NE(error.fault().message.find(message), std::string::npos) << error.what();
  }
}

TEST(GivenMotions, AreRefusedIfOthersDetermineThem) {
  expect_refused_motion(
      "duration: 1.0\nmotion: {left_hinge: {position: 0.3}, right_hinge: {position: 0.3}}\n",
      "determine the motion of this joint already");
}

TEST(GivenMotions, AreRefusedByIdasWithRedundantConstraints) {
  EXPECT_THROW(compile(four_bar(),
                       "duration: 1.0\nmotion: {left_hinge: {position: 0.3}}\nsolver: {integrator: "
                       "idas}\n"),
               InputError);
}

TEST(GivenMotions, HaveNoRateOfTheirEffort) {
  EXPECT_THROW(compile(four_bar(),
                       "duration: 1.0\nmotion: {left_hinge: {position: 0.3}}\nobjective: "
                       "{integral: [{signal: left_hinge/effort_rate}]}\n"),
               InputError);
}

// The only constraint is the given motion, whose row bends along no motion but by rounding.
TEST(GivenMotions, LeaveTheOtherJointsAtRest) {
  const std::string arm = robot(
      bar("upper") + bar("lower") +
      "<joint name='turn' type='continuous'><parent link='ground'/><child link='upper'/><axis "
      "xyz='0.2 0 1'/></joint><joint name='swing' type='continuous'><parent link='upper'/><child "
      "link='lower'/><origin xyz='0.3 0 0'/><axis xyz='1 0 0'/></joint>");
  const auto ends = [&arm](const char* coordinates, double t) {
    return end_of(arm,
                  std::string("duration: 1.0\nmotion: {turn: {position: {type: sine, amplitude: "
                              "0.8, frequency: 0.5, phase: 0.2}}}\nsolver: {relative_tolerance: "
                              "1.0e-9, absolute_tolerance: 1.0e-9, coordinates: ") +
                      coordinates + "}\n",
                  t, {"swing/velocity", "swing/position", "turn/effort"});
  };
  for (const double t : {0.0, 0.25}) {
    const std::vector<double> own = ends("joint", t), all = ends("absolute", t);
    for (std::size_t k = 0; k < own.size(); ++k) EXPECT_NEAR(all[k], own[k], 1e-6) << t << k;
  }
}

}  // namespace
}  // namespace codesign
