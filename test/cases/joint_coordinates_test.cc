// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Joint coordinates against absolute ones, doc/theory.md (56), (57): the same motions, reactions,
// friction, objective and gradient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/joint_coordinate_cases.h"
#include "cases/shipped.h"
#include "integration/linkages.h"
#include "integration/simulation_of.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

constexpr double kDuration = 0.2;
constexpr int kSamples = 5;

/// Every signal that depends on the formulation: reactions of joints that are not folded, energies,
/// powers, motions of links.
std::vector<SignalDescription> signals_of(const RobotDescription& robot, const Topology& topology) {
  std::vector<std::string> texts;
  for (const char* name : {"kinetic_energy", "potential_energy", "friction_power", "damping_power",
                           "actuator_power", "load_power"})
    texts.push_back(std::string("mechanism/") + name);
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const int pair = topology.joint_pair[k];
    if (pair < 0 || topology.pairs[static_cast<std::size_t>(pair)].chain.size() > 1) continue;
    for (const char* quantity : {"reaction_force", "reaction_torque"})
      for (const char* axis : {"x", "y", "z"})
        texts.push_back(robot.joints[k].name + "/" + quantity + "/" + axis);
  }
  for (const JointDescription& joint : robot.joints) {
    if (!joint.actuator || !joint.actuator->gear) continue;
    for (const char* quantity : {"gear_torque", "gear_loss", "friction_power"})
      texts.push_back(joint.name + "/" + quantity);
  }
  for (const Body& body : topology.bodies)
    for (const char* quantity : {"position", "velocity", "angular_velocity"})
      for (const char* axis : {"x", "y", "z"})
        texts.push_back(body.name + "/" + quantity + "/" + axis);
  for (const Body& body : topology.bodies)
    for (const char* axis : {"w", "x", "y", "z"})
      texts.push_back(body.name + "/orientation/" + axis);
  std::vector<SignalDescription> signals;
  for (const std::string& text : texts)
    signals.push_back(parse_signal(text, {"test", 0}, "signal"));
  return signals;
}

/// All numbers of a frame: motions, then friction and signals.
struct Numbers {
  std::vector<double> motion, friction, signals;
};

Numbers numbers_of(const Frame& frame) {
  Numbers n;
  for (const JointSample& joint : frame.joints)
    n.motion.insert(n.motion.end(), {joint.position, joint.velocity});
  for (const LinkSample& link : frame.links) {
    const Eigen::Matrix3d axes = link.orientation.toRotationMatrix();
    n.motion.insert(n.motion.end(), link.position.data(), link.position.data() + 3);
    n.motion.insert(n.motion.end(), axes.data(), axes.data() + 9);
  }
  for (const JointSample& joint : frame.joints)
    n.friction.insert(n.friction.end(), {joint.acceleration, joint.effort});
  for (const FrictionSample& friction : frame.frictions) {
    n.friction.insert(n.friction.end(),
                      {friction.friction, friction.normal_force, friction.sliding_velocity});
    for (const Eigen::Vector3d& x : {friction.position, friction.force, friction.torque})
      n.friction.insert(n.friction.end(), x.data(), x.data() + 3);
  }
  n.signals = frame.signals;
  return n;
}

void expect_near(const std::vector<double>& joint, const std::vector<double>& absolute,
                 double tolerance, double size, const char* what) {
  ASSERT_EQ(joint.size(), absolute.size());
  for (std::size_t k = 0; k < joint.size(); ++k)
    EXPECT_NEAR(joint[k], absolute[k], tolerance * (1.0 + size)) << what << " " << k;
}

double size_of(const std::vector<double>& x) {
  double size = 0.0;
  for (double value : x) size = std::max(size, std::abs(value));
  return size;
}

/// A mechanism and study in one kind of coordinates.
struct Formulation {
  Formulation(const std::string& urdf, std::string study, const char* coordinates)
      : robot(read_urdf({"test.urdf", urdf})) {
    study += std::string("solver: {coordinates: ") + coordinates +
             ", method: rodas5p, relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-12, "
             "maximum_steps: 1000000}\n";
    system = make_system(robot, read_study({"test.yaml", study}, robot));
  }

