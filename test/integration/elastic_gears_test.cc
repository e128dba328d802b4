// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gears between a motor and a joint that move apart, against closed forms and a model of links and
// springs; doc/theory.md (9c).
#include <gtest/gtest.h>
#include <cmath>

#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "integration/driven_slides.h"
#include "integration/energy_balance.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

const char* const kEither[] = {"joint", "absolute"};
constexpr const char* kExact =
    "method: rodas5p, relative_tolerance: 1e-11, absolute_tolerance: 1e-13, coordinates: ";

// A load of 0.5 behind a motor of 20^2 * 5e-4 = 0.2, both at the joint: kg m^2, or kg on a slide.
constexpr double kLoadMass = 0.5, kRotorMass = 0.2, kStiffness = 300.0;

std::string drive(const std::string& type, const std::string& gear) {
  return robot(
      "<link name='load'><inertial><mass value='0.5'/><inertia ixx='0.5' ixy='0' ixz='0' "
      "iyy='0.5' iyz='0' izz='0.5'/></inertial></link><joint name='axis' type='" +
      type +
      "'><parent link='ground'/><child link='load'/><axis xyz='0 0 1'/><limit effort='50' "
      "velocity='0' lower='-9' upper='9'/><codesign:actuator gear_ratio='-20' "
      "rotor_inertia='5e-4' stiffness='300' " +
      gear + "/></joint>");
}

std::string drive_study(const std::string& more, const std::string& coordinates) {
  return "duration: 20.0\ngravity: [0, 0, 0]\n" + more + "\nsolver: {" + kExact + coordinates +
         "}\n";
}

// The load pushed from rest: x'' = -w^2 x - F/J_l with w^2 = k (1/J_m + 1/J_l), and the centre of
// both inertias moves as under the force alone.
TEST(ElasticGear, ResonatesWithBothInertias) {
  const double push = 4.0, t = 0.37,
               w = std::sqrt(kStiffness * (1.0 / kRotorMass + 1.0 / kLoadMass)),
               x = -push / (kLoadMass * w * w) * (1.0 - std::cos(w * t)),
               position = (0.5 * push * t * t - kRotorMass * x) / (kLoadMass + kRotorMass);
  for (const char* type : {"revolute", "continuous", "prismatic"})
    for (const char* coordinates : kEither) {
      const std::vector<double> y = end_of(
          drive(type, ""), drive_study("loads: [{joint: axis, effort: 4.0}]", coordinates), t,
          {"axis/position", "axis/gear_deflection", "axis/gear_torque", "axis/motor_position",
           "axis/motor_speed", "axis/velocity"});
      EXPECT_NEAR(y[0], position, 1e-9) << type << coordinates;
      EXPECT_NEAR(y[1], x, 1e-9);
      EXPECT_NEAR(y[2], kStiffness * x, 1e-6);
      EXPECT_NEAR(y[3], -20.0 * (position + x), 1e-8) << "at the motor's shaft";
      const double x_rate = -push / (kLoadMass * w) * std::sin(w * t);
      EXPECT_NEAR(y[4], -20.0 * (push * t + kLoadMass * x_rate) / (kLoadMass + kRotorMass), 1e-7);
      EXPECT_NEAR(y[5], (push * t - kRotorMass * x_rate) / (kLoadMass + kRotorMass), 1e-8);
    }
}

