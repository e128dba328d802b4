// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The wrenches of joints on their children, theory (11a): against values by hand, against
// Newton-Euler for every body, and their gradients.
#include <gtest/gtest.h>

#include "cases/shipped.h"
#include "elements/spring_damper.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "equations/generic_state.h"
#include "equations/joint_cases.h"
#include "equations/loaded_arm.h"
#include "integration/linkages.h"

namespace codesign {
namespace {

struct ReactionCase {
  std::string name, urdf, study;
  ReactionSharing sharing;
  bool loaded = true;  ///< whether the wrenches differ from zero
};

void PrintTo(const ReactionCase& c, std::ostream* out) { *out << c.name; }

ReactionCase reaction_arm() {
  const char* const study =
      "limits: {position: true, effort: true, stiffness: 50.0, width: 0.01, dissipation: 0.4}\n"
      "controllers:\n  servo: {type: pid, input: elbow/position, output: elbow, setpoint: 0.4, "
      "gains: {p: 3.0, d: 0.2}}\n"
      "  compliant: {type: state_feedback, output: elbow, feedback: [{signal: "
      "shoulder/reaction_force/x, gain: 0.02}]}\n"
      "loads: [{joint: shoulder, effort: 1.5}, {link: lower, force: [1.0, -2.0, 0.5], torque: "
      "[0.1, 0.2, 0.3], point: [0.1, 0, -0.4]},\n"
      "        {link: upper, force: [0.4, 0.3, -1.0], torque: [0.3, -0.2, 0.1], point: [0, 0.2, "
      "0.1], frame: link}]\n";
  return {"arm", loaded_arm(), study, {}, true};
}

/// A parallelogram with friction in one hinge; three of its constraint rows are dropped.
ReactionCase redundant_ring() {
  ReactionSharing sharing(1e-6);
  sharing.pairs = {0, 1, 2, 3};
  sharing.dropped = {{3, -1, 1}, {3, -1, 3}, {3, -1, 4}};
  const char* const start =
      "initial_state: {left_hinge: {position: 0.4, velocity: 1.0}, right_hinge: {guess: 0.4}}\n";
  return {"ring", four_bar(pin_friction()), start, sharing};
}

std::vector<ReactionCase> reaction_cases() {
  std::vector<ReactionCase> all;
  for (const JointCase& joint : joint_cases::all())
    all.push_back({joint.name, joint_cases::model(joint), "", {}, joint.loaded});
  const std::string rotor = std::string(joint_cases::kOrigin) +
                            "<codesign:actuator gear_ratio='3' rotor_inertia='0.01'/>";
  for (const char* type : {"revolute", "prismatic"})
    all.push_back({std::string(type) + "_with_rotor",
                   joint_cases::model(
                       {"", joint_cases::tree("joint", type, "base", "tip", "1 0 0.5", rotor)}),
                   "",
                   {},
                   true});
  all.push_back(reaction_arm());
  all.push_back({"puck", puck(), "", {}});
  all.push_back({"lugre_puck", with_friction_model(puck(), "lugre"), "", {}});
  all.push_back({"ball", ball_pendulum(), "loads: [{joint: ball_y, effort: 0.4}]\n", {}});
  all.push_back(redundant_ring());
  return all;
}

/// Joints and loops whose reaction can be read: their child has mass.
std::vector<int> readable(const RobotDescription& robot, const Topology& topology) {
  std::vector<int> joints;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (topology.joint_pair[j] >= 0 &&
        topology.link_body[static_cast<std::size_t>(robot.joints[j].child)] != Topology::kMassless)
      joints.push_back(static_cast<int>(j));
  return joints;
}

/// A study whose objective reads all six components of every joint that can be read.
std::string study_of(const ReactionCase& c) {
  const RobotDescription robot = read_urdf({"test.urdf", c.urdf});
  std::string terms;
  for (int joint : readable(robot, derive_topology(robot)))
    for (const char* quantity : {"/reaction_force/", "/reaction_torque/"})
      for (const char* axis : {"x", "y", "z"})
        terms += (terms.empty() ? "{signal: " : ", {signal: ") +
                 robot.joints[static_cast<std::size_t>(joint)].name + quantity + axis +
                 ", reference: 0.1, weight: 0.3}";
  return "duration: 1.0\nobjective: {integral: [" + terms + "]}\n" + c.study;
}

double reaction_value(Compiled* c, const std::string& text) {
  return c->equations.formulas().signal(
      resolve_signal(parse_signal(text, {}, "test"), c->system.robot(), c->system.topology(),
                     c->system.study().controllers),
      c->state);
}

/// A wrench in ground axes, about the ground's origin.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& f, const Eigen::Vector3d& torque,
           double sign = 1.0) {
    force += sign * f;
    moment += sign * (point.cross(f) + torque);
  }
};

