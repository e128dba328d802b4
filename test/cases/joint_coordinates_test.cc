// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Joint coordinates against absolute ones, doc/theory.md (56), (57): the same motions, reactions, friction, objective and gradient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "cases/joint_coordinate_cases.h"
#include "cases/shipped.h"

namespace codesign {
namespace {

constexpr double kDuration = 0.2;
constexpr int kSamples = 5;

/// Every signal that depends on the formulation: reactions of joints that are not folded, energies, powers, motions of links.
std::vector<SignalDescription> signals_of(const RobotDescription& robot, const Topology& topology) {
  std::vector<std::string> texts;
  for (const char* name : {"kinetic_energy", "potential_energy", "friction_power", "damping_power", "actuator_power", "load_power"})
    texts.push_back(std::string("mechanism/") + name);
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const int pair = topology.joint_pair[k];
    if (pair < 0 || topology.pairs[static_cast<std::size_t>(pair)].chain.size() > 1) continue;
    for (const char* quantity : {"reaction_force", "reaction_torque"})
      for (const char* axis : {"x", "y", "z"}) texts.push_back(robot.joints[k].name + "/" + quantity + "/" + axis);
  }
  for (const Body& body : topology.bodies)
    for (const char* quantity : {"position", "velocity", "angular_velocity"})
      for (const char* axis : {"x", "y", "z"}) texts.push_back(body.name + "/" + quantity + "/" + axis);
  std::vector<SignalDescription> signals;
  for (const std::string& text : texts) signals.push_back(parse_signal(text, {"test", 0}, "signal"));
  return signals;
}

/// All numbers of a frame: motions, then friction and signals.
struct Numbers {
  std::vector<double> motion, friction, signals;
};

Numbers numbers_of(const Frame& frame) {
  Numbers n;
  for (const JointSample& joint : frame.joints) n.motion.insert(n.motion.end(), {joint.position, joint.velocity});
  for (const LinkSample& link : frame.links) {
    const Eigen::Matrix3d axes = link.orientation.toRotationMatrix();
    n.motion.insert(n.motion.end(), link.position.data(), link.position.data() + 3);
    n.motion.insert(n.motion.end(), axes.data(), axes.data() + 9);
  }
  for (const JointSample& joint : frame.joints) n.friction.insert(n.friction.end(), {joint.acceleration, joint.effort});
  for (const FrictionSample& friction : frame.frictions) {
    n.friction.insert(n.friction.end(), {friction.friction, friction.normal_force, friction.sliding_velocity});
    for (const Eigen::Vector3d& x : {friction.position, friction.force, friction.torque})
      n.friction.insert(n.friction.end(), x.data(), x.data() + 3);
  }
  n.signals = frame.signals;
  return n;
}

void expect_near(const std::vector<double>& joint, const std::vector<double>& absolute, double tolerance, double size, const char* what) {
  ASSERT_EQ(joint.size(), absolute.size());
  for (std::size_t k = 0; k < joint.size(); ++k) EXPECT_NEAR(joint[k], absolute[k], tolerance * (1.0 + size)) << what << " " << k;
}

double size_of(const std::vector<double>& x) {
  double size = 0.0;
  for (double value : x) size = std::max(size, std::abs(value));
  return size;
}

/// A mechanism and study in one kind of coordinates.
struct Formulation {
  Formulation(const std::string& urdf, std::string study, const char* coordinates) : robot(read_urdf({"test.urdf", urdf})) {
    study += std::string("solver: {coordinates: ") + coordinates +
             ", method: rodas5p, relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-12, maximum_steps: 1000000}\n";
    system = make_system(robot, read_study({"test.yaml", study}, robot));
  }

  std::vector<Frame> frames() const {
    Simulation simulation(system, system->parameters(), signals_of(robot, system->topology()));
    std::vector<Frame> all;
    const Status status = simulate(&simulation, kDuration, kSamples, [&](const Frame& frame) {
      all.push_back(frame);
      return true;
    });
    EXPECT_TRUE(status.ok()) << status.cause;
    return all;
  }