// A motor that shakes at sqrt(k/J_l), where its own answer to the shaking vanishes: theta = U w_a/
// (J_m w^2) (t - sin(w t)/w) has no part of that frequency.
TEST(ElasticGear, HasItsAntiresonanceAtTheLoadsFrequency) {
  const double torque = 2.0, t = 0.61, w_a = std::sqrt(kStiffness / kLoadMass),
               w = std::sqrt(kStiffness * (1.0 / kRotorMass + 1.0 / kLoadMass)),
               motor = torque * w_a / (kRotorMass * w * w) * (t - std::sin(w * t) / w),
               both = torque / (w_a * w_a) * (w_a * t - std::sin(w_a * t));
  for (const char* coordinates : kEither) {
    const std::vector<double> y =
        end_of(drive("continuous", ""),
               drive_study("controllers: {motor: {type: state_feedback, output: axis, feedforward: "
                           "{type: sine, amplitude: 2.0, frequency: " +
                               std::to_string(w_a / (2.0 * M_PI) * 1e9) + "e-9}}}",
                           coordinates),
               t, {"axis/motor_position", "axis/position", "axis/effort", "axis/motor_torque"});
    EXPECT_NEAR(y[0], -20.0 * motor, 1e-7) << coordinates;
    EXPECT_NEAR(y[1], (both - kRotorMass * motor) / kLoadMass, 1e-8);
    EXPECT_NEAR(y[2], torque * std::sin(w_a * t), 1e-6) << "the controller acts on the motor";
    EXPECT_NEAR(y[3], -torque * std::sin(w_a * t) / 20.0, 1e-7);
  }
}

// A motor held by a spring P of its controller: theta = F/P, and the joint is F/k and half of the
// play further.
TEST(ElasticGear, YieldsAtRestByTorqueOverStiffnessAndHalfThePlay) {
  for (const double backlash : {0.0, 0.06})
    for (const double push : {3.0, -3.0}) {
      const std::string gear =
          "damping='6' viscous='0.01'" +
          (backlash > 0.0 ? " backlash='" + std::to_string(backlash) + "'" : std::string());
      const std::vector<double> y = end_of(
          drive("continuous", gear),
          drive_study(
              "loads: [{joint: axis, effort: " + std::to_string(push) +
                  "}]\ncontrollers: {hold: {type: pid, input: axis/position + "
                  "axis/gear_deflection, setpoint: 0.0, output: axis, gains: {p: 150.0, d: 20.0}}}",
              "joint"),
          20.0, {"axis/position", "axis/motor_position", "axis/gear_torque", "axis/effort"});
      const double further = push / kStiffness + std::copysign(0.5 * backlash, push);
      EXPECT_NEAR(y[0], push / 150.0 + further, 1e-8) << backlash << " " << push;
      EXPECT_NEAR(y[1], -20.0 * push / 150.0, 1e-7);
      EXPECT_NEAR(y[2], -push, 1e-6);
      EXPECT_NEAR(y[3], -push, 1e-6);
    }
}

// Within its play a joint flies freely, from flank to flank at the same speed.
TEST(ElasticGear, TransmitsNothingInTheGap) {
  const std::vector<double> y = end_of(
      drive("prismatic", "damping='50' backlash='0.1'"),
      drive_study("initial_state: {axis: {velocity: 0.0}}\nloads: [{joint: axis, effort: 1.0}]",
                  "absolute"),
      0.02, {"axis/position", "axis/gear_torque", "axis/motor_speed"});
  EXPECT_NEAR(y[0], 0.5 * 1.0 / kLoadMass * 0.02 * 0.02, 1e-12);
  EXPECT_EQ(y[1], 0.0);
  EXPECT_NEAR(y[2], 0.0, 1e-14);
}

/// An arm that turns about z and carries a motor for its forearm about a skew axis, by `elbow`; in
/// the other model the motor is a link of its own between two joints.
std::string arm(const std::string& motor_link, const std::string& elbow) {
  return robot(
      "<link name='arm'><inertial><origin xyz='0.2 0.1 0'/><mass value='2'/><inertia ixx='0.05' "
      "ixy='0' ixz='0.01' iyy='0.06' iyz='0' izz='0.04'/></inertial></link>"
      "<link name='motor'><inertial><mass value='0.7'/><inertia ixx='0.02' ixy='0' ixz='0' "
      "iyy='0.03' iyz='0' izz='0.02'/></inertial></link>" +
      bar("forearm") + hinge("base", "ground", "arm", "0 0 0") + motor_link + elbow);
}

std::string skew(const std::string& name, const std::string& type, const std::string& parent,
                 const std::string& child, const std::string& origin, const std::string& more) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin " + origin + "/><axis xyz='0 1 0'/>" + more +
         "</joint>";
}

