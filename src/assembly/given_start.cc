// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/given_start.h"

#include "codegen/number_types.h"
#include "math/span.h"
#include "mechanism/joint_steps.h"

namespace codesign {
namespace {

/// Sets the flags first .. first + count - 1 if `given`.
void mark(std::vector<bool>* flags, int first, int count, bool given) {
  for (int k = 0; given && k < count; ++k) (*flags)[static_cast<std::size_t>(first + k)] = true;
}

/// Writes a vector in the joint frame to the sliding coordinates of a planar (2) or floating (3) joint.
template <class T>
void set_slides(const JointDescription& joint, const QuantityVector& vector, const std::vector<T>& parameters, Out<T> coordinates) {
  const Vector3<T> x = vector_at(vector, parameters);
  if (joint.type == JointType::kFloating) {
    for (int k = 0; k < 3; ++k) coordinates[k] = x[k];
    return;
  }
  const PlaneAxes<T> plane = plane_axes(joint, parameters);
  coordinates[0] = dot<T>(x, plane.x);
  coordinates[1] = dot<T>(x, plane.y);
}

}  // namespace

GivenStart::GivenStart(const System& system, const TreeLayout& tree) {
  const auto size = static_cast<std::size_t>(tree.size);
  for (std::vector<bool>* flags : {&position, &guess, &velocity}) flags->assign(size, false);
  for (const InitialJointState& initial : system.study().initial_state) {
    const int joint = tree_joint(system.robot(), initial);
    if (joint < 0) continue;
    const int c = tree.offset[static_cast<std::size_t>(joint)];
    mark(&position, c, 1, initial.position.has_value());
    mark(&guess, c, 1, initial.guess.has_value());
    mark(&velocity, c, 1, initial.velocity.has_value());
    const bool planar = system.robot().joints[static_cast<std::size_t>(joint)].type == JointType::kPlanar;
    const int slides = planar ? 2 : 3, turns = planar ? 1 : 3;
    mark(&position, c, slides, initial.translation.has_value());
    mark(&position, c + slides, turns, initial.rotation.has_value());
    mark(&velocity, c, slides, initial.linear_velocity.has_value());
    mark(&velocity, c + slides, turns, initial.angular_velocity.has_value());
  }
}

template <class T>
void set_given_start(const System& system, const TreeLayout& tree, const std::vector<T>& parameters, VectorX<T>* theta, VectorX<T>* rate) {
  for (const InitialJointState& initial : system.study().initial_state) {
    const int index = tree_joint(system.robot(), initial);
    if (index < 0) continue;
    const JointDescription& joint = system.robot().joints[static_cast<std::size_t>(index)];
    const int c = tree.offset[static_cast<std::size_t>(index)];
    const bool planar = joint.type == JointType::kPlanar;
    const int slides = planar ? 2 : 3;
    if (initial.position) (*theta)[c] = initial.position->at(parameters);
    if (initial.velocity) (*rate)[c] = initial.velocity->at(parameters);
    if (initial.translation) set_slides(joint, *initial.translation, parameters, Out<T>(*theta).subspan(c, slides));
    if (initial.linear_velocity) set_slides(joint, *initial.linear_velocity, parameters, Out<T>(*rate).subspan(c, slides));
    if (initial.rotation && planar) (*theta)[c + 2] = (*initial.rotation)[2].at(parameters);
    if (initial.angular_velocity && planar) (*rate)[c + 2] = (*initial.angular_velocity)[2].at(parameters);
    if (initial.angular_velocity && !planar) rate->template segment<3>(c + 3) = vector_at(*initial.angular_velocity, parameters);
  }
}

template <class T>
void set_extra_states(const System& system, const std::vector<T>& parameters, VectorX<T>* s) {
  s->setZero(system.layout().states);
  const std::vector<Quantity>& given = system.study().initial_extra_states;
  for (std::size_t k = 0; k < given.size(); ++k) (*s)[static_cast<Eigen::Index>(k)] = given[k].at(parameters);
}

#define CODESIGN_INSTANTIATE(T)                                                                                     \
  template void set_given_start(const System&, const TreeLayout&, const std::vector<T>&, VectorX<T>*, VectorX<T>*); \
  template void set_extra_states(const System&, const std::vector<T>&, VectorX<T>*);
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
