// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/inverse_dynamics.h"

#include "codegen/number_types.h"
#include "math/arrays.h"

namespace codesign {

template <class T>
InverseDynamics<T>::InverseDynamics(const DrivenTree& tree)
    : tree_(tree),
      joints_(tree.nodes.size()),
      motions_(tree.nodes.size() + 1),
      wrenches_(tree.nodes.size()) {}

template <class T>
const AxesMotion<T>& InverseDynamics<T>::parent(std::size_t k) const {
  return tree_.nodes[k].parent < 0 ? motions_.back() : motions_[to_index(tree_.nodes[k].parent)];
}

// A rotor turns with its joint over the gear; the body that carries it also needs the rate h' of
// its angular momentum, theory (9a).
template <class T>
T InverseDynamics<T>::load(const Constants<T>& constants, const Vector3<T>& gravity) {
  const auto pair = [&](std::size_t k) -> const PairConstants<T>& {
    return constants.pairs[to_index(tree_.nodes[k].pair)];
  };
  motions_.back().acceleration = -gravity;
  T load(0.0), unused(0.0);
  for (std::size_t k = 0; k < tree_.nodes.size(); ++k) {
    const DrivenTree::Node& node = tree_.nodes[k];
    const DrivenJoint<T>& joint = joints_[k];
    motions_[k] = move_child(parent(k), pair(k), joint.pose, &joint.position, &joint.rate,
                             &joint.acceleration);
    if (!node.moved) continue;
    const BodyConstants<T>& body = constants.bodies[to_index(node.body)];
    wrenches_[k] = inertia_wrench(body.mass, body.J, motions_[k]);
    if (!node.rotor) continue;
    const JointDynamicsConstants<T>& d = pair(k).dynamics.front();
    const T coupling = d.gear_ratio * d.rotor_inertia;
    if (k == to_index(tree_.driven))
      load =
          coupling * (d.gear_ratio * joint.acceleration + dot<T>(d.rotor_axis, parent(k).alpha)) +
          d.armature * joint.acceleration;
    else
      wrenches_[to_index(node.parent)].moment +=
          coupling * (joint.acceleration * d.rotor_axis +
                      joint.rate * cross<T>(parent(k).omega, d.rotor_axis));
  }
  for (std::size_t k = tree_.nodes.size(); --k > to_index(tree_.driven);)
    wrenches_[to_index(tree_.nodes[k].parent)] +=
        carry_back(wrenches_[k], pair(k), joints_[k].pose, &joints_[k].position, &unused);
  const DrivenJoint<T>& driven = joints_[to_index(tree_.driven)];
  T row(0.0);
  carry_back(wrenches_[to_index(tree_.driven)], pair(to_index(tree_.driven)), driven.pose,
             &driven.position, &row);
  return load + row;
}

#define CODESIGN_INSTANTIATE(T) template class InverseDynamics<T>;
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