TEST(ElasticGear, IsAMotorOfItsOwnWithASpringBehindIt) {
  const std::string place = "xyz='0.4 0 0.1' rpy='0.5 0 0.3'", here = "xyz='0 0 0'";
  // With a gear ratio of 1 the motor is a link that turns by theta, and the forearm hangs on it by
  // a joint with a torsion spring. In the arm's inertia the motor counts as if it did not turn.
  const std::string links = arm(skew("theta", "continuous", "arm", "motor", place, ""),
                                skew("x", "continuous", "motor", "forearm", here,
                                     "<codesign:torsion_spring stiffness='40' damping='0.3'/>"));
  const std::string gear =
      arm(skew("weld", "fixed", "arm", "motor", place, ""),
          skew("elbow", "continuous", "arm", "forearm", place,
               "<codesign:actuator rotor_inertia='0.03' stiffness='40' damping='0.3'/>"));
  const auto study = [](const std::string& start, const std::string& output, const char* kind) {
    return "duration: 1.0\ninitial_state: {base: {velocity: 3.0}, " + start +
           "}\ncontrollers: {torque: {type: state_feedback, output: " + output +
           ", feedforward: {type: sine, amplitude: 3.0, frequency: 2.0}}}\nsolver: {" + kExact +
           kind + "}\n";
  };
  for (const char* kind : kEither) {
    const std::vector<double> expected =
        end_of(links, study("theta: {position: 0.4, velocity: 1.0}", "theta", kind), 0.7,
               {"base/position", "theta/position", "x/position", "theta/velocity",
                "mechanism/total_energy", "mechanism/damping_power", "x/reaction_torque/x",
                "forearm/position/z"});
    const std::vector<double> y =
        end_of(gear, study("elbow: {position: 0.4, velocity: 1.0}", "elbow", kind), 0.7,
               {"base/position", "elbow/motor_position", "elbow/gear_deflection",
                "elbow/motor_speed", "mechanism/total_energy", "elbow/damping_power",
                "elbow/reaction_torque/x", "forearm/position/z"});
    for (std::size_t k = 0; k < y.size(); ++k)
      EXPECT_NEAR(y[k], k == 2 ? -expected[k] : expected[k], 1e-8) << k << kind;
  }
}

