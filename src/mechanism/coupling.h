// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>
#include "description/quantity.h"
#include "mechanism_codesign/error.h"

namespace codesign {

struct RobotDescription;

struct Topology;

/// One joint coordinate in a coupling, with the coefficient sign * factor.
struct CouplingTerm {
  int joint = -1;
  int pair = -1, element = -1;  ///< indices of the coordinate: in Topology::pairs and in the pair's chain
  double sign = 1.0;
  Quantity factor{1.0};  ///< [-], or [m/rad], [rad/m] between a slide and a turn
};

/// A constraint row between joint coordinates: sum of coefficient * theta over the terms, minus offset, = 0; doc/theory.md (8a).
struct Coupling {
  std::string name;                 ///< of the joint with the `<mimic>`, or of the `<coupling>`
  bool is_mimic = false;            ///< from `<mimic>`, else from URDF+ `<coupling>`, or a drive
  bool is_drive = false;            ///< made by drive_of(): the row prescribes the motion of one joint coordinate
  std::vector<CouplingTerm> terms;  ///< first the coordinate that follows the others, with coefficient 1
  Quantity offset{0.0};             ///< [rad or m]
  SourceLocation where;

  /// The element for messages: `<joint name="finger"> <mimic>` or `<coupling name="gear">`.
  std::string element() const;
};

/// The rows of all `<mimic>`, then of all `<coupling>`, each in the order of the file.
///
/// Mimic: theta - multiplier * theta_other - offset = 0. A mimicking joint that moves only a link without `<inertial>` gets no row; it
/// follows kinematically. Coupling: the sum of theta from the links' nearest common ancestor to the successor, minus ratio times the sum to
/// the predecessor, = 0.
/// @throws InputError if a coupled joint moves only a link without `<inertial>`, if a joint between the links of a coupling has several
/// coordinates, or if no joint moves the successor.
std::vector<Coupling> derive_couplings(const RobotDescription& robot, const Topology& topology);

/// The row theta = 0 of one joint coordinate, whose motion is prescribed from outside; doc/theory.md (28). Its multiplier is minus the
/// effort that the motion needs. The row has no compliance.
/// @param joint index of a revolute, continuous or prismatic joint.
/// @throws InputError if the joint moves only a link without `<inertial>`.
Coupling drive_of(const RobotDescription& robot, const Topology& topology, int joint);

}  // namespace codesign