/// The sum of the wrenches of all joints on each body, read from the signals; the ground last.
std::vector<Wrench> exerted(Compiled* c) {
  const auto bodies = static_cast<std::size_t>(c->system.layout().bodies);
  std::vector<Wrench> sums(bodies + 1);
  for (int j : readable(c->system.robot(), c->system.topology())) {
    const std::string& name = c->system.robot().joints[static_cast<std::size_t>(j)].name;
    Eigen::Vector3d force, torque;
    for (int k = 0; k < 3; ++k) {
      force[k] = reaction_value(c, name + "/reaction_force/" + "xyz"[k]);
      torque[k] = reaction_value(c, name + "/reaction_torque/" + "xyz"[k]);
    }
    const Pair& pair = c->system.topology().pairs[static_cast<std::size_t>(
        c->system.topology().joint_pair[static_cast<std::size_t>(j)])];
    const int child = c->system.topology().link_body[static_cast<std::size_t>(
        c->system.robot().joints[static_cast<std::size_t>(j)].child)];
    const int other = child == pair.body_j ? pair.body_i : pair.body_j;
    const LinkConstants<double>& frame =
        c->equations.constants().joint_frames[static_cast<std::size_t>(j)];
    const BodyKinematics<double>& k = c->equations.formulas().body(child);
    const Eigen::Matrix3d axes = k.A * frame.R;
    const auto at = [&](int body) { return body < 0 ? bodies : static_cast<std::size_t>(body); };
    sums[at(child)].add(k.r + k.A * frame.s, axes * force, axes * torque);
    sums[at(other)].add(k.r + k.A * frame.s, axes * force, axes * torque, -1.0);
  }
  return sums;
}

/// The wrench that the joints must exert on each body: its inertia forces minus weight, springs and
/// constant loads.
std::vector<Wrench> demanded(Compiled* c) {
  std::vector<Wrench> sums(static_cast<std::size_t>(c->system.layout().bodies));
  const Eigen::Vector3d gravity(c->system.study().gravity.data());
  for (std::size_t b = 0; b < sums.size(); ++b) {
    const BodyConstants<double>& constants = c->equations.constants().bodies[b];
    const BodyKinematics<double>& k = c->equations.formulas().body(static_cast<int>(b));
    const Eigen::Vector3d omega = 2.0 * body_rate(k.p, k.pd), alpha = 2.0 * body_rate(k.p, k.pdd);
    sums[b].add(k.r, constants.mass * (k.rdd - gravity),
                k.A * (constants.J * alpha + omega.cross(constants.J * omega)));
  }
  for (const Rotor& rotor : c->system.rotors()) {
    if (rotor.body < 0) continue;
    const auto& d = c->equations.constants()
                        .pairs[static_cast<std::size_t>(rotor.pair)]
                        .dynamics[static_cast<std::size_t>(rotor.element)];
    const BodyKinematics<double>& k = c->equations.formulas().body(rotor.body);
    const CoordinateMotion<double> m =
        c->equations.formulas().coordinate(rotor.pair, rotor.element);
    const Eigen::Vector3d u = k.A * d.rotor_axis, omega = 2.0 * (k.A * body_rate(k.p, k.pd));
    sums[static_cast<std::size_t>(rotor.body)].moment +=
        d.gear_ratio * d.rotor_inertia * (m.acceleration * u + m.rate * omega.cross(u));
  }
  for (const LinkLoad& on : c->system.link_loads()) {
    const LoadDescription& load = c->system.study().loads[static_cast<std::size_t>(on.load)];
    const LinkConstants<double>& link =
        c->equations.constants().links[static_cast<std::size_t>(on.link)];
    const BodyKinematics<double>& k = c->equations.formulas().body(on.body);
    const Eigen::Matrix3d axes =
        on.turns ? Eigen::Matrix3d(k.A * link.R) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const std::vector<double> none = c->system.parameters();
    const Eigen::Vector3d point = k.r + k.A * (link.s + link.R * vector_at(load.point, none));
    const auto vector = [&none](const std::array<LoadFunction, 3>& components) {
      Eigen::Vector3d result;
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[static_cast<int>(axis)] = components[axis].of_time.constant.at(none);
      return result;
    };
    sums[static_cast<std::size_t>(on.body)].add(point, axes * vector(load.force),
                                                axes * vector(load.torque), -1.0);
  }
  for (std::size_t s = 0; s < c->equations.constants().springs.size(); ++s) {
    const SpringDamperConstants<double>& spring = c->equations.constants().springs[s];
    const Eigen::Vector3d pull = spring_at(c->equations.formulas().view(), s).pull;
    const auto end = [&](int body, const Eigen::Vector3d& at, double sign) {
      const BodyKinematics<double>& k = c->equations.formulas().body(body);
      if (body >= 0)
        sums[static_cast<std::size_t>(body)].add(k.r + k.A * at, pull, Eigen::Vector3d::Zero(),
                                                 sign);
    };
    end(spring.body_i, spring.s_i, -1.0);
    end(spring.body_j, spring.s_j, 1.0);
  }
  return sums;
}

