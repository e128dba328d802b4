// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Rotors, poses at the start and constant loads over time, against closed forms and conserved
// quantities, with both integrators.
#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "description/study.h"
#include "equations/formulas.h"
#include "integration/energy_balance.h"
#include "integration/simulation_of.h"
#include "mechanism/constants.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

const char* const kIdas =
    "{integrator: idas, relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}";

/// A body of 2 kg that flies, with another on a hinge about an axis of its own if `hinge` is not
/// empty.
std::string flyer(const std::string& hinge = "") {
  const std::string inertial =
      "<inertial><mass value='2'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.2' iyz='0' "
      "izz='0.25'/></inertial>";
  std::string content = "<link name='box'>" + inertial +
                        "</link><joint name='free' type='floating'><parent link='ground'/><child "
                        "link='box'/></joint>";
  if (!hinge.empty())
    content += bar("arm") +
               "<joint name='drive' type='continuous'><parent link='box'/><child "
               "link='arm'/><origin xyz='0.3 0 0.1'/><axis "
               "xyz='0.3 1 0.5'/>" +
               hinge + "</joint>";
  return robot(content);
}

std::string study(const std::string& start, const std::string& more,
                  const std::string& solver = kTight) {
  return "duration: 1.5\ngravity: [0, 0, 0]\ninitial_state: {free: " + start + "}\n" + more +
         "solver: " + solver + "\n";
}

/// Signals at the end of a study.
std::vector<double> at_end(const std::string& urdf, const std::string& text,
                           const std::vector<std::string>& signals) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study({"test.yaml", text}, description);
  std::vector<SignalDescription> parsed;
  for (const std::string& signal : signals) parsed.push_back(parse_signal(signal, {}, "test"));
  const auto system = make_system(description, study);
  Simulation simulation = simulation_of(system, system->parameters(), parsed);
  Frame frame;
  Status status = simulation.start();
  if (status.ok()) status = simulation.advance(study.duration);
  EXPECT_TRUE(status.ok()) << status.cause;
  simulation.sample(study.duration, &frame);
  return frame.signals;
}

std::vector<std::string> vector_of(const std::string& object) {
  return {object + "/x", object + "/y", object + "/z"};
}

TEST(StartOfAFloatingJoint, FliesOnAsItStarts) {
  for (const char* solver : {kTight, kIdas}) {
    const std::string text = study(
        "{translation: [1, 2, 3], rotation: [0, 1.5707963267948966, 0], linear_velocity: [0.4, "
        "-0.2, 0.1], angular_velocity: "
        "[0, 0, 2]}",
        "", solver);
    const std::vector<double> position = at_end(flyer(), text, vector_of("box/position")),
                              turn = at_end(flyer(), text, vector_of("box/angular_velocity"));
    const double expected[] = {1.6, 1.7, 3.15};
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(position[k], expected[k], 1e-9) << solver;
    // A quarter about y takes the body's -x, a principal axis, to the ground's z: it keeps turning
    // about that.
    EXPECT_NEAR(turn[2], 2.0, 1e-8) << solver;
    EXPECT_NEAR(std::hypot(turn[0], turn[1]), 0.0, 1e-8) << solver;
    const std::vector<double> q = at_end(
        flyer(), text,
        {"box/orientation/w", "box/orientation/x", "box/orientation/y", "box/orientation/z"});
    const double half = 1.5, c = std::sqrt(0.5);
    const double quaternion[] = {c * std::cos(half), -c * std::sin(half), c * std::cos(half),
                                 c * std::sin(half)};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(q[k], quaternion[k], 1e-8) << solver << k;
  }
}

TEST(StartOfAPlanarJoint, SlidesOnAsItStarts) {
  const std::string plate = robot(
      "<link name='plate'><inertial><mass value='2'/><inertia ixx='0.01' ixy='0' ixz='0' "
      "iyy='0.01' iyz='0' izz='0.02'/></inertial></link>"
      "<joint name='plane' type='planar'><parent link='ground'/><child link='plate'/><origin "
      "rpy='0 0.6 0'/><axis xyz='0 1 0'/></joint>");
  const std::string text =
      "duration: 2.0\ngravity: [0, 0, 0]\ninitial_state: {plane: {translation: [0.1, 0, 0.2], "
      "rotation: 0.3, linear_velocity: [1, 0, -2], "
      "angular_velocity: 0.5}}\nsolver: " +
      std::string(kTight) + "\n";
  const std::vector<double> position = at_end(plate, text, vector_of("plate/position"));
  const Eigen::Vector3d in_joint(0.1 + 2.0, 0.0, 0.2 - 4.0),
      expected = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY()) * in_joint;
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(position[k], expected[static_cast<Eigen::Index>(k)], 1e-9);
  EXPECT_NEAR(at_end(plate, text, {"plate/orientation/y"})[0], std::sin(0.5 * (0.6 + 0.3 + 1.0)),
              1e-9);
}

TEST(ConstantLoads, AForceThatTurnsWithItsLink) {
  for (const char* solver : {kTight, kIdas}) {
    // The thrust f turns with w: v = f/(m w) (sin wt, 1 - cos wt).
    const std::string text = study("{angular_velocity: [0, 0, 3]}",
                                   "loads: [{link: box, force: [5, 0, 0], frame: link}]\n", solver);
    const std::vector<double> v = at_end(flyer(), text, vector_of("box/velocity"));
    EXPECT_NEAR(v[0], 5.0 / 6.0 * std::sin(4.5), 1e-8) << solver;
    EXPECT_NEAR(v[1], 5.0 / 6.0 * (1.0 - std::cos(4.5)), 1e-8) << solver;
  }
}

