// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "description/joint_type.h"

namespace codesign {

/// The kind of a pair: the relative motion that it allows. Body i is on the parent's side, body j on the child's; z is the joint axis.
enum class PairKind {
  kFixed,          ///< none
  kRevolute,       ///< turn about z
  kPrismatic,      ///< slide along z
  kCylindrical,    ///< turn about z and slide along z
  kUniversal,      ///< turn about z_i and z_j, which keep their angle
  kSpherical,      ///< turn about any axis
  kTable,          ///< slide in the plane normal to z, no turn
  kPlanar,         ///< slide in the plane normal to z and turn about z
  kTranslational,  ///< slide anywhere, no turn
  kDistance,       ///< two points at a constant distance
  kFree            ///< any motion
};

/// The components of the reaction force F'', theory (11), that equal the multipliers of a pair's first rows.
enum class ForceRows {
  kNone,    ///< no row is a component of F''
  kAll,     ///< three rows of coincident points, in ground axes
  kAcross,  ///< two, along x'' and y''
  kAlong    ///< one, along z''
};

/// The formula of the normal force in the bearing, theory (12).
enum class BearingLaw { kPin, kRevolute, kTranslational, kPlane, kBall };

/// The properties of a kind of pair that the formulas use. A new kind needs an enumerator, an entry of kPairTraits and its constraint rows
/// in pair_rows().
struct PairTraits {
  JointType joint;         ///< joint type with the same motion, whose friction law applies; kFloating (no friction) if there is none
  int rows;                ///< number of constraint rows
  ForceRows force;         ///< the force components that the first rows of pair_rows() stand for
  bool torque_rows;        ///< whether the next rows are (T_y, -T_x, T_z) of the reaction torque T'', as far as there are rows
  BearingLaw bearing;      ///< formula of the normal force; not used by kinds that cannot have friction
  int slip_coordinates;    ///< number of slip coordinates of isotropic friction (13a); 0: each coordinate has its own friction, (13)
  int slips_of_the_point;  ///< how many of them, from the first on, make up the reported speed and friction
};

/// The properties of each kind, in the order of PairKind.
constexpr std::array<PairTraits, 11> kPairTraits{{
    {JointType::kFixed, 6, ForceRows::kAll, true, BearingLaw::kPin, 0, 0},                   // fixed
    {JointType::kRevolute, 5, ForceRows::kAll, true, BearingLaw::kRevolute, 0, 0},           // revolute
    {JointType::kPrismatic, 5, ForceRows::kAcross, true, BearingLaw::kTranslational, 0, 0},  // prismatic
    {JointType::kCylindrical, 4, ForceRows::kAcross, true, BearingLaw::kPin, 0, 0},          // cylindrical
    {JointType::kUniversal, 4, ForceRows::kAll, false, BearingLaw::kPin, 0, 0},              // universal
    {JointType::kSpherical, 3, ForceRows::kAll, false, BearingLaw::kBall, 3, 3},             // spherical
    {JointType::kPlanar, 4, ForceRows::kAlong, true, BearingLaw::kPlane, 2, 2},              // table
    {JointType::kPlanar, 3, ForceRows::kAlong, true, BearingLaw::kPlane, 3, 2},              // planar
    {JointType::kFloating, 3, ForceRows::kNone, true, BearingLaw::kPin, 0, 0},               // translational
    {JointType::kDistance, 1, ForceRows::kNone, false, BearingLaw::kPin, 0, 0},              // distance
    {JointType::kFloating, 0, ForceRows::kNone, false, BearingLaw::kPin, 0, 0},              // free
}};

constexpr const PairTraits& traits_of(PairKind kind) { return kPairTraits[static_cast<std::size_t>(kind)]; }

/// The kind of pair that a single joint or loop of this type makes.
constexpr PairKind kind_of(JointType type) {
  if (type == JointType::kContinuous) return PairKind::kRevolute;
  // Of several kinds with the same joint type, the last one allows every motion of that type; the others arise by folding.
  for (std::size_t k = kPairTraits.size(); k-- > 0;)
    if (kPairTraits[k].joint == type) return static_cast<PairKind>(k);
  return PairKind::kFree;
}

/// Whether friction in such a pair is isotropic, one law for all directions of slip, doc/theory.md (13a), instead of one law per
/// coordinate, (13).
constexpr bool slips_isotropically(PairKind kind) { return traits_of(kind).slip_coordinates > 0; }

}  // namespace codesign