  std::vector<Frame> frames() const {
    Simulation simulation =
        simulation_of(system, system->parameters(), signals_of(robot, system->topology()));
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

/// A study whose objective reads energies and an orientation.
std::string study_of(const CoordinatesCase& c) {
  const std::string link = derive_topology(read_urdf({"test.urdf", c.urdf})).bodies.back().name;
  std::string text = "duration: " + std::to_string(kDuration) + "\n" + c.study;
  if (c.has_parameters) text += "parameters: {size: {tune: true}, mass: {tune: true}}\n";
  return text +
         "objective: {integral: [{signal: mechanism/kinetic_energy}, {signal: "
         "mechanism/potential_energy, weight: 0.1}, {signal: " +
         link + "/orientation/x, weight: 0.3}]}\n";
}

class JointCoordinates : public ::testing::TestWithParam<CoordinatesCase> {
 protected:
  JointCoordinates()
      : joint(GetParam().urdf, study_of(GetParam()), "joint"),
        absolute(GetParam().urdf, study_of(GetParam()), "absolute") {}

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
    const double tolerance = k == 0 ? GetParam().start : GetParam().friction;
    expect_near(a.motion, b.motion, k == 0 ? 1e-12 : std::max(1e-9, 0.1 * GetParam().start),
                size_of(b.motion), "motion");
    expect_near(a.friction, b.friction, tolerance, friction, "acceleration or friction");
    expect_near(a.signals, b.signals, tolerance, signals, "signal");
    if (HasFailure()) break;
  }
}

TEST_P(JointCoordinates, ObjectiveAndGradientAreThoseOfAbsoluteCoordinates) {
  const auto evaluate = [this](const Formulation& in) {
    std::vector<double> start;
    for (int k : in.system->study().tuned)
      start.push_back(in.system->parameters()[static_cast<std::size_t>(k)]);
    return evaluator_of(in.system).evaluate(
        Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size())),
        GetParam().has_parameters);
  };
  const Evaluation a = evaluate(joint), b = evaluate(absolute);
  ASSERT_TRUE(a.status.ok()) << a.status.cause;
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_NEAR(a.objective, b.objective, 1e-9 * (1.0 + std::abs(b.objective)));
  if (!GetParam().has_parameters) return;
  EXPECT_LT((a.gradient - b.gradient).norm(), 1e-7 * (1.0 + b.gradient.norm()))
      << a.gradient.transpose() << " and " << b.gradient.transpose();
}

const auto name_of = [](const ::testing::TestParamInfo<CoordinatesCase>& instance) {
  return instance.param.name;
};

INSTANTIATE_TEST_SUITE_P(Types, JointCoordinates, ::testing::ValuesIn(joint_coordinates::types()),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Rings, JointCoordinates, ::testing::ValuesIn(joint_coordinates::rings()),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Planes, JointCoordinates, ::testing::ValuesIn(joint_coordinates::planes()),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Frictions, JointCoordinates,
                         ::testing::ValuesIn(joint_coordinates::frictions()), name_of);
INSTANTIATE_TEST_SUITE_P(Gears, JointCoordinates, ::testing::ValuesIn(joint_coordinates::gears()),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Loads, JointCoordinates, ::testing::ValuesIn(joint_coordinates::loads()),
                         name_of);

/// A shipped case with tight tolerances in one kind of coordinates.
Shipped tight(const std::string& name, CoordinatesKind coordinates) {
  Shipped shipped(name);
  SolverOptions& solver = shipped.study.solver;
  solver.coordinates = coordinates;
  solver.integrator = IntegratorKind::kRosenbrock;
  solver.method = RosenbrockMethod::kRodas5P;
  solver.relative_tolerance = solver.absolute_tolerance = 1e-11;
  shipped.study.duration = std::min(shipped.study.duration, 0.5);
  return shipped;
}

class ShippedInJointCoordinates : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedInJointCoordinates, ObjectiveAndGradientAreTheSame) {
  const auto evaluate = [](CoordinatesKind coordinates) {
    const Shipped shipped = tight(GetParam(), coordinates);
    const auto system = make_system(shipped.robot, shipped.study);
    EXPECT_EQ(system->layout().has_forest(), coordinates == CoordinatesKind::kJoint);
    return evaluator_of(system).evaluate(shipped.start(), true);
  };
  const Evaluation joint = evaluate(CoordinatesKind::kJoint),
                   absolute = evaluate(CoordinatesKind::kAbsolute);
  ASSERT_TRUE(joint.status.ok()) << joint.status.cause;
  ASSERT_TRUE(absolute.status.ok()) << absolute.status.cause;
  EXPECT_NEAR(joint.objective, absolute.objective, 1e-9 * std::abs(absolute.objective));
  EXPECT_LT((joint.gradient - absolute.gradient).norm(), 1e-7 * absolute.gradient.norm());
}

