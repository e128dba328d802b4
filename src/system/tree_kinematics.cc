// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/tree_kinematics.h"

#include <functional>
#include <queue>
#include <utility>

#include "codegen/number_types.h"
#include "joints/joint_sweep.h"
#include "math/arrays.h"
#include "mechanism/pose.h"
#include "system/forest_motion.h"

namespace codesign {

namespace {

/// Pose and twist of a joint's child frame relative to the joint frame, which is the child frame at
/// theta = 0.
template <class T>
struct RelativeMotion {
  Pose<T> X;
  Vector3<T> omega = Vector3<T>::Zero(), velocity = Vector3<T>::Zero();  // in the joint frame
};

template <class T>
RelativeMotion<T> joint_motion(const JointDescription& joint, const std::vector<T>& parameters,
                               In<T> theta, In<T> rate) {
  RelativeMotion<T> m;
  int k = 0;
  visit_freedoms(joint, parameters, [&](bool turns, const Vector3<T>& axis) {
    const Vector3<T> u = m.X.R * axis;
    (turns ? m.omega : m.velocity) += u * rate[k];
    if (turns)
      m.X.R = turned<T>(u, m.X.R, theta[k]);
    else
      m.X.t += u * theta[k];
    ++k;
  });
  if (joint.freedoms().turns == 3)
    m.X.R = m.X.R * rotation_from_rpy<T>(vector_at(joint.start_rotation, parameters));
  return m;
}

}  // namespace

// The order equals the order of repeated passes over the file, each of which takes the joints whose
// parent is placed. The queue computes it without one pass per level if a file lists children
// before parents.
TreeLayout::TreeLayout(const RobotDescription& robot) : offset(robot.joints.size(), 0) {
  std::vector<std::vector<int>> children(robot.links.size());
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (!robot.joints[k].is_loop)
      children[to_index(robot.joints[k].parent)].push_back(static_cast<int>(k));
  // A joint that stands behind its parent's joint in the file is taken in the same pass, else in
  // the next one.
  using Visit = std::pair<int, int>;  // pass, joint
  std::priority_queue<Visit, std::vector<Visit>, std::greater<>> next;
  for (int k : children[to_index(robot.root)]) next.emplace(0, k);
  while (!next.empty()) {
    const auto [pass, joint] = next.top();
    next.pop();
    joint_order.push_back(joint);
    for (int k : children[to_index(robot.joints[to_index(joint)].child)])
      next.emplace(k > joint ? pass : pass + 1, k);
  }
  for (int k : joint_order) {
    offset[to_index(k)] = size;
    size += robot.joints[to_index(k)].freedoms().size();
  }
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].motor >= 0)
      motors.emplace_back(offset[to_index(robot.joints[k].motor)], offset[k]);
}

template <class T>
void link_motions(const RobotDescription& robot, const TreeLayout& layout,
                  const std::vector<T>& parameters, const VectorX<T>& theta,
                  const VectorX<T>& theta_rate, std::vector<LinkMotion<T>>* result) {
  std::vector<LinkMotion<T>>& links = *result;
  links.assign(robot.links.size(), LinkMotion<T>());
  for (int k : layout.joint_order) {
    const JointDescription& joint = robot.joints[to_index(k)];
    const LinkMotion<T>& parent = links[to_index(joint.parent)];
    LinkMotion<T>& child = links[to_index(joint.child)];
    const int first = layout.offset[to_index(k)], count = joint.freedoms().size();
    const Pose<T> X_GF = parent.X * pose_at(joint.origin, parameters);
    const RelativeMotion<T> m = joint_motion(joint, parameters, In<T>(theta).subspan(first, count),
                                             In<T>(theta_rate).subspan(first, count));
    child.X = X_GF * m.X;
    child.omega = parent.omega + X_GF.R * m.omega;
    child.velocity =
        parent.velocity + cross<T>(parent.omega, child.X.t - parent.X.t) + X_GF.R * m.velocity;
  }
}

void coordinate_twists(const RobotDescription& robot, const TreeLayout& layout,
                       const std::vector<double>& parameters, const VectorX<double>& theta,
                       const std::vector<LinkMotion<double>>& links,
                       std::vector<CoordinateTwist>* result) {
  std::vector<CoordinateTwist>& twists = *result;
  twists.resize(to_index(layout.size));
  for (int k : layout.joint_order) {
    const JointDescription& joint = robot.joints[to_index(k)];
    const int first = layout.offset[to_index(k)], count = joint.freedoms().size();
    if (count == 0) continue;
    const Matrix3<double> R = links[to_index(joint.parent)].X.R *
                              rotation_from_rpy<double>(vector_at(joint.origin.rpy, parameters));
    double unit[6] = {};
    for (int c = 0; c < count; ++c) {
      unit[c] = 1.0;
      const RelativeMotion<double> m =
          joint_motion(joint, parameters, In<double>(theta).subspan(first, count), unit);
      twists[to_index(first + c)] = {R * m.omega, R * m.velocity, links[to_index(joint.child)].X.t};
      unit[c] = 0.0;
    }
  }
}