  RobotDescription robot;
  std::shared_ptr<const CompiledSystem> system;
};

/// A study whose objective reads motions, reactions and powers.
std::string study_of(const CoordinatesCase& c) {
  const std::string body = c.urdf.find("name='tip'") != std::string::npos ? "tip" : "";
  std::string text = "duration: " + std::to_string(kDuration) + "\n" + c.study;
  if (c.has_parameters) text += "parameters: {size: {tune: true}, mass: {tune: true}}\n";
  return text + "objective: {integral: [{signal: mechanism/kinetic_energy}, {signal: mechanism/potential_energy, weight: 0.1}]}\n";
}

class JointCoordinates : public ::testing::TestWithParam<CoordinatesCase> {
 protected:
  JointCoordinates() : joint(GetParam().urdf, study_of(GetParam()), "joint"), absolute(GetParam().urdf, study_of(GetParam()), "absolute") {}

  Formulation joint, absolute;
};

TEST_P(JointCoordinates, RunsAreThoseOfAbsoluteCoordinates) {
  ASSERT_TRUE(joint.system->layout().has_forest());
  ASSERT_FALSE(absolute.system->layout().has_forest());
  EXPECT_LT(joint.system->layout().columns(), absolute.system->layout().columns());
  const std::vector<Frame> in_joint = joint.frames(), in_absolute = absolute.frames();
  ASSERT_EQ(in_joint.size(), in_absolute.size());
  double friction = 0.0, signals = 0.0;
  for (const Frame& frame : in_absolute) {
    friction = std::max(friction, size_of(numbers_of(frame).friction));
    signals = std::max(signals, size_of(frame.signals));
  }
  for (std::size_t k = 0; k < in_joint.size(); ++k) {
    const Numbers a = numbers_of(in_joint[k]), b = numbers_of(in_absolute[k]);
    const double tolerance = k == 0 ? 1e-11 : GetParam().friction;  // nothing has been integrated yet
    expect_near(a.motion, b.motion, k == 0 ? 1e-12 : 1e-9, size_of(b.motion), "motion");
    expect_near(a.friction, b.friction, tolerance, friction, "acceleration or friction");
    expect_near(a.signals, b.signals, tolerance, signals, "signal");
    if (HasFailure()) break;
  }
}

TEST_P(JointCoordinates, ObjectiveAndGradientAreThoseOfAbsoluteCoordinates) {
  const auto evaluate = [this](const Formulation& in) {
    std::vector<double> start;
    for (int k : in.system->study().tuned) start.push_back(in.system->parameters()[static_cast<std::size_t>(k)]);
    return Evaluator(in.system).evaluate(Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size())),
                                         GetParam().has_parameters);
  };
  const Evaluation a = evaluate(joint), b = evaluate(absolute);
  ASSERT_TRUE(a.status.ok()) << a.status.cause;
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_NEAR(a.objective, b.objective, 1e-9 * (1.0 + std::abs(b.objective)));
  if (!GetParam().has_parameters) return;
  EXPECT_LT((a.gradient - b.gradient).norm(), 1e-7 * (1.0 + b.gradient.norm())) << a.gradient.transpose() << " and " << b.gradient.transpose();
}

const auto name_of = [](const ::testing::TestParamInfo<CoordinatesCase>& instance) { return instance.param.name; };

INSTANTIATE_TEST_SUITE_P(Types, JointCoordinates, ::testing::ValuesIn(joint_coordinates::types()), name_of);
INSTANTIATE_TEST_SUITE_P(Frictions, JointCoordinates, ::testing::ValuesIn(joint_coordinates::frictions()), name_of);
INSTANTIATE_TEST_SUITE_P(Loads, JointCoordinates, ::testing::ValuesIn(joint_coordinates::loads()), name_of);

}  // namespace
}  // namespace codesign
