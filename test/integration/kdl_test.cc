// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
//
// Compares accelerations of robots without loops with Orocos KDL, a library that many ROS packages
// use.
#include <gtest/gtest.h>

#ifdef CODESIGN_HAS_KDL

#include <urdf_parser/urdf_parser.h>

#include <filesystem>
#include <kdl/frames.hpp>
#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <random>

#include "assembly/make_system.h"
#include "description/study.h"
#include "equations/compiled_system.h"
#include "found_robots.h"
#include "integration/simulation_of.h"
#include "math/dense.h"
#include "mechanism/topology.h"
#include "mechanism_codesign/simulation.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

KDL::Vector to_kdl(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

KDL::Frame to_kdl(const urdf::Pose& pose) {
  return {
      KDL::Rotation::Quaternion(pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w),
      to_kdl(pose.position)};
}

/// URDF gives the inertia in axes of its own, KDL wants it in the link's.
KDL::RigidBodyInertia to_kdl(const urdf::Inertial& inertial) {
  const KDL::Frame origin = to_kdl(inertial.origin);
  const KDL::RotationalInertia given(inertial.ixx, inertial.iyy, inertial.izz, inertial.ixy,
                                     inertial.ixz, inertial.iyz);
  const KDL::RigidBodyInertia turned =
      origin.M * KDL::RigidBodyInertia(0.0, KDL::Vector::Zero(), given);
  return KDL::RigidBodyInertia(inertial.mass, origin.p, turned.getRotationalInertia());
}

KDL::Joint to_kdl(const urdf::Joint& joint) {
  const KDL::Frame F = to_kdl(joint.parent_to_joint_origin_transform);
  const KDL::Vector axis = F.M * to_kdl(joint.axis);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return KDL::Joint(joint.name, F.p, axis, KDL::Joint::RotAxis);
    case urdf::Joint::PRISMATIC:
      return KDL::Joint(joint.name, F.p, axis, KDL::Joint::TransAxis);
    default:
      return KDL::Joint(joint.name, KDL::Joint::None);
  }
}

void add_children(const urdf::LinkConstSharedPtr& link, KDL::Tree* tree) {
  for (const urdf::LinkSharedPtr& child : link->child_links) {
    const KDL::RigidBodyInertia inertia =
        child->inertial ? to_kdl(*child->inertial) : KDL::RigidBodyInertia::Zero();
    const urdf::Joint& joint = *child->parent_joint;
    tree->addSegment(KDL::Segment(child->name, to_kdl(joint),
                                  to_kdl(joint.parent_to_joint_origin_transform), inertia),
                     link->name);
    add_children(child, tree);
  }
}

/// Forward dynamics from KDL's inverse dynamics: M q'' = -h(q, q').
class KdlReference {
 public:
  explicit KdlReference(const std::string& urdf) : tree_("") {
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(urdf);
    tree_ = KDL::Tree(model->getRoot()->name);
    add_children(model->getRoot(), &tree_);
  }

  std::map<std::string, unsigned> joints() const {
    std::map<std::string, unsigned> numbers;
    for (const auto& [name, element] : tree_.getSegments()) {
      const KDL::Joint& joint = GetTreeElementSegment(element).getJoint();
      if (joint.getType() != KDL::Joint::None)
        numbers[joint.getName()] = GetTreeElementQNr(element);
    }
    return numbers;
  }

