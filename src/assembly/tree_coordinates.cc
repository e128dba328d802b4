// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/tree_coordinates.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "codegen/number_types.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "math/euler_parameters.h"
#include "mechanism/pose.h"

namespace codesign {
namespace {

// Of the second of three turns, where the first and the third turn about one axis.
constexpr double kLeastCosine = 1e-6;

LinkMotion<double> motion_of(const System& system, const Equations<double>& equations, int link) {
  const int body = system.topology().link_body[to_index(link)];
  const BodyKinematics<double>& b = equations.formulas().body(body);
  const LinkConstants<double>& at = equations.constants().links[to_index(link)];
  LinkMotion<double> motion;
  const Vector3<double> arm = b.A * at.s;
  motion.X = {b.A * at.R, b.r + arm};
  if (b.at_rest) return motion;
  motion.omega = ground_omega(b);
  motion.velocity = b.rd + motion.omega.cross(arm);
  return motion;
}

/// The child's motion relative to the joint frame, which is fixed in the parent, in the axes of
/// that frame.
LinkMotion<double> relative_motion(const LinkMotion<double>& parent, const Pose<double>& origin,
                                   const LinkMotion<double>& child) {
  const Pose<double> frame = parent.X * origin;
  LinkMotion<double> motion;
  motion.X = frame.inverse() * child.X;
  motion.omega = frame.R.transpose() * (child.omega - parent.omega);
  const Vector3<double> at_child = parent.velocity + parent.omega.cross(child.X.t - parent.X.t);
  motion.velocity = frame.R.transpose() * (child.velocity - at_child);
  return motion;
}

/// The slides of a joint in the joint frame, which are normal to each other, and the axis of its
/// first turn.
struct FreedomAxes {
  std::vector<Vector3<double>> slides;
  Vector3<double> turn = Vector3<double>::UnitX();
};

FreedomAxes freedom_axes(const JointDescription& joint, const std::vector<double>& parameters) {
  FreedomAxes axes;
  bool is_first = true;
  visit_freedoms(joint, parameters, [&](bool turns, const Vector3<double>& axis) {
    if (!turns) axes.slides.push_back(axis);
    if (turns && is_first) axes.turn = axis;
    is_first = is_first && !turns;
  });
  return axes;
}

void turn_coordinate(const Vector3<double>& axis, const LinkMotion<double>& motion, int c,
                     TreeCoordinates* result) {
  const Vector3<double> x = transverse_axis<double>(axis, std::nullopt), turned = motion.X.R * x;
  result->theta[c] = std::atan2(axis.cross(x).dot(turned), x.dot(turned));
  result->rate[c] = axis.dot(motion.omega);
}

// R = R_x(a) R_y(b) R_z(c) R_start, omega = x a' + R_x(a) y b' + R_x(a) R_y(b) z c'.
bool three_turns(const Matrix3<double>& start, const LinkMotion<double>& motion, int c,
                 TreeCoordinates* result) {
  const Matrix3<double> R = motion.X.R * start.transpose();
  const double a = std::atan2(-R(1, 2), R(2, 2)), b = std::asin(std::clamp(R(0, 2), -1.0, 1.0));
  if (std::cos(b) < kLeastCosine) return false;
  const Matrix3<double> about_x = Eigen::AngleAxisd(a, Vector3<double>::UnitX()).toRotationMatrix();
  Matrix3<double> axes;
  axes << Vector3<double>::UnitX(), about_x.col(1),
      about_x * (Eigen::AngleAxisd(b, Vector3<double>::UnitY()).toRotationMatrix()).col(2);
  result->theta.segment<3>(c) << a, b, std::atan2(-R(0, 1), R(0, 0));
  result->rate.segment<3>(c) = axes.partialPivLu().solve(motion.omega);
  return true;
}

/// The inverse of a joint's motion, JointFreedoms: its coordinates from the child's motion in the
/// joint frame.
bool freedom_coordinates(const JointDescription& joint, const std::vector<double>& parameters,
                         const LinkMotion<double>& motion, int first, TreeCoordinates* result) {
  const FreedomAxes axes = freedom_axes(joint, parameters);
  int c = first;
  for (const Vector3<double>& axis : axes.slides) {
    result->theta[c] = axis.dot(motion.X.t);
    result->rate[c++] = axis.dot(motion.velocity);
  }
  if (joint.freedoms().turns == 1) turn_coordinate(axes.turn, motion, c, result);
  if (joint.freedoms().turns <= 1) return true;
  return joint.freedoms().turns == 3 &&
         three_turns(rotation_from_rpy<double>(vector_at(joint.start_rotation, parameters)), motion,
                     c, result);
}

bool scalar_coordinate(const System& system, int joint, int pair, int c,
                       Equations<double>* equations, TreeCoordinates* result) {
  const std::vector<ChainElement>& chain = system.topology().pairs[to_index(pair)].chain;
  for (std::size_t e = 0; e < chain.size(); ++e) {
    if (chain[e].joint != joint) continue;
    const auto& coordinates = equations->constants().pairs[to_index(pair)].coordinates;
    if (e >= coordinates.size() || coordinates[e].kind == CoordinateConstants<double>::Kind::kNone)
      return false;
    const CoordinateMotion<double>& motion =
        equations->formulas().coordinate(pair, static_cast<int>(e));
    result->theta[c] = motion.position;
    result->rate[c] = motion.rate;
    return true;
  }
  return false;
}

bool has_mass_at_both_ends(const System& system, const JointDescription& joint) {
  const std::vector<int>& body = system.topology().link_body;
  return body[to_index(joint.parent)] != Topology::kMassless &&
         body[to_index(joint.child)] != Topology::kMassless;
}

/// Sets the flags first .. first + count - 1 if `given`.
void mark(std::vector<bool>* flags, int first, int count, bool given) {
  for (int k = 0; given && k < count; ++k) (*flags)[to_index(first + k)] = true;
}

/// Writes a vector in the joint frame to the sliding coordinates of a joint.
template <class T>
void set_slides(const JointDescription& joint, const QuantityVector& vector,
                const std::vector<T>& parameters, Out<T> coordinates) {
  const Vector3<T> x = vector_at(vector, parameters);
  int k = 0;
  visit_freedoms(joint, parameters, [&](bool turns, const Vector3<T>& axis) {
    if (!turns) coordinates[k++] = dot<T>(x, axis);
  });
}

/// The position of a joint with a given one.
template <class T>
T position_at(const InitialJointState& initial, const std::vector<T>& parameters, double posture) {
  if (initial.positions.empty()) return initial.position->at(parameters);
  const auto before = static_cast<std::size_t>(posture);
  const double part = posture - static_cast<double>(before);
  const T from = initial.positions[before].at(parameters);
  if (part == 0.0) return from;
  return (1.0 - part) * from + part * initial.positions[before + 1].at(parameters);
}

}  // namespace

std::string tree_coordinates(const System& system, const TreeLayout& tree,
                             const State<double>& state, const VectorX<double>& rest,
                             Equations<double>* equations, TreeCoordinates* result) {
  equations->formulas().load(state);
  result->theta = rest;
  result->rate = VectorX<double>::Zero(rest.size());
  for (int k : tree.joint_order) {
    const JointDescription& joint = system.robot().joints[to_index(k)];
    const int pair = system.topology().joint_pair[to_index(k)], c = tree.offset[to_index(k)];
    if (joint.freedoms().size() == 0 || pair < 0) continue;
    if (joint.has_one_coordinate()) {
      if (!scalar_coordinate(system, k, pair, c, equations, result)) return joint.name;
      continue;
    }
    if (!has_mass_at_both_ends(system, joint)) return joint.name;
    const LinkMotion<double> motion = relative_motion(
        motion_of(system, *equations, joint.parent), pose_at(joint.origin, equations->parameters()),
        motion_of(system, *equations, joint.child));
    if (!freedom_coordinates(joint, equations->parameters(), motion, c, result)) return joint.name;
  }
  return {};
}

GivenStart::GivenStart(const System& system, TreeLayout* layout) {
  TreeLayout& tree = *layout;
  const auto size = to_index(tree.size);
  for (std::vector<bool>* flags : {&position, &guess, &velocity, &velocity_beside})
    flags->assign(size, false);
  for (std::size_t k = 0; k < system.robot().joints.size(); ++k) {
    if (!system.robot().joints[k].is_play) continue;
    mark(&position, tree.offset[k], 1, true);
    mark(&velocity, tree.offset[k], 1, true);
  }
  for (const InitialJointState& initial : system.study().initial_state) {
    const int joint = tree_joint(system.robot(), initial);
    if (joint < 0) continue;
    const int c = tree.offset[to_index(joint)];
    if (initial.guess) position[to_index(c)] = false;  // of a joint that plays
    mark(&position, c, 1, initial.position.has_value());
    mark(&guess, c, 1, initial.guess.has_value());
    mark(&velocity, c, 1, initial.velocity.has_value());
    const auto [each, slides, turns] = system.robot().joints[to_index(joint)].freedoms();
    mark(&position, c, slides, initial.translation.has_value());
    mark(&position, c + slides, turns, initial.rotation.has_value());
    mark(&velocity, c, slides, initial.linear_velocity.has_value());
    mark(&velocity, c + slides, turns, initial.angular_velocity.has_value());
    mark(&velocity_beside, c, slides, initial.angular_velocity && !initial.linear_velocity);
    mark(&velocity_beside, c + slides, turns, initial.linear_velocity && !initial.angular_velocity);
  }
  const auto is_given = [this](const std::pair<int, int>& motor) {
    return position[to_index(motor.first)];
  };
  tree.motors.erase(std::remove_if(tree.motors.begin(), tree.motors.end(), is_given),
                    tree.motors.end());
}

template <class T>
void set_given_start(const System& system, const TreeLayout& tree, const std::vector<T>& parameters,
                     double posture, VectorX<T>* theta, VectorX<T>* rate) {
  for (const InitialJointState& initial : system.study().initial_state) {
    const int index = tree_joint(system.robot(), initial);
    if (index < 0) continue;
    const JointDescription& joint = system.robot().joints[to_index(index)];
    const int c = tree.offset[to_index(index)];
    const int slides = joint.freedoms().slides;
    const bool turns_once = joint.freedoms().turns == 1;
    if (initial.position) (*theta)[c] = position_at(initial, parameters, posture);
    if (initial.velocity) (*rate)[c] = initial.velocity->at(parameters);
    if (initial.translation)
      set_slides(joint, *initial.translation, parameters, Out<T>(*theta).subspan(c, slides));
    if (initial.linear_velocity)
      set_slides(joint, *initial.linear_velocity, parameters, Out<T>(*rate).subspan(c, slides));
    if (initial.rotation && turns_once)
      (*theta)[c + slides] = (*initial.rotation)[2].at(parameters);
    if (initial.angular_velocity && turns_once)
      (*rate)[c + slides] = (*initial.angular_velocity)[2].at(parameters);
    if (initial.angular_velocity && !turns_once)
      rate->template segment<3>(c + slides) = vector_at(*initial.angular_velocity, parameters);
  }
}

template <class T>
void set_extra_states(const System& system, const std::vector<T>& parameters, VectorX<T>* s) {
  s->setZero(system.layout().states);
  const std::vector<Quantity>& given = system.study().initial_extra_states;
  for (std::size_t k = 0; k < given.size(); ++k) (*s)[to_signed(k)] = given[k].at(parameters);
  for (const Winding& winding : system.windings())
    if (winding.start >= 0)
      (*s)[winding.state] =
          system.study().initial_state[to_index(winding.start)].current->at(parameters);
  for (const StuckContact& stuck : system.stuck())
    if (const BristleContact& contact = system.bristles()[stuck.bristle]; contact.dwells())
      (*s)[contact.dwell_state()] = T(1.0);
}

#define CODESIGN_INSTANTIATE(T)                                                                  \
  template void set_given_start(const System&, const TreeLayout&, const std::vector<T>&, double, \
                                VectorX<T>*, VectorX<T>*);                                       \
  template void set_extra_states(const System&, const std::vector<T>&, VectorX<T>*);
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
