// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_TOPOLOGY_H_
#define MECHANISM_CODESIGN_MECHANISM_TOPOLOGY_H_

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism/coupling.h"

namespace codesign {

/// Rigid body: a link with everything fixed to it.
struct Body {
  std::string name;        ///< of its base link
  int base_link = -1;      ///< the link nearest to the root; its axes are the body's axes
  std::vector<int> links;  ///< the base link first
};

/// What a pair of bodies may do relative to each other. `i` carries the parent's side, `j` the child's; z is the joint axis.
enum class PairKind {
  kFixed,          ///< 6 constraints
  kRevolute,       ///< 5: turn about z
  kPrismatic,      ///< 5: slide along z
  kCylindrical,    ///< 4: both
  kUniversal,      ///< 4: turn about z_i and about z_j
  kSpherical,      ///< 3
  kTable,          ///< 4: slide in the plane normal to z, no turn
  kPlanar,         ///< 3: slide in the plane normal to z and turn about z
  kTranslational,  ///< 3: slide anywhere, no turn
  kDistance,       ///< 1: two points at a constant distance
  kFree            ///< 0
};

/// One URDF joint (or loop) of a pair's chain; `reversed` where the chain runs from its child to its parent.
struct ChainElement {
  int joint = -1;
  bool reversed = false;
};

/// A kinematic pair: one joint or loop, or a chain of them across massless links, folded into one joint.
struct Pair {
  std::string name;
  PairKind kind = PairKind::kFree;
  int body_i = -1, body_j = -1;     ///< -1: the ground
  std::vector<ChainElement> chain;  ///< from i to j
  int friction_joint = -1;          ///< the joint of the chain whose friction annotation holds, or -1
  bool is_loop = false;             ///< a loop is part of the chain
};

/// Whether the friction of such a pair acts in all directions of its slip by one law, instead of along each coordinate; doc/theory.md
/// (13a).
constexpr bool slips_isotropically(PairKind kind) {
  return kind == PairKind::kTable || kind == PairKind::kPlanar || kind == PairKind::kSpherical;
}

/// What a mechanism consists of, derived from its description; immutable.
struct Topology {
  static constexpr int kGround = -1;
  static constexpr int kMassless = -2;

  std::vector<Body> bodies;
  std::vector<Pair> pairs;
  std::vector<int> link_body;          ///< per link: body index, kGround or kMassless
  std::vector<int> link_base;          ///< per link: base link of its rigid group
  std::vector<int> link_parent_joint;  ///< per link: the tree joint above it, -1 for the root
  std::vector<int> joint_pair;         ///< per joint: its pair, or -1 (fixed inside a body; moves a massless end link)
  std::vector<Coupling> couplings;
};

/// Merges links joined by fixed joints and folds massless chains.
/// @throws InputError for a chain that cannot be folded, or a massless link that would have to carry a load.
Topology derive_topology(const RobotDescription& robot);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_TOPOLOGY_H_