TEST_P(ShippedInJointCoordinates, TheGradientIsThatOfTheComplexStep) {
  Shipped shipped(GetParam());
  shipped.study.solver.coordinates = CoordinatesKind::kJoint;
  shipped.study.duration = std::min(shipped.study.duration, 0.3);
  const GradientCheck check = check_gradient(make_system(shipped.robot, shipped.study),
                                             shipped.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Cases, ShippedInJointCoordinates,
                         ::testing::Values("slider_crank", "slider_crank_haug", "governor",
                                           "two_link_arm", "gantry", "feed_axis", "arm_limits",
                                           "inverted_pendulum"),
                         [](const auto& instance) { return instance.param; });

TEST(JointCoordinates, ARunGoesOnWithOtherDimensions) {
  for (const std::string name : {"revolute", "planar", "spherical_loop"}) {
    const std::vector<CoordinatesCase> cases = joint_coordinates::types();
    const auto c = std::find_if(cases.begin(), cases.end(),
                                [&](const CoordinatesCase& each) { return each.name == name; });
    const auto run = [&](const char* coordinates) {
      const Formulation in(c->urdf, study_of(*c), coordinates);
      std::vector<double> parameters = in.system->parameters();
      Simulation simulation =
          simulation_of(in.system, parameters, signals_of(in.robot, in.system->topology()));
      EXPECT_TRUE(simulation.start().ok());
      EXPECT_TRUE(simulation.advance_to(0.1).ok());
      parameters[0] *= 1.2;
      parameters[1] *= 0.7;
      EXPECT_TRUE(simulation.go_on(0.1, parameters).ok());
      EXPECT_TRUE(simulation.advance_to(kDuration).ok());
      Frame frame;
      simulation.sample(kDuration, &frame);
      return numbers_of(frame);
    };
    const Numbers joint = run("joint"), absolute = run("absolute");
    expect_near(joint.motion, absolute.motion, 1e-9, size_of(absolute.motion), name.c_str());
    expect_near(joint.signals, absolute.signals, 1e-8, size_of(absolute.signals), name.c_str());
  }
}

TEST(JointCoordinates, TheAdjointGivesTheDirectGradient) {
  for (const char* name : {"two_link_arm", "gantry", "slider_crank_haug"}) {
    Shipped shipped(name);
    shipped.study.solver.coordinates = CoordinatesKind::kJoint;
    shipped.study.solver.sensitivity_tolerance = 0.0;
    const auto gradient = [&](GradientMethod method) {
      shipped.study.solver.gradient = method;
      const Evaluation evaluation =
          evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(shipped.start(), true);
      EXPECT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
      return evaluation.gradient;
    };
    const Eigen::VectorXd direct = gradient(GradientMethod::kDirect),
                          adjoint = gradient(GradientMethod::kAdjoint);
    EXPECT_LT((direct - adjoint).norm(), 1e-9 * direct.norm()) << name;
  }
}

TEST(JointCoordinates, IdasAgrees) {
  for (const char* name : {"two_link_arm", "slider_crank_haug"}) {
    Shipped shipped = tight(name, CoordinatesKind::kJoint);
    shipped.study.duration = 0.2;
    shipped.study.solver.gradient = GradientMethod::kDirect;
    const auto evaluate = [&](IntegratorKind integrator) {
      shipped.study.solver.integrator = integrator;
      shipped.study.solver.relative_tolerance = shipped.study.solver.absolute_tolerance = 1e-9;
      const Evaluation evaluation =
          evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(shipped.start(), true);
      EXPECT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
      return evaluation;
    };
    const Evaluation rosenbrock = evaluate(IntegratorKind::kRosenbrock),
                     idas = evaluate(IntegratorKind::kIdas);
    EXPECT_NEAR(idas.objective, rosenbrock.objective, 1e-6 * std::abs(rosenbrock.objective))
        << name;
    EXPECT_LT((idas.gradient - rosenbrock.gradient).norm(), 1e-5 * rosenbrock.gradient.norm())
        << name;
  }
}

std::shared_ptr<const CompiledSystem> system_of(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(robot, read_study({"test.yaml", study}, robot));
}

void expect_refused(const std::string& urdf, const std::string& study, const std::string& message) {
  try {
    system_of(urdf, study + "solver: {coordinates: joint}\n");
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).rfind("test.yaml:", 0), 0U) << error.what();
  }
  EXPECT_FALSE(system_of(urdf, study + "solver: {coordinates: auto}\n")->layout().has_forest());
}

