// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

struct Topology;

/// The bodies that enter the inverse dynamics of a driven joint, theory (C4): the bodies that it moves and the bodies that carry it.
struct DrivenTree {
  struct Node {
    int body = -1;
    int parent = -1;      ///< index of the parent's node; -1: the ground or, if `pair` is -1, not needed
    int pair = -1;        ///< the pair between parent and body; -1 for a body of which only the driven joint's axis is needed
    bool slides = false;  ///< the joint is prismatic, else it turns
    bool moved = false;   ///< the driven joint moves this body
    int controller = -1;  ///< index of the controller that prescribes an acceleration of this joint, or -1
    /// The joint has an actuator, whose rotor the parent carries; theory (9a). Set only if accelerations are prescribed.
    bool rotor = false;
  };
  std::vector<Node> nodes;  ///< parents before children
  int driven = -1;          ///< index of the node whose joint is driven; -1 if there is no driven joint
};

/// The tree for the joint of `pair`, for gravity compensation (C5) or computed torque (C6).
/// @param accelerations whether accelerations are prescribed. The tree then reaches down to the ground and may contain revolute and
/// prismatic joints only.
/// @param where, element the controller, for messages.
/// @throws InputError if the joint is folded with others, if a loop connects bodies that it moves with bodies that it does not move, or if
/// a joint of the tree has another type.
DrivenTree driven_tree(const Topology& topology, int pair, bool accelerations, const SourceLocation& where, const std::string& element);

}  // namespace codesign