TEST(ElasticGear, IsTheRigidOneInTheLimit) {
  const auto arm_with = [](const std::string& stiffness) {
    return pendulum(
        "<codesign:actuator gear_ratio='30' rotor_inertia='1e-4' efficiency='0.8' "
        "coulomb='0.01' transition_velocity='0.3' " +
        stiffness + "/>");
  };
  const std::string study =
      "duration: 1.0\ninitial_state: {hinge: {position: 0.5}}\ncontrollers: {motor: {type: "
      "state_feedback, output: hinge, feedforward: {type: sine, amplitude: 6.0, frequency: 1.0}}}\n"
      "solver: {coordinates: joint, relative_tolerance: 1e-9, absolute_tolerance: 1e-11}\n";
  const std::vector<std::string> signals{"hinge/position", "hinge/gear_torque", "hinge/gear_loss",
                                         "hinge/motor_speed"};
  const std::vector<double> rigid = end_of(arm_with(""), study, 0.8, signals);
  double last = 1.0;
  for (const char* stiffness : {"stiffness='1e5' damping='30'", "stiffness='1e7' damping='300'"}) {
    const std::vector<double> y = end_of(arm_with(stiffness), study, 0.8, signals);
    double away = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) away = std::max(away, std::abs(y[k] - rigid[k]));
    EXPECT_LT(away, 0.1 * last) << "the difference falls with the stiffness";
    last = away;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(ElasticGear, KeepsTheBalanceOfEnergy) {
  const std::string gear =
      "<codesign:actuator gear_ratio='15' rotor_inertia='2e-3' efficiency='0.8' coulomb='0.02' "
      "viscous='1e-3' transition_velocity='0.2' stiffness='400' damping='2' backlash='0.05'/>";
  for (const char* coordinates : kEither) {
    const std::string study =
        "duration: 0.4\ninitial_state: {shoulder: {position: 1.0}, elbow: {velocity: "
        "2.0}}\nlimits: "
        "{effort: true}\ncontrollers: {servo: {type: pid, input: elbow/position, setpoint: 0.4, "
        "output: elbow, gains: {p: 60.0, d: 4.0}}}\nsolver: {method: rodas5p, relative_tolerance: "
        "1.0e-9, absolute_tolerance: 1.0e-10, coordinates: " +
        std::string(coordinates) + "}\n";
    const std::string urdf = robot(
        bar("upper") + bar("lower") + hinge("shoulder", "ground", "upper", "0 0 0", gear) +
        hinge("elbow", "upper", "lower", "0 0 -1", "<limit effort='9' velocity='4'/>" + gear));
    const Balance result = balance(urdf, study);
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_GT(result.friction_work, 0.1);
    EXPECT_NEAR(result.end, result.start + result.work, 2e-6) << coordinates;
  }
}

// A crank in a loop that shares reactions.
TEST(ElasticGear, DrivesALoop) {
  const std::string loop = four_bar(
      "<codesign:actuator gear_ratio='10' rotor_inertia='1e-3' stiffness='500' damping='1'/>");
  std::vector<double> first;
  for (const char* coordinates : kEither) {
    const std::string study =
        "duration: 0.6\ninitial_state: {left_hinge: {position: 0.3}}\ncontrollers: {motor: {type: "
        "state_feedback, output: left_hinge, feedforward: 8.0}}\nsolver: {" +
        std::string(kExact) + coordinates + "}\n";
    const std::vector<double> y =
        end_of(loop, study, 0.6,
               {"left_hinge/position", "left_hinge/gear_deflection", "right_hinge/position"});
    EXPECT_GT(std::abs(y[1]), 1e-4);
    if (first.empty()) first = y;
    for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(y[k], first[k], 1e-7);
  }
}

// Where the motion is given the motor moves with its joint: the effort is that of a rigid gear.
TEST(ElasticGear, IsRigidWhereTheMotionIsGiven) {
  const std::string study =
      "duration: 1.0\ngravity: [0, 0, 0]\nmotion: {axis: {position: {type: sine, amplitude: 0.5, "
      "frequency: 1.0}}}\n";
  const std::vector<double> y = end_of(drive("continuous", "efficiency='0.8'"), study, 0.2,
                                       {"axis/gear_deflection", "axis/motor_position",
                                        "axis/gear_torque", "axis/position", "axis/acceleration"});
  EXPECT_EQ(y[0], 0.0);
  EXPECT_NEAR(y[1], -20.0 * y[3], 1e-12);
  EXPECT_NEAR(y[2], kLoadMass * y[4], 1e-9);
  EXPECT_NEAR(y[4], -0.5 * 4.0 * M_PI * M_PI * std::sin(0.4 * M_PI), 1e-6);
}

TEST(ElasticGear, IsRefusedAtLoopsAndWhereNothingFollows) {
  const auto fault = [](const std::string& urdf) -> std::string {
    try {
      const RobotDescription robot = read_urdf({"test.urdf", urdf});
      make_system(robot, read_study({"t.yaml", "duration: 1.0\n"}, robot));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string actuator = "<codesign:actuator rotor_inertia='1' stiffness='9'/>";
  EXPECT_NE(fault(robot(bar("a") + hinge("j", "ground", "a", "0 0 0") +
                        "<loop name='l' type='continuous'><predecessor link='ground'><origin "
                        "xyz='0 0 -1'/></predecessor><successor link='a'><origin xyz='0 0 "
                        "-1'/></successor><axis xyz='0 1 0'/>" +
                        actuator + "</loop>"))
                .find("an elastic gear needs a joint of the tree"),
            std::string::npos);
  EXPECT_NE(fault(robot(bar("a") + "<link name='tool'/>" + hinge("j", "ground", "a", "0 0 0") +
                        hinge("t", "a", "tool", "0 0 -1", actuator)))
                .find("nothing with inertia resists"),
            std::string::npos);
}

}  // namespace
}  // namespace codesign