TEST(JointCoordinates, WhatTheyCannotDoIsRefusedWithAReasonAndAutoFallsBack) {
  expect_refused(double_pendulum(pin_friction()),
                 "duration: 1.0\ncontrollers: {hold: {type: pid, input: mechanism/friction_power, "
                 "output: elbow, setpoint: 0.0, gains: {p: "
                 "1.0}}}\nobjective: {integral: [{signal: lower/position/x}]}\n",
                 "a controller that reads the friction of the whole mechanism");
  expect_refused(four_bar_with("<coupling name='gear'><predecessor link='left'/><successor "
                               "link='right'/><ratio value='1'/></coupling>"),
                 "duration: 1.0\nobjective: {integral: [{signal: left/position/x}]}\n",
                 "couplings with redundant constraints");
}

TEST(JointCoordinates, RedundantLoopsAndReactionsThatControllersReadKeepRows) {
  const std::string objective =
      "objective: {integral: [{signal: lower/position/x}]}\nsolver: {coordinates: joint}\n";
  const auto system = system_of(double_pendulum(),
                                "duration: 1.0\ncontrollers: {hold: {type: pid, input: "
                                "shoulder/reaction_force/x, output: elbow, setpoint: "
                                "0.0, gains: {p: 1.0}}}\n" +
                                    objective);
  EXPECT_TRUE(system->layout().is_cut(0));
  EXPECT_FALSE(system->layout().is_cut(1));
  EXPECT_FALSE(system_of(four_bar(),
                         "duration: 1.0\nobjective: {integral: [{signal: "
                         "left/position/x}]}\nsolver: {coordinates: joint}\n")
                   ->layout()
                   .has_forest());
}

TEST(JointCoordinates, LongChainsAreCut) {
  const auto cuts = [](int count) {
    const auto system =
        system_of(joint_coordinates::chain_of(count),
                  "duration: 1.0\nobjective: {integral: [{signal: bar0/position/x}]}\n");
    EXPECT_TRUE(system->layout().has_forest());
    int sum = 0;
    for (int pair = 0; pair < count; ++pair) sum += system->layout().is_cut(pair) ? 1 : 0;
    return sum;
  };
  EXPECT_EQ(cuts(24), 0);
  EXPECT_EQ(cuts(25), 2);
  EXPECT_EQ(cuts(40), 3);
}

TEST(JointCoordinates, APointMassOnAHingeMovesAsInAbsoluteOnes) {
  const std::string model =
      robot(bar("upper") + hinge("shoulder", "ground", "upper", "0 0 0") +
            "<link name='bob'><inertial><origin xyz='0 0 -0.5'/><mass value='1'/><inertia ixx='0' "
            "iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/>"
            "</inertial></link>" +
            hinge("elbow", "upper", "bob", "0 0 -1"));
  const std::string study =
      "duration: 1.0\nobjective: {integral: [{signal: bob/position/x}]}\nsolver: {coordinates: ";
  for (const char* coordinates : {"joint", "absolute"})
    EXPECT_NO_THROW(system_of(model, study + coordinates + "}\n")) << coordinates;
}

TEST(JointCoordinates, AnUnknownKindIsRefused) {
  EXPECT_THROW(system_of(double_pendulum(),
                         "duration: 1.0\nobjective: {integral: [{signal: lower/position/x}]}\n"
                         "solver: {coordinates: polar}\n"),
               InputError);
}

TEST(JointCoordinates, HaveOneCoordinatePerJointAndNoMultipliers) {
  const std::string study =
      "duration: 1.0\nobjective: {integral: [{signal: lower/position/x}]}\nsolver: {coordinates: "
      "auto}\n";
  const auto system = system_of(double_pendulum(), study);
  const Layout& layout = system->layout();
  EXPECT_EQ(layout.n, 2);
  EXPECT_EQ(layout.m, 0);
  EXPECT_EQ(layout.element_column(1, 0), 1);
  EXPECT_FALSE(layout.is_cut(0));
}

}  // namespace
}  // namespace codesign
