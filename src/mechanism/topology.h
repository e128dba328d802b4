// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism/coupling.h"

namespace codesign {

/// A rigid body: a link and all links joined to it by fixed joints.
struct Body {
  std::string name;        ///< name of the base link
  int base_link = -1;      ///< the link nearest to the root; its axes are the body's axes
  std::vector<int> links;  ///< indices of its links, the base link first
};

/// A joint or loop in the chain of a pair. `reversed`: the chain runs from the joint's child to its
/// parent.
struct ChainElement {
  int joint = -1;
  bool reversed = false;
};

/// A kinematic pair: one joint or loop, or a chain of them across massless links that is folded
/// into one joint.
struct Pair {
  std::string name;
  PairKind kind = PairKind::kFree;
  int body_i = -1, body_j = -1;     ///< -1: the ground
  std::vector<ChainElement> chain;  ///< from i to j
  int friction_joint = -1;          ///< the joint of the chain with a `<codesign:friction>`, or -1
  bool friction_is_direct = false;  ///< that friction is in N m or N; theory (10a)
  bool is_loop = false;             ///< the chain contains a loop
  /// Of a loop that is held in the plane of its motion only, theory (23c): the joints around it,
  /// from body i through the tree and the loop back to body i; else empty.
  std::vector<ChainElement> around;
};

/// A coordinate: index in Topology::pairs and in the pair's chain.
struct CoordinateIndex {
  int pair = -1, element = -1;

  bool operator==(const CoordinateIndex& other) const {
    return pair == other.pair && element == other.element;
  }
};

/// The bodies, pairs and couplings of a mechanism, derived from its description. It does not depend
/// on the design.
struct Topology {
  static constexpr int kGround = -1;  ///< body index of links that are fixed to the root
  /// Body index of links without mass inside a folded chain or at its end.
  static constexpr int kMassless = -2;

  std::vector<Body> bodies;
  std::vector<Pair> pairs;
  std::vector<int> link_body;          ///< per link: body index, kGround or kMassless
  std::vector<int> link_base;          ///< per link: base link of its rigid group
  std::vector<int> link_parent_joint;  ///< per link: the tree joint above it, -1 for the root
  /// per joint: its pair; -1 if it is fixed inside a body or moves only massless links
  std::vector<int> joint_pair;
  std::vector<Coupling> couplings;
};

/// Merges links joined by fixed joints into bodies and folds chains of massless links into pairs.
/// @throws InputError for a chain that cannot be folded, for two friction annotations on one pair,
/// for a loop within one body, for a loop held in a plane that is not planar at the default
/// parameters, and for couplings as derive_couplings() says.
Topology derive_topology(const RobotDescription& robot);

/// The links from `link`, included, up to the root.
/// @param link_parent_joint per link: the tree joint above it, -1 for the root.
std::vector<int> links_above(const RobotDescription& robot,
                             const std::vector<int>& link_parent_joint, int link);

/// The tree joints that are not fixed on the path between two links, which passes through their
/// nearest common ancestor.
std::vector<int> joints_between(const RobotDescription& robot,
                                const std::vector<int>& link_parent_joint, int predecessor,
                                int successor);

}  // namespace codesign
