// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/machine_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/design.h"
#include "equations/compiled_system.h"
#include "math/differences.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Units in which a machine is written: how large one kilogram, metre and second are.
struct Units {
  double mass = 1.0, length = 1.0, time = 1.0;

  double force() const { return mass * length / (time * time); }
  double torque() const { return force() * length; }
  double inertia() const { return mass * length * length; }
  double speed() const { return length / time; }
};

std::string scaled(double value, double unit) { return to_decimal(value * unit); }

std::string body_in(const Units& u, const std::string& name, double mass) {
  const std::string J = scaled(0.02 * mass, u.inertia());
  return "<link name='" + name + "'><inertial><origin xyz='0 0 " + scaled(-0.3, u.length) +
         "'/><mass value='" + scaled(mass, u.mass) + "'/><inertia ixx='" + J +
         "' ixy='0' ixz='0' iyy='" + J + "' iyz='0' izz='" + J + "'/></inertial></link>";
}

/// A sledge with friction and stops, on it a hinge with a lossy gear, friction and stops.
std::string sledge_and_arm(const Units& u) {
  return "<robot name='m' xmlns:codesign='urn:m'><link name='ground'/>" +
         body_in(u, "sledge", 3.0) + body_in(u, "arm", 2.0) +
         "<joint name='slide' type='prismatic'><parent link='ground'/><child link='sledge'/><axis "
         "xyz='1 0 0'/><limit lower='" +
         scaled(-0.4, u.length) + "' upper='" + scaled(0.6, u.length) + "' effort='" +
         scaled(200.0, u.force()) + "' velocity='" + scaled(2.0, u.speed()) +
         "'/><codesign:friction mu_static='0.2' mu_dynamic='0.15' transition_velocity='" +
         scaled(0.01, u.speed()) + "' joint_length='" + scaled(0.2, u.length) + "' joint_width='" +
         scaled(0.1, u.length) +
         "'/></joint><joint name='hinge' type='revolute'><parent link='sledge'/><child link='arm'/>"
         "<axis xyz='0 1 0'/><limit lower='-1' upper='2' effort='" +
         scaled(30.0, u.torque()) + "' velocity='" + scaled(5.0, 1.0 / u.time) +
         "'/><codesign:friction mu_static='0.2' mu_dynamic='0.15' transition_velocity='" +
         scaled(0.01, u.speed()) + "' joint_length='" + scaled(0.05, u.length) + "' pin_radius='" +
         scaled(0.01, u.length) + "'/><codesign:actuator gear_ratio='10' rotor_inertia='" +
         scaled(1e-4, u.inertia()) + "' efficiency='0.9' transition_velocity='" +
         scaled(0.01, 1.0 / u.time) + "'/></joint></robot>";
}

std::string study_in(const Units& u, double gravity, const std::string& limits = "") {
  return "duration: " + scaled(0.8, u.time) + "\ngravity: [0, 0, " +
         scaled(-gravity, u.length / (u.time * u.time)) +
         "]\ninitial_state: {slide: {velocity: " + scaled(0.5, u.speed()) +
         "}}\nlimits: {position: true" + limits + "}\n";
}

/// The numbers that follow the machine, in the order of machine_numbers().
std::vector<MachineNumber> numbers_of(const std::string& urdf, const std::string& study_text) {
  const RobotDescription robot = read_urdf({"m.urdf", urdf});
  const Study study = read_study({"m.yaml", study_text}, robot);
  const CompiledSystem system(robot, study);
  Design<double> design;
  design.set(system, system.parameters());
  return machine_numbers(system.robot(), system.topology(), system.study(), design.constants);
}

/// The unit of a number in base units.
double unit_of(const MachineNumber& number, const Units& u) {
  if (number.unit == "N") return u.force();
  if (number.unit == "N m" || number.unit == "N m/rad") return u.torque();
  if (number.unit == "N/m") return u.force() / u.length;
  if (number.unit == "s/m") return 1.0 / u.speed();
  if (number.unit == "s/rad") return u.time;
  return number.unit == "m" ? u.length : 1.0;
}

