// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The same machine in other units of mass, length and time moves the same way: no number that
// neither model nor study give has a unit of its own, theory (13i).
#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "integration/mechanisms.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "text/number_text.h"

namespace codesign {
namespace {

struct UnitSystem {
  double kg = 1.0, m = 1.0, s = 1.0;

  std::string length(double x) const { return to_decimal(x * m); }
  std::string speed(double x) const { return to_decimal(x * m / s); }
  std::string mass(double x) const { return to_decimal(x * kg); }
  std::string inertia(double x) const { return to_decimal(x * kg * m * m); }
  std::string torque(double x) const { return to_decimal(x * kg * m * m / (s * s)); }
};

/// @param arm of the centre of mass below the link frame.
std::string block_of(const UnitSystem& u, const std::string& name, double mass, double arm) {
  return "<link name='" + name + "'><inertial><origin xyz='0 0 " + u.length(-arm) +
         "'/><mass value='" + u.mass(mass) + "'/><inertia ixx='" + u.inertia(0.01) +
         "' ixy='0' ixz='0' iyy='" + u.inertia(0.01) + "' iyz='0' izz='" + u.inertia(0.01) +
         "'/></inertial></link>";
}

std::string slide_of(const UnitSystem& u, const std::string& stroke) {
  return "<joint name='slide' type='prismatic'><parent link='ground'/><child link='block'/><origin "
         "rpy='0 0.5 0'/><axis xyz='1 0 0'/><limit " +
         stroke +
         " effort='0' velocity='0'/><codesign:friction mu_static='0.3' mu_dynamic='0.3' "
         "transition_velocity='" +
         u.speed(0.01) + "' joint_length='" + u.length(0.2) + "' joint_width='" + u.length(0.1) +
         "'/></joint>";
}

std::string solver_of(const UnitSystem& u) {
  const double least = std::min({1.0, u.m, u.m / u.s, 1.0 / u.s});
  return "solver: {relative_tolerance: 1e-9, absolute_tolerance: " + to_decimal(1e-10 * least) +
         "}\n";
}

std::vector<double> last_signals(const std::string& urdf, const std::string& study_text,
                                 double duration, const std::vector<std::string>& names) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study({"test.yaml", study_text}, description);
  std::vector<SignalDescription> signals;
  for (const std::string& name : names)
    signals.push_back(parse_signal(name, {"test", 0}, "signal"));
  Simulation simulation = simulation_of(make_system(description, study), {}, signals);
  std::vector<double> last;
  const Status status = simulate(&simulation, duration, 2, [&](const Frame& frame) {
    last = frame.signals;
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return last;
}

const UnitSystem kSystems[] = {{1e-3, 1.0, 1.0},
                               {1e-6, 1e-3, 1.0},
                               {1e3, 1.0, 1.0},
                               {1.0, 1e-3, 0.0316227766016838},
                               {1e6, 100.0, 10.0}};

TEST(MachineUnits, GramsSlideAsTonnes) {
  for (const char* gravity : {"9.81", "0"}) {
    const auto at = [&](const UnitSystem& u) {
      const double g = std::stod(gravity);
      return last_signals(robot(block_of(u, "block", 1.0, 0.0) + slide_of(u, "")),
                          "duration: " + to_decimal(0.5 * u.s) + "\ngravity: [0, 0, " +
                              to_decimal(-g * u.m / (u.s * u.s)) +
                              "]\ninitial_state: {slide: {velocity: " + u.speed(0.4) + "}}\n" +
                              solver_of(u),
                          0.5 * u.s, {"slide/position"})[0];
    };
    const double usual = at({});
    if (*gravity == '9') {
      EXPECT_NEAR(usual, 0.2 + 0.125 * 9.81 * (std::sin(0.5) - 0.3 * std::cos(0.5)), 1e-3)
          << "as Coulomb says";
    }
    for (const UnitSystem& u : kSystems)
      EXPECT_NEAR(at(u) / u.m / usual, 1.0, 1e-6) << gravity << ' ' << u.kg << ' ' << u.m;
  }
}

TEST(MachineUnits, SmallGearsTurnAsLargeOnes) {
  const auto at = [](const UnitSystem& u) {
    return last_signals(
        robot(block_of(u, "arm", 1.0, 0.2) +
              "<joint name='hinge' type='continuous'><parent link='ground'/><child link='arm'/>"
              "<axis xyz='0 1 0'/><codesign:actuator gear_ratio='10' rotor_inertia='" +
              u.inertia(1e-5) + "' efficiency='0.8'/></joint>"),
        "duration: " + to_decimal(u.s) + "\ngravity: [0, 0, 0]\nloads: [{joint: hinge, effort: " +
            u.torque(0.1) + "}]\n" + solver_of(u),
        u.s, {"hinge/position"})[0];
  };
  const double usual = at({});
  EXPECT_GT(usual, 0.1);
  for (const UnitSystem& u : kSystems) EXPECT_NEAR(at(u) / usual, 1.0, 1e-6) << u.kg << ' ' << u.m;
}

TEST(MachineUnits, StopsOfMicrometresHoldAsThoseOfMetres) {
  const auto at = [](const UnitSystem& u) {
    return last_signals(
        robot(block_of(u, "block", 1.0, 0.0) +
              slide_of(u, "lower='" + u.length(-0.05) + "' upper='" + u.length(0.1) + "'")),
        "duration: " + to_decimal(0.4 * u.s) + "\ngravity: [0, 0, " +
            to_decimal(-9.81 * u.m / (u.s * u.s)) + "]\nlimits: {position: true}\n" + solver_of(u),
        0.4 * u.s, {"slide/position"})[0];
  };
  const double usual = at({});
  EXPECT_NEAR(usual, 0.1, 0.03) << "after the first impact";
  for (const UnitSystem& u : kSystems)
    EXPECT_NEAR(at(u) / u.m / usual, 1.0, 1e-5) << u.kg << ' ' << u.m;
}

/// How far a joint goes beyond its upper limit, over its range.
double beyond(const std::string& urdf, const std::string& more, double upper, double range) {
  double most = 0.0;
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study({"test.yaml", "limits: {position: true}\n" + more}, description);
  Simulation simulation = simulation_of(make_system(description, study), {},
                                        {parse_signal("joint/position", {"test", 0}, "signal")});
  EXPECT_TRUE(simulate(&simulation, study.duration, 2001, [&](const Frame& frame) {
                most = std::max(most, frame.signals[0] - upper);
                return true;
              }).ok());
  for (const StopExcess& excess : simulation.stops()) most = std::max(most, excess.worst - upper);
  return most / range;
}

std::string moved(const std::string& type, const std::string& limit, const std::string& mass,
                  const std::string& inertia) {
  return robot("<link name='body'><inertial><mass value='" + mass + "'/><inertia ixx='" + inertia +
               "' ixy='0' ixz='0' iyy='" + inertia + "' iyz='0' izz='" + inertia +
               "'/></inertial></link><joint name='joint' type='" + type +
               "'><parent link='ground'/><child link='body'/><axis xyz='0 0 1'/><limit " + limit +
               "/></joint>");
}

TEST(MachineUnits, StopsHoldWhateverMovesIntoThem) {
  const char* const kBeside = "effort='0' velocity='0'";
  // 2,000 kg and 1 g that fall 0.5 m, upwards.
  for (const char* mass : {"2000", "0.001"})
    EXPECT_LT(
        beyond(moved("prismatic", "lower='-1' upper='1' " + std::string(kBeside), mass, "0.001"),
               "duration: 1\ngravity: [0, 0, 9.81]\ninitial_state: {joint: {position: "
               "0.5}}\n",
               1.0, 2.0),
        0.02)
        << mass;
  // A turntable of 1e6 kg m^2, and one of a milligram on 5 mm, that arrive with 2 rad/s.
  for (const char* inertia : {"1e6", "1e-11"})
    EXPECT_LT(beyond(moved("revolute", "lower='-0.5' upper='0.5' " + std::string(kBeside), "1e-6",
                           inertia),
                     "duration: 1\ninitial_state: {joint: {velocity: 2}}\n", 0.5, 1.0),
              0.02)
        << inertia;
  // A micro-actuator of 1 N that is pushed by 1 mN, with a stroke of 100 um.
  EXPECT_LT(beyond(moved("prismatic", "lower='-5e-5' upper='5e-5' effort='1' velocity='10'", "1e-6",
                         "1e-12"),
                   "duration: 0.1\ngravity: [0, 0, 0]\nloads: [{joint: joint, effort: 1e-3}]\n",
                   5e-5, 1e-4),
            0.02);
}

/// A pendulum of micrometres, and one of 1e-30 kg.
std::string tiny(const std::string& mass, const std::string& inertia, const std::string& arm) {
  return robot("<link name='l'><inertial><origin xyz='0 0 -" + arm + "'/><mass value='" + mass +
               "'/><inertia ixx='" + inertia + "' ixy='0' ixz='0' iyy='" + inertia +
               "' iyz='0' izz='" + inertia +
               "'/></inertial></link><joint name='j' type='continuous'><parent link='ground'/>"
               "<child link='l'/><axis xyz='0 1 0'/></joint>");
}

TEST(MachineUnits, BodiesWithoutNoticeableMassSwingInAllCoordinates) {
  // J = m l^2 (1 + 1/100): theta'' = -g sin(theta)/(1.01 l).
  for (const auto& [mass, inertia, arm, time] :
       std::vector<std::tuple<std::string, std::string, std::string, double>>{
           {"1e-15", "1e-29", "1e-6", 1e-3},
           {"1e-30", "1e-34", "0.1", 0.3},
           {"1e-12", "1e-16", "0.1", 0.3},
           {"1e6", "1e2", "0.1", 0.3}}) {
    std::vector<double> ends;
    for (const char* solver : {"coordinates: joint", "coordinates: absolute", "integrator: idas"})
      ends.push_back(last_signals(tiny(mass, inertia, arm),
                                  "duration: " + to_decimal(time) +
                                      "\ninitial_state: {j: {position: 0.3}}\nsolver: {" + solver +
                                      ", relative_tolerance: 1e-8, absolute_tolerance: 1e-10}\n",
                                  time, {"j/position"})[0]);
    const double omega = std::sqrt(9.81 / (1.01 * std::stod(arm)));
    if (omega * time < 4.0) {
      EXPECT_NEAR(ends[0], 0.3 * std::cos(omega * time), 0.02) << mass;
    }
    EXPECT_NEAR(ends[1], ends[0], 1e-5) << mass;
    EXPECT_NEAR(ends[2], ends[0], 1e-5) << mass;
  }
}

}  // namespace
}  // namespace codesign
