// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_DRIVEN_TREE_H_
#define MECHANISM_CODESIGN_MECHANISM_DRIVEN_TREE_H_

#include <string>
#include <vector>

#include "mechanism/topology.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// The bodies that a law of inverse dynamics looks at: those that the driven joint moves, and those that carry it.
struct DrivenTree {
  struct Node {
    int body = -1;
    int parent = -1;      ///< index of a node, or -1: the ground, or (without a pair) nothing
    int pair = -1;        ///< between parent and body; -1 for a body that only carries the driven joint
    bool slides = false;  ///< prismatic, else it turns
    bool moved = false;   ///< by the driven joint
    int controller = -1;  ///< that asks for an acceleration of this joint, or -1
    bool rotor =
        false;  ///< of an actuator, which the parent carries; theory (9a). Noted for joints that move, where accelerations are asked for
  };
  std::vector<Node> nodes;  ///< parents before children
  int driven = -1;          ///< the node whose joint is driven; -1: there is none
};

/// What a law that knows the model must find above and below the joint of `pair`.
/// @param accelerations whether accelerations are asked for, which need every body from the ground on, over revolute and prismatic joints
/// alone.
/// @param where, element the controller, for messages.
/// @throws InputError if the joint is folded with others, a loop ties what it moves to the rest, or a joint on the way is of another kind.
DrivenTree driven_tree(const Topology& topology, int pair, bool accelerations, const SourceLocation& where, const std::string& element);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_DRIVEN_TREE_H_