TEST(MachineNumbers, TheSameMachineInOtherUnitsHasTheSameNumbers) {
  for (const double gravity : {9.81, 0.0}) {
    const auto usual = numbers_of(sledge_and_arm({}), study_in({}, gravity));
    ASSERT_EQ(usual.size(), 9U);  // two bearings, a gear, two times three numbers of stops
    for (const Units& u : {Units{1e-3, 1.0, 1.0}, Units{1.0, 1e-3, 1.0}, Units{1.0, 1.0, 1e-3},
                           Units{1e4, 10.0, 100.0}, Units{1e-12, 1e-5, 1e-4}}) {
      const auto other = numbers_of(sledge_and_arm(u), study_in(u, gravity));
      ASSERT_EQ(other.size(), usual.size());
      for (std::size_t k = 0; k < usual.size(); ++k)
        EXPECT_NEAR(other[k].value / unit_of(other[k], u) / usual[k].value, 1.0, 1e-9)
            << gravity << ' ' << usual[k].joint << ' ' << usual[k].number;
    }
  }
}

double value_of(const std::vector<MachineNumber>& numbers, const std::string& joint,
                const std::string& number) {
  for (const MachineNumber& one : numbers)
    if (one.joint == joint && one.number == number) return one.value;
  return -1.0;
}

TEST(MachineNumbers, ByHand) {
  const auto numbers = numbers_of(sledge_and_arm({}), study_in({}, 9.81));
  EXPECT_NEAR(value_of(numbers, "slide", "smoothing"), 1e-5 * 5.0 * 9.81, 1e-12);
  EXPECT_NEAR(value_of(numbers, "hinge", "smoothing"), 1e-5 * 2.0 * 9.81, 1e-12);
  // 2 kg at 0.3 m, and 0.04 kg m^2: 0.22 kg m^2 about the hinge, the whole machine 0.58 m^2 kg
  // about the ground's origin, which counts a millionth.
  const double torque = 9.81 * std::sqrt(2.0 * (0.22 + 1e-6 * 0.55));
  EXPECT_NEAR(value_of(numbers, "hinge", "gear smoothing"), 1e-5 * torque * 30.0 / (torque + 30.0),
              1e-11);
  EXPECT_NEAR(value_of(numbers, "slide", "stop width"), 1e-3, 1e-15);
  EXPECT_NEAR(value_of(numbers, "hinge", "stop width"), 3e-3, 1e-15);
  const double slow = 2.0 * 9.81 + std::pow(10.0 / 0.8, 2) + 0.25;
  EXPECT_NEAR(value_of(numbers, "slide", "stop dissipation"), 4.0 / std::sqrt(slow), 1e-12);
  const double cap = std::pow(1e5 / 0.8, 2), by_speed = 4.0 * cap / (4.0 + cap),
               by_effort = 80.0 * cap / (80.0 + cap);
  EXPECT_NEAR(value_of(numbers, "slide", "stop stiffness"),
              5.0 * (slow + by_speed + by_effort) / 1e-4, 1e-3);
}

TEST(MachineNumbers, WhatIsGivenCounts) {
  const auto numbers =
      numbers_of(sledge_and_arm({}), study_in({}, 9.81, ", stiffness: 50, dissipation: 0"));
  EXPECT_EQ(numbers.size(), 5U);
  EXPECT_EQ(value_of(numbers, "slide", "stop stiffness"), -1.0);
  EXPECT_GT(value_of(numbers, "slide", "stop width"), 0.0);
  std::string smooth = sledge_and_arm({});
  for (const char* before : {"joint_width", "pin_radius", "efficiency"}) {
    const std::size_t at = smooth.find(before);
    smooth.insert(at, "smoothing='0.25' ");
  }
  EXPECT_EQ(
      numbers_of(smooth, study_in({}, 9.81, ", stiffness: 50, dissipation: 0, width: 1e-4")).size(),
      0U);
}

TEST(MachineNumbers, FollowTheDesignExactly) {
  // A parameter scales the mass of the arm; all numbers are its functions.
  std::string urdf = sledge_and_arm({});
  const std::string plain = "<mass value='2'/>";
  urdf.replace(urdf.find(plain), plain.size(), "<mass value='2' codesign:value='${load}'/>");
  urdf.insert(urdf.find("<link name='ground'/>"), "<codesign:parameter name='load' value='2'/>");
  const RobotDescription robot = read_urdf({"m.urdf", urdf});
  const CompiledSystem system(
      robot, read_study({"m.yaml", study_in({}, 9.81) +
                                       "parameters: {load: {lower: 1, upper: 4}}\n"
                                       "objective: {integral: [{signal: slide/position}]}\n"},
                        robot));
  const auto smoothing_at = [&](double load) {
    Design<double> design;
    design.set(system, {load});
    return design.constants.pairs[0].friction.smoothing;
  };
  EXPECT_NEAR(ridders_derivative(smoothing_at, 2.0, 0.5).value, 1e-5 * 9.81, 1e-13);
}

}  // namespace
}  // namespace codesign