void expect_balance(Compiled* c, double tolerance, bool loaded = true) {
  const std::vector<Wrench> have = exerted(c);
  c->equations.formulas().load(c->state);
  const std::vector<Wrench> need = demanded(c);
  for (std::size_t b = 0; b < need.size(); ++b) {
    EXPECT_EQ(need[b].force.norm() > 1e-3, loaded) << b;
    EXPECT_LT((need[b].force - have[b].force).norm(), tolerance * (1.0 + need[b].force.norm()))
        << b;
    EXPECT_LT((need[b].moment - have[b].moment).norm(), tolerance * (1.0 + need[b].moment.norm()))
        << b;
  }
}

class ReactionConformance : public ::testing::TestWithParam<ReactionCase> {};

TEST_P(ReactionConformance, ReactionsAndWeightAreWhatEachBodysAccelerationTakes) {
  Compiled c(GetParam().urdf, study_of(GetParam()), GetParam().sharing);
  ASSERT_TRUE(c.start().ok());
  if (!GetParam().sharing.drops()) {
    ASSERT_TRUE(scramble(&c));
  }
  expect_balance(&c, 1e-9, GetParam().loaded);
}

TEST_P(ReactionConformance, GradientsAreExact) {
  EquationsFixture e(GetParam().urdf, study_of(GetParam()), GetParam().sharing);
  e.expect_exact_derivatives(1e-9);
}

// The same vector, turned by the rotation matrices of the bodies, which no signal reads.
TEST_P(ReactionConformance, AreTheSameVectorInTheAxesOfTheGroundAndOfEveryLink) {
  Compiled c(GetParam().urdf, study_of(GetParam()), GetParam().sharing);
  ASSERT_TRUE(c.start().ok());
  if (!GetParam().sharing.drops()) {
    ASSERT_TRUE(scramble(&c));
  }
  const RobotDescription& robot = c.system.robot();
  const Topology& topology = c.system.topology();
  const auto vector = [&c](const std::string& name, const std::string& axes) {
    Eigen::Vector3d value;
    for (int k = 0; k < 3; ++k) value[k] = reaction_value(&c, name + "/" + "xyz"[k] + axes);
    return value;
  };
  const auto frame = [&](int body, const LinkConstants<double>& link) {
    c.equations.formulas().load(c.state);
    return Eigen::Matrix3d(c.equations.formulas().body(body).A * link.R);
  };
  for (int j : readable(robot, topology))
    for (const char* quantity : {"/reaction_force", "/reaction_torque"}) {
      const JointDescription& joint = robot.joints[static_cast<std::size_t>(j)];
      const Eigen::Vector3d ground =
          frame(topology.link_body[static_cast<std::size_t>(joint.child)],
                c.equations.constants().joint_frames[static_cast<std::size_t>(j)]) *
          vector(joint.name + quantity, "");
      const double tolerance = 1e-12 * (1.0 + ground.norm());
      EXPECT_LT((vector(joint.name + quantity, "@ground") - ground).norm(), tolerance)
          << joint.name;
      for (std::size_t link = 0; link < robot.links.size(); ++link) {
        if (topology.link_body[link] == Topology::kMassless) continue;
        const Eigen::Vector3d told =
            frame(topology.link_body[link], c.equations.constants().links[link]).transpose() *
            ground;
        EXPECT_LT((vector(joint.name + quantity, "@" + robot.links[link].name) - told).norm(),
                  tolerance)
            << joint.name << " in " << robot.links[link].name;
      }
    }
}

TEST(Reaction, GradientsInOtherAxesAreExact) {
  const ReactionCase c = reaction_arm();
  const std::string terms =
      "{signal: elbow/reaction_force/x@ground - shoulder/reaction_force/x@ground}, {signal: "
      "elbow/reaction_torque/z@upper}, {signal: shoulder/reaction_torque/y@lower}, {signal: "
      "mechanism/shaking_moment/y}, {signal: mechanism/shaking_force/x@lower}";
  EquationsFixture e(c.urdf, "duration: 1.0\nobjective: {integral: [" + terms + "]}\n" + c.study,
                     c.sharing);
  e.expect_exact_derivatives(1e-9);
}

INSTANTIATE_TEST_SUITE_P(AllJoints, ReactionConformance, ::testing::ValuesIn(reaction_cases()),
                         [](const auto& c) { return c.param.name; });