void set_turns(const System& system, const TreeLayout& layout, const VectorX<double>& theta,
               State<double>* state) {
  for (std::size_t p = 0; p < system.topology().pairs.size(); ++p) {
    const Pair& pair = system.topology().pairs[p];
    for (std::size_t e = 0; e < pair.chain.size(); ++e) {
      const auto joint = to_index(pair.chain[e].joint);
      state->turns[to_index(system.layout().turn(static_cast<int>(p), static_cast<int>(e)))] =
          system.robot().joints[joint].is_loop ? 0.0 : theta[layout.offset[joint]];
    }
  }
}

namespace {

/// r and p of one body and their rates, from c on.
template <class T>
void place_body(const LinkMotion<T>& link, const Vector3<T>& centre, Eigen::Index c, VectorX<T>* q,
                VectorX<T>* v) {
  const Vector3<T> arm = link.X.R * centre;
  const Vector4<T> p = euler_parameters(link.X.R);
  q->template segment<3>(c) = link.X.t + arm;
  q->template segment<4>(c + 3) = p;
  v->template segment<3>(c) = link.velocity + cross(link.omega, arm);
  v->template segment<4>(c + 3) = T(0.5) * (ground_rate_matrix(p).transpose() * link.omega);
}

}  // namespace

template <class T>
void body_coordinates(const System& system, const Constants<T>& constants,
                      const std::vector<LinkMotion<T>>& links, VectorX<T>* q, VectorX<T>* v) {
  const std::vector<Body>& bodies = system.topology().bodies;
  for (VectorX<T>* x : {q, v}) x->resize(kBodySize * to_signed(bodies.size()));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    place_body(links[to_index(bodies[b].base_link)], constants.bodies[b].centre,
               to_signed(kBodySize * b), q, v);
}

void set_signs(const System& system, const Constants<double>& constants,
               const std::vector<LinkMotion<double>>& links, State<double>* state) {
  const Layout& layout = system.layout();
  for (int body : layout.forest.order) {
    const int base = system.topology().bodies[to_index(body)].base_link;
    const Vector4<double> p = euler_parameters(links[to_index(base)].X.R);
    double& sign = state->turns[to_index(layout.sign_slot + body)];
    if (p.dot(body_parameters(system, constants, *state, body)) < 0.0) sign = -sign;
  }
}

template <class T>
void state_coordinates(const System& system, const TreeLayout& layout,
                       const Constants<T>& constants, const std::vector<LinkMotion<T>>& links,
                       const VectorX<T>& theta, const VectorX<T>& theta_rate, VectorX<T>* q,
                       VectorX<T>* v) {
  const Topology& topology = system.topology();
  const Layout& at = system.layout();
  for (VectorX<T>* x : {q, v}) x->resize(at.n);
  for (std::size_t b = 0; b < topology.bodies.size(); ++b) {
    Eigen::Index c = at.column(static_cast<int>(b));
    if (at.is_free(static_cast<int>(b))) {
      place_body(links[to_index(topology.bodies[b].base_link)], constants.bodies[b].centre, c, q,
                 v);
      continue;
    }
    for (const ChainElement& element : topology.pairs[to_index(at.forest.pair_above[b])].chain) {
      const auto joint = to_index(element.joint);
      for (int k = 0; k < system.robot().joints[joint].freedoms().size(); ++k, ++c) {
        (*q)[c] = theta[layout.offset[joint] + k];
        (*v)[c] = theta_rate[layout.offset[joint] + k];
      }
    }
  }
}

#define CODESIGN_INSTANTIATE(T)                                                                  \
  template void link_motions(const RobotDescription&, const TreeLayout&, const std::vector<T>&,  \
                             const VectorX<T>&, const VectorX<T>&, std::vector<LinkMotion<T>>*); \
  template void body_coordinates(const System&, const Constants<T>&,                             \
                                 const std::vector<LinkMotion<T>>&, VectorX<T>*, VectorX<T>*);   \
  template void state_coordinates(const System&, const TreeLayout&, const Constants<T>&,         \
                                  const std::vector<LinkMotion<T>>&, const VectorX<T>&,          \
                                  const VectorX<T>&, VectorX<T>*, VectorX<T>*);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

int tree_joint(const RobotDescription& robot, const InitialJointState& initial) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].name == initial.joint && !robot.joints[k].is_loop)
      return static_cast<int>(k);
  return -1;
}

RobotDescription with_start(RobotDescription robot, const MotionStudy& study) {
  for (JointDescription& joint : robot.joints) joint.start_position.reset();
  for (const InitialJointState& initial : study.initial_state) {
    const int joint = tree_joint(robot, initial);
    if (joint < 0) continue;
    JointDescription& description = robot.joints[to_index(joint)];
    if (initial.position) description.start_position = initial.position;
    if (initial.guess) description.start_position = Quantity(*initial.guess);
    if (!initial.rotation) continue;
    if (description.freedoms().turns == 3) description.start_rotation = *initial.rotation;
  }
  return robot;
}

}  // namespace codesign