TEST(ConstantLoads, ATorqueAboutAPrincipalAxisAndAForceOfTheRoot) {
  const std::string text = study("{rotation: [0, 0, 0.4]}",
                                 "loads: [{link: box, force: [1, 2, 3], torque: [0, 0, 0.5]}]\n");
  const std::vector<double> position = at_end(flyer(), text, vector_of("box/position"));
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(position[k], 0.5 * (static_cast<double>(k) + 1.0) / 2.0 * 2.25, 1e-9);
  EXPECT_NEAR(at_end(flyer(), text, {"box/angular_velocity/z"})[0], 0.5 / 0.25 * 1.5, 1e-9);
}

TEST(Rotor, EnergyAndMomentumAreConserved) {
  const std::string urdf = flyer("<codesign:actuator gear_ratio='-30' rotor_inertia='0.0005'/>");
  const std::string text =
      "duration: 3.0\ngravity: [0, 0, 0]\ninitial_state: {free: {rotation: [0.3, 0.2, 0.1], "
      "angular_velocity: [1, -2, 3]}, drive: "
      "{velocity: 4.0}}\nsolver: " +
      std::string(kTight) + "\n";
  const Balance b = balance(urdf, text);
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-8 * b.start);
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const auto system = make_system(description, read_study({"test.yaml", text}, description));
  RosenbrockIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start(system->parameters()).ok());
  const auto momentum = [&] {
    Equations<double>& equations = integrator.step().equations();
    equations.formulas().load(integrator.step().state());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int body = 0; body < 2; ++body) {
      const BodyConstants<double>& c = equations.constants().bodies[static_cast<std::size_t>(body)];
      const BodyKinematics<double>& k = equations.formulas().body(body);
      sum += c.mass * k.r.cross(k.rd) + k.A * (c.J * body_omega(k));
    }
    const Rotor& rotor = system->rotors()[0];
    const auto& d = equations.constants().pairs[static_cast<std::size_t>(rotor.pair)].dynamics[0];
    sum += d.gear_ratio * d.rotor_inertia *
           equations.formulas().coordinate(rotor.pair, rotor.element).rate *
           (equations.formulas().body(rotor.body).A * d.rotor_axis);
    return sum;
  };
  const Eigen::Vector3d start = momentum();
  while (integrator.state().t < 3.0) ASSERT_TRUE(integrator.advance(3.0).ok());
  EXPECT_LT((momentum() - start).norm(), 1e-8 * start.norm());
}

// The rotors turn with the links that carry them, and their inertia is larger than the inertia of
// the links.
TEST(Rotor, ComputedTorqueFollowsItsWayPoints) {
  const std::string link =
      "<inertial><origin xyz='0.1 0.02 -0.3'/><mass value='1.5'/><inertia ixx='0.03' ixy='0.001' "
      "ixz='0.002' iyy='0.025' "
      "iyz='0.001' izz='0.02'/></inertial></link>";
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='0.1 0 -0.4'/><axis xyz='" + axis +
           "'/><codesign:actuator gear_ratio='30' rotor_inertia='0.0005'/></joint>";
  };
  const std::string urdf =
      robot("<link name='one'>" + link + "<link name='two'>" + link + "<link name='three'>" + link +
            joint("a", "ground", "one", "0 0 1") + joint("b", "one", "two", "0.3 1 0") +
            joint("c", "two", "three", "1 0 0.2"));
  std::string controllers;
  for (const char* name : {"a", "b", "c"})
    controllers += std::string("  ") + name + "_servo: {type: computed_torque, output: " + name +
                   ", gains: {p: 100.0, d: 20.0}, setpoint: " +
                   "{type: waypoints, times: [0.0, 0.5, 1.0], positions: [0.0, 1.5, -0.7]}}\n";
  for (const char* solver : {kTight, kIdas}) {
    const std::string text =
        "duration: 0.8\ncontrollers:\n" + controllers + "solver: " + solver + "\n";
    for (double error : at_end(urdf, text, {"a_servo/error", "b_servo/error", "c_servo/error"}))
      EXPECT_NEAR(error, 0.0, 1e-8) << solver;
  }
}

TEST(Rotor, TheEnergyGrowsByTheWorkOfTheActuator) {
  const std::string urdf =
      flyer(std::string("<dynamics damping='0.05' friction='0.02'/>") + pin_friction() +
            "<codesign:actuator gear_ratio='20' rotor_inertia='0.0005'/>");
  const Balance b = balance(urdf,
                            "duration: 1.0\ninitial_state: {free: {angular_velocity: [1, -2, "
                            "3]}}\nloads: [{link: box, force: [1, 0, 2]}]\n"
                            "controllers: {push: {type: state_feedback, output: drive, "
                            "feedforward: {type: sine, amplitude: 3.0, period: 0.7}}}\n"
                            "solver: " +
                                std::string(kFriction) + "\n");
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(std::abs(b.work), 0.1);
  EXPECT_NEAR(b.end - b.start, b.work, 1e-6 * (std::abs(b.work) + b.friction_work));
}

}  // namespace
}  // namespace codesign
