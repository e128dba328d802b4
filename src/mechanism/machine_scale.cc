// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/machine_scale.h"

#include <algorithm>
#include <cmath>

#include "codegen/number_types.h"
#include "math/arrays.h"
#include "mechanism/pose.h"

namespace codesign {
namespace {

// Of a body on its own axis, as a point: this part of its mass times the square of the machine's
// radius.
constexpr double kLeastInertia = 1e-6;

template <class T>
Matrix3<T> product(const Vector3<T>& a, const Vector3<T>& b) {
  return dot(a, b) * Matrix3<T>::Identity() - a * b.transpose();
}

/// Adds masses that are given in frame B. @param X the pose of B in the frame of `sum`.
template <class T>
void add_mass(const Pose<T>& X, const CarriedMass<T>& part, CarriedMass<T>* sum) {
  const Vector3<T> turned = X.R * part.moment;
  sum->J += X.R * part.J * X.R.transpose() + product(X.t, turned) + product(turned, X.t) +
            part.mass * product(X.t, X.t);
  sum->moment += turned + part.mass * X.t;
  sum->mass += part.mass;
}

template <class T>
CarriedMass<T> mass_of_link(const LinkDescription& link, const std::vector<T>& parameters,
                            std::vector<MassProperties<T>>* shapes) {
  CarriedMass<T> result;
  if (!link.inertial) return result;
  const MassProperties<T> m = mass_properties<T>(*link.inertial, parameters, shapes);
  CarriedMass<T> at_centre;
  at_centre.mass = m.mass;
  at_centre.J = m.inertia;
  Pose<T> X;
  X.t = m.centre;
  add_mass(X, at_centre, &result);
  return result;
}

void order_from_leaves(const RobotDescription& robot, std::vector<std::size_t>* order) {
  if (!order->empty()) return;
  std::vector<std::vector<std::size_t>> below(robot.links.size());
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (!robot.joints[j].is_loop) below[to_index(robot.joints[j].parent)].push_back(j);
  std::vector<int> links = {robot.root};
  while (!links.empty()) {
    const std::vector<std::size_t>& joints = below[to_index(links.back())];
    links.pop_back();
    for (std::size_t j : joints) {
      order->push_back(j);
      links.push_back(robot.joints[j].child);
    }
  }
  std::reverse(order->begin(), order->end());
}

/// Sets MachineScale::carried: what hangs on each link, itself included, in its frame. The mass of
/// the root, which is the ground, does not count.
template <class T>
void carry(const RobotDescription& robot, const std::vector<T>& parameters,
           MachineScale<T>* scale) {
  scale->carried.clear();
  for (std::size_t k = 0; k < robot.links.size(); ++k)
    scale->carried.push_back(static_cast<int>(k) == robot.root
                                 ? CarriedMass<T>()
                                 : mass_of_link(robot.links[k], parameters, &scale->shapes));
  order_from_leaves(robot, &scale->from_leaves);
  for (std::size_t j : scale->from_leaves) {
    const JointDescription& joint = robot.joints[j];
    add_mass(pose_at(joint.origin, parameters), scale->carried[to_index(joint.child)],
             &scale->carried[to_index(joint.parent)]);
  }
}

/// What hangs on a joint, in its frame.
template <class T>
CarriedMass<T> mass_on_joint(const RobotDescription& robot, const JointDescription& joint,
                             const std::vector<T>& parameters,
                             const std::vector<CarriedMass<T>>& carried) {
  const bool on_parent = joint.child == robot.root;
  Pose<T> X = joint.is_loop ? pose_at(joint.child_origin, parameters) : Pose<T>();
  if (on_parent) X = pose_at(joint.origin, parameters);
  CarriedMass<T> result;
  add_mass(X.inverse(), carried[to_index(on_parent ? joint.parent : joint.child)], &result);
  return result;
}

template <class T>
JointScale<T> scale_of_joint(const RobotDescription& robot, const JointDescription& joint,
                             const std::vector<T>& parameters, const MachineScale<T>& machine) {
  const CarriedMass<T> on_joint = mass_on_joint(robot, joint, parameters, machine.carried);
  JointScale<T> scale;
  scale.mass = is_less(T(0.0), on_joint.mass, true) ? on_joint.mass : machine.all.mass;
  if (!joint.has_one_coordinate()) return scale;
  const Vector3<T> axis = axis_at(joint.axis, parameters);
  scale.inertia = scale.mass;
  if (joint.is_turn())
    scale.inertia = dot<T>(axis, on_joint.J * axis) + T(kLeastInertia) * machine.all.inertia;
  return scale;
}

/// a of (13i).
template <class T>
T acceleration_scale(const MotionStudy& study, const JointScale<T>& all) {
  using std::sqrt;
  const std::array<double, 3>& g = study.gravity;
  const double gravity = std::hypot(g[0], g[1], g[2]), time = time_scale(study);
  if (gravity > 0.0) return T(gravity);
  if (!is_less(T(0.0), all.mass, true) || !is_less(T(0.0), all.inertia, true))
    return T(1.0 / (time * time));
  return sqrt(all.inertia / all.mass) / T(time * time);
}

}  // namespace

double time_scale(const MotionStudy& study) {
  return study.duration > 0.0 && study.postures == 0 ? study.duration : 1.0;
}

template <class T>
void set_machine_scale(const RobotDescription& robot, const MotionStudy& study,
                       const std::vector<T>& parameters, MachineScale<T>* scale) {
  carry(robot, parameters, scale);
  const CarriedMass<T>& all = scale->carried[to_index(robot.root)];
  scale->all.mass = all.mass;
  scale->all.inertia = T(0.5) * (all.J(0, 0) + all.J(1, 1) + all.J(2, 2));
  scale->acceleration = acceleration_scale(study, scale->all);
  scale->joints.clear();
  for (const JointDescription& joint : robot.joints)
    scale->joints.push_back(scale_of_joint(robot, joint, parameters, *scale));
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (robot.joints[j].motor >= 0)
      scale->joints[to_index(robot.joints[j].motor)] = scale->joints[j];
}

#define CODESIGN_INSTANTIATE(T)                                                   \
  template void set_machine_scale<T>(const RobotDescription&, const MotionStudy&, \
                                     const std::vector<T>&, MachineScale<T>*);
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