  /// @param moved joints that move a mass; the others stay.
  Eigen::VectorXd accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& rate,
                                const KDL::Vector& gravity, const std::vector<unsigned>& moved) {
    const auto n = static_cast<Eigen::Index>(moved.size());
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size()),
                          h = torques(q, rate, zero, gravity);
    Eigen::MatrixXd M(n, n);
    Eigen::VectorXd bias(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      bias[k] = h[moved[static_cast<std::size_t>(k)]];
      const Eigen::VectorXd column =
          torques(q, zero, Eigen::VectorXd::Unit(q.size(), moved[static_cast<std::size_t>(k)]),
                  KDL::Vector::Zero());
      for (Eigen::Index i = 0; i < n; ++i) M(i, k) = column[moved[static_cast<std::size_t>(i)]];
    }
    const Eigen::VectorXd scale = M.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * M * scale.asDiagonal();
    return scale.asDiagonal() * solve_positive_definite(scaled, -(scale.asDiagonal() * bias));
  }

 private:
  Eigen::VectorXd torques(const Eigen::VectorXd& q, const Eigen::VectorXd& rate,
                          const Eigen::VectorXd& a, const KDL::Vector& gravity) {
    KDL::TreeIdSolver_RNE solver(tree_, gravity);
    const auto array = [](const Eigen::VectorXd& x) {
      KDL::JntArray result(static_cast<unsigned>(x.size()));
      result.data = x;
      return result;
    };
    KDL::JntArray torque(static_cast<unsigned>(q.size()));
    EXPECT_GE(solver.CartToJnt(array(q), array(rate), array(a), {}, torque), 0);
    return torque.data;
  }

  KDL::Tree tree_;
};

/// Elements that KDL does not have: dissipation, springs and mimicking joints.
RobotDescription bare(RobotDescription robot) {
  for (JointDescription& joint : robot.joints) {
    joint.damping = joint.dry_friction = 0.0;
    joint.friction.reset();
    joint.spring.reset();
    joint.mimic.reset();
    joint.actuator.reset();
  }
  return robot;
}

bool is_tree_of_simple_joints(const RobotDescription& robot) {
  for (const JointDescription& joint : robot.joints)
    if (joint.is_loop || joint.type == JointType::kPlanar || joint.type == JointType::kFloating)
      return false;
  return robot.couplings.empty();
}

/// The largest difference of an acceleration, relative to the largest acceleration, at `states`
/// random states.
double largest_difference(const std::string& urdf, int states, unsigned seed) {
  const RobotDescription robot = bare(read_urdf({"robot.urdf", urdf}));
  const Topology topology = derive_topology(robot);
  KdlReference reference(urdf);
  const std::map<std::string, unsigned> numbers = reference.joints();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  double worst = 0.0;
  for (int k = 0; k < states; ++k) {
    Study study;
    study.parameters = robot.parameters;
    const double g[] = {uniform(random), uniform(random), -9.81 + uniform(random)};
    for (std::size_t axis = 0; axis < 3; ++axis) study.gravity[axis] = g[axis];
    Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers.size())), rate = q;
    std::vector<SignalDescription> signals;
    std::vector<unsigned> moved;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      if (topology.joint_pair[j] < 0) continue;
      const unsigned number = numbers.at(robot.joints[j].name);
      InitialJointState initial;
      initial.joint = robot.joints[j].name;
      initial.position = q[number] = uniform(random);
      initial.velocity = rate[number] = uniform(random);
      study.initial_state.push_back(initial);
      SignalTerm term;
      term.object = initial.joint;
      term.quantity = "acceleration";
      signals.push_back({initial.joint, {term}, {}});
      moved.push_back(number);
    }
    const auto system = make_system(robot, study);
    Simulation simulation = simulation_of(system, system->parameters(), signals);
    EXPECT_TRUE(simulation.start().ok());
    Frame frame;
    simulation.sample(0.0, &frame);
    const Eigen::VectorXd expected = reference.accelerations(q, rate, {g[0], g[1], g[2]}, moved);
    for (std::size_t i = 0; i < moved.size(); ++i)
      worst = std::max(worst, std::abs(frame.signals[i] - expected[static_cast<Eigen::Index>(i)]) /
                                  (1.0 + expected.cwiseAbs().maxCoeff()));
  }
  return worst;
}

