// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_COUPLING_H_
#define MECHANISM_CODESIGN_MECHANISM_COUPLING_H_

#include <string>
#include <vector>

#include "description/robot.h"

namespace codesign {

struct Topology;

/// One joint coordinate in a coupling; its coefficient is sign * factor.
struct CouplingTerm {
  int joint = -1;
  int pair = -1, element = -1;  ///< where the coordinate is read: Topology::pairs and its chain element
  double sign = 1.0;
  Quantity factor{1.0};  ///< [-], or [m/rad], [rad/m] between a slide and a turn
};

/// A row between joint coordinates, sum of coefficients times theta, minus offset = 0; doc/theory.md (8a).
struct Coupling {
  std::string name;                 ///< of the joint that mimics, or of the `<coupling>`
  bool is_mimic = false;            ///< `<mimic>`, else URDF+ `<coupling>`
  std::vector<CouplingTerm> terms;  ///< the coordinate that follows the others stands first, with coefficient 1
  Quantity offset{0.0};             ///< [rad or m]
  SourceLocation where;

  /// `<joint name="finger"> <mimic>` or `<coupling name="gear">`.
  std::string element() const;
};

/// The rows of all `<mimic>` and `<coupling>`, mimics first, each in the order of the file:
/// a joint that mimics another: theta - multiplier theta_other - offset = 0;
/// URDF+ coupling: theta summed from the links' nearest common ancestor to the successor, minus ratio times the sum to the predecessor.
/// A joint that mimics and moves only a link without `<inertial>` follows without a row.
/// @throws InputError if a coordinate has no dynamics, or a joint on a coupling's way has not exactly one coordinate.
std::vector<Coupling> derive_couplings(const RobotDescription& robot, const Topology& topology);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_COUPLING_H_