// A bar of 1 kg and 1 m. In its own axes the hinge carries the weight and the inertia force of the
// centre of mass, at half its length.
TEST(Reaction, OfAPendulumByHand) {
  for (const char* friction : {"", pin_friction()}) {
    Compiled c(pendulum(friction),
               let_go("{hinge: {position: 0.7, velocity: -3.0}}", "hinge/position"));
    ASSERT_TRUE(c.start().ok());
    const double alpha = reaction_value(&c, "hinge/acceleration");
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_force/x"), -0.5 * alpha - 9.81 * std::sin(0.7),
                1e-12);
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_force/y"), 0.0, 1e-12);
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_force/z"), 0.5 * 9.0 + 9.81 * std::cos(0.7),
                1e-12);
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_torque/x"), 0.0, 1e-12);
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_torque/z"), 0.0, 1e-12);
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_torque/y"),
                (0.0834 + 0.25) * alpha + 0.5 * 9.81 * std::sin(0.7), 1e-12);
    if (*friction == '\0') continue;
    EXPECT_GT(std::abs(reaction_value(&c, "hinge/friction")), 0.01);
    EXPECT_NEAR(reaction_value(&c, "hinge/reaction_torque/y - hinge/friction"), 0.0, 1e-14);
    // Without a tilting moment the normal force (12) is pi^3/24 times the transverse force.
    const double pin = std::hypot(reaction_value(&c, "hinge/reaction_force/x"),
                                  reaction_value(&c, "hinge/reaction_force/z"));
    EXPECT_NEAR(reaction_value(&c, "hinge/normal_force"), M_PI * M_PI * M_PI / 24.0 * pin,
                1e-2 * pin);
  }
}

TEST(Reaction, HoldsTheNormalForceOfAPlaneAndOfABall) {
  Compiled plane(puck(), "duration: 1.0\n"), ball(ball_pendulum(), "duration: 1.0\n");
  ASSERT_TRUE(plane.start().ok() && ball.start().ok());
  ASSERT_TRUE(scramble(&plane) && scramble(&ball));
  const auto smoothing = [](const Compiled& c) {
    return c.equations.constants().pairs[0].friction.smoothing;
  };
  const double N = reaction_value(&plane, "slope/normal_force");
  EXPECT_GT(N, 1.0);
  EXPECT_NEAR(std::hypot(reaction_value(&plane, "slope/reaction_force/z"), smoothing(plane)), N,
              1e-11 * N);
  EXPECT_NEAR(std::hypot(reaction_value(&plane, "slope/reaction_force/x"),
                         reaction_value(&plane, "slope/reaction_force/y")),
              std::abs(reaction_value(&plane, "slope/friction")), 1e-9 * N)
      << "in the plane the joint rubs and no more";
  double square = smoothing(ball) * smoothing(ball);
  for (const char* axis : {"x", "y", "z"})
    square += std::pow(reaction_value(&ball, std::string("ball_z/reaction_force/") + axis), 2);
  EXPECT_NEAR(std::sqrt(square), reaction_value(&ball, "ball_x/normal_force"),
              1e-9 * std::sqrt(square));
}

// The torque on the wheel is its inertia times its acceleration: the effort minus the torque that
// accelerates the rotor.
TEST(Reaction, OfAGearWithItsRotorByHand) {
  const std::string disc =
      "<inertial><mass value='1'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' "
      "izz='0.2'/></inertial>";
  Compiled c(robot("<link name='wheel'>" + disc +
                   "</link><joint name='drive' type='continuous'><parent link='ground'/><child "
                   "link='wheel'/><axis xyz='0 0 1'/>"
                   "<codesign:actuator gear_ratio='5' rotor_inertia='0.004'/></joint>"),
             "duration: 1.0\nloads: [{joint: drive, effort: 0.3}]\ngravity: [0, 0, 0]\n");
  ASSERT_TRUE(c.start().ok());
  EXPECT_NEAR(reaction_value(&c, "drive/reaction_torque/z"), 0.3 * 0.2 / (0.2 + 25.0 * 0.004),
              1e-14);
}

TEST(Reaction, AroundTheLoopOfTheSpatialSliderCrank) {
  Compiled c(Shipped("slider_crank").robot,
             "duration: 1.0\ninitial_state: {crank_joint: {position: 0.5, velocity: "
             "-10.0}}\nloads: [{joint: crank_joint, effort: 0.2}]\n",
             {});
  ASSERT_TRUE(c.start().ok());
  expect_balance(&c, 1e-9);
  const double friction = reaction_value(&c, "slider_joint/friction");
  EXPECT_GT(std::abs(friction), 0.1);
  EXPECT_NEAR(reaction_value(&c, "slider_joint/reaction_force/x"), friction,
              1e-12 * std::abs(friction));
  EXPECT_NEAR(reaction_value(&c, "crank_joint/reaction_torque/x"), 0.2, 1e-12);
}

}  // namespace
}  // namespace codesign