/// Trees of random joints, masses, welds, and links without mass at the ends.
std::string random_robot(unsigned seed, int links) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto three = [&](double size) {
    return std::to_string(size * uniform(random)) + " " + std::to_string(size * uniform(random)) +
           " " + std::to_string(size * uniform(random));
  };
  std::string text =
      "<robot name='random'><link name='l0'><inertial><mass value='-3'/><inertia ixx='0' ixy='0' "
      "ixz='0' iyy='0' iyz='0' "
      "izz='0'/></inertial></link>\n";
  for (int k = 1; k <= links; ++k) {
    const double kind = uniform(random);
    const char* type = k > 1 && kind < -0.6 ? "fixed"
                       : kind < 0.0         ? "prismatic"
                       : kind < 0.5         ? "revolute"
                                            : "continuous";
    const int parent = std::max(0, k - 1 - static_cast<int>(2.0 * std::abs(uniform(random))));
    const std::string n = std::to_string(k);
    const double m = 0.5 + std::abs(uniform(random)), I = 0.05 * m;
    text += "<link name='l" + n + "'><inertial><origin xyz='" + three(0.2) + "' rpy='" +
            three(1.5) + "'/><mass value='" + std::to_string(m) + "'/><inertia ixx='" +
            std::to_string(I) + "' ixy='0.001' ixz='-0.002' iyy='" + std::to_string(1.3 * I) +
            "' iyz='0.0015' izz='" + std::to_string(0.8 * I) +
            "'/></inertial></link><joint name='j" + n + "' type='" + type + "'><parent link='l" +
            std::to_string(parent) + "'/><child link='l" + n + "'/><origin xyz='" + three(0.5) +
            "' rpy='" + three(3.0) + "'/><axis xyz='" + three(1.0) +
            "'/><limit effort='0' velocity='0'/></joint>\n";
  }
  return text + "<link name='tip'/><joint name='tip_joint' type='continuous'><parent link='l" +
         std::to_string(links) + "'/><child link='tip'/></joint></robot>";
}

TEST(Kdl, AccelerationsOfRandomTrees) {
  for (unsigned seed = 1; seed <= 12; ++seed)
    EXPECT_LT(largest_difference(random_robot(seed, 2 + static_cast<int>(seed)), 3, seed), 1e-10)
        << "seed " << seed;
}

TEST(Kdl, AccelerationsWithIdealBodies) {
  const auto link = [](const std::string& name, const std::string& inertial) {
    return "<link name='" + name + "'>" + inertial + "</link>";
  };
  const auto body = [](const std::string& mass, const std::string& ixx, const std::string& izz) {
    return "<inertial><origin xyz='0.3 0.1 0.05'/><mass value='" + mass + "'/><inertia ixx='" +
           ixx + "' ixy='0' ixz='0' iyy='" + ixx + "' iyz='0' izz='" + izz + "'/></inertial>";
  };
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child +
           "'/><origin xyz='0.4 0.05 -0.1' rpy='0.3 -0.2 0.5'/><axis xyz='" + axis + "'/></joint>";
  };
  // Two skew hinges without a mass between them, a point, a rod, a rotor, a flat link that breaks
  // the triangle inequality, a massless fork.
  EXPECT_LT(largest_difference(
                "<robot name='ideal'>" + link("ground", "") + link("a", "") +
                    link("b", body("2", "0", "0")) + link("c", body("1", "0.1", "0")) +
                    link("rotor", body("0", "0.01", "0.02")) + link("d", body("1", "0", "0.3")) +
                    link("fork", "") + link("e", body("1", "0.1", "0.1")) +
                    link("f", body("1", "0.1", "0.1")) + joint("1", "ground", "a", "0 0 1") +
                    joint("2", "a", "b", "0 1 0") + joint("3", "b", "c", "1 1 0") +
                    joint("4", "b", "rotor", "0 0 1") + joint("5", "c", "d", "0 0 1") +
                    joint("6", "d", "fork", "1 0 0") + joint("7", "fork", "e", "0 1 0") +
                    joint("8", "fork", "f", "0 0 1") + "</robot>",
                5, 3),
            1e-10);
}

TEST(Kdl, AccelerationsOfRobotsAsTheyAreFound) {
  if (found_robots().empty()) GTEST_SKIP() << kNoFoundRobots;
  int compared = 0;
  for (const std::filesystem::path& file : found_robots()) {
    const std::string text = read_source(file.string()).text;
    if (!is_tree_of_simple_joints(read_urdf({"robot.urdf", text}))) continue;
    try {
      EXPECT_LT(largest_difference(text, 2, 7), 1e-10) << file;
      ++compared;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("not determined"), std::string::npos)
          << file << ": " << error.what();
    }
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace codesign

#else

TEST(Kdl, IsCompared) { GTEST_SKIP() << "liborocos-kdl-dev is not installed"; }

#endif
