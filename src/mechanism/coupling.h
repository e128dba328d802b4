// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/expression.h"
#include "mechanism_codesign/error.h"

namespace codesign {

struct RobotDescription;
struct Topology;

/// One joint coordinate in a coupling, with the coefficient sign * factor.
struct CouplingTerm {
  int joint = -1;
  /// indices of the coordinate: in Topology::pairs and in the pair's chain
  int pair = -1, element = -1;
  double sign = 1.0;
  Quantity factor{1.0};  ///< [-], or [m/rad], [rad/m] between a slide and a turn
};

/// A constraint row between joint coordinates: sum of coefficient * theta over the terms, minus
/// offset, = 0; doc/theory.md (8a).
struct Coupling {
  std::string name;       ///< of the joint with the `<mimic>`, or of the `<coupling>`
  bool is_mimic = false;  ///< from `<mimic>`, else from URDF+ `<coupling>`, or a drive
  /// made by drive_of(): the row prescribes the motion of one joint coordinate
  bool is_drive = false;
  /// of a drive: index into Study::motion, which gives the motion; -1: it comes from outside
  int motion = -1;
  /// first the coordinate that follows the others, with coefficient 1
  std::vector<CouplingTerm> terms;
  Quantity offset{0.0};  ///< [rad or m]
  SourceLocation where;

  /// The element for messages: `<joint name="finger"> <mimic>`, `<coupling name="gear">` or
  /// `motion.crank`.
  std::string element() const;
};

/// The rows of all `<mimic>`, then of all `<coupling>`, each in the order of the file.
///
/// Mimic: theta - multiplier * theta_other - offset = 0. A mimicking joint that moves only a link
/// without `<inertial>` gets no row; it follows kinematically. Coupling: the sum of theta from the
/// links' nearest common ancestor to the successor, minus ratio times the sum to the predecessor, =
/// 0.
/// @throws InputError if a coupled joint moves only a link without `<inertial>`, if a joint between
/// the links of a coupling has several coordinates, or if no joint moves the successor.
std::vector<Coupling> derive_couplings(const RobotDescription& robot, const Topology& topology);

/// The row theta = 0 of one joint coordinate, whose motion is prescribed: by a study, theory (8b),
/// or from outside, theory (28). Its multiplier is minus the effort that the motion needs. The row
/// has no compliance.
/// @param joint index of a revolute, continuous or prismatic joint.
/// @throws InputError if the joint moves only a link without `<inertial>`.
Coupling drive_of(const RobotDescription& robot, const Topology& topology, int joint);

/// The bodies that enter the inverse dynamics of a driven joint, theory (C4): the bodies that it
/// moves and the bodies that carry it.
struct DrivenTree {
  struct Node {
    int body = -1;
    /// index of the parent's node; -1: the ground or, if `pair` is -1, not needed
    int parent = -1;
    /// the pair between parent and body; -1 for a body of which only the driven joint's axis is
    /// needed
    int pair = -1;
    bool slides = false;  ///< the joint is prismatic, else it turns
    bool moved = false;   ///< the driven joint moves this body
    /// index of the controller that prescribes an acceleration of this joint, or -1
    int controller = -1;
    /// The joint has an actuator, whose rotor the parent carries, (9a), or an armature, (9e). Set
    /// only if accelerations are prescribed.
    bool rotor = false;
  };
  std::vector<Node> nodes;  ///< parents before children
  int driven = -1;  ///< index of the node whose joint is driven; -1 if there is no driven joint
};

/// The tree for the joint of `pair`, for gravity compensation (C5) or computed torque (C6).
/// @param accelerations whether accelerations are prescribed. The tree then reaches down to the
/// ground and may contain revolute and prismatic joints only.
/// @param where, element the controller, for messages.
/// @throws InputError if the joint is folded with others, if a loop connects bodies that it moves
/// with bodies that it does not move, or if a joint of the tree has another type.
DrivenTree driven_tree(const Topology& topology, int pair, bool accelerations,
                       const SourceLocation& where, const std::string& element);

}  // namespace codesign
