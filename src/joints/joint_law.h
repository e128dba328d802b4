// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "forces/law.h"
#include "math/scalar.h"

namespace codesign {

template <class T>
struct PairConstants;
template <class T>
struct FrictionNumbers;

/// The types of joints and loops to which other parts of a file refer, such as limits, lengths and
/// poses. kOther: only its row of the table of joints (JointLaw) tells about it.
enum class JointType {
  kFixed,
  kRevolute,
  kContinuous,
  kPrismatic,
  kPlanar,
  kFloating,
  kSpherical,
  kUniversal,
  kCylindrical,
  kDistance,
  kOther
};

template <class T>
struct PairRows;

/// Adds the constraint rows of a pair to those of coincident points, if it has these; theory (6).
template <class T>
using PairRowsFunction = void (*)(const PairConstants<T>& c, PairRows<T>* rows);
/// The normal force N [N] in the bearing as a function of the reaction F'' [N] and T'' [N m],
/// theory (12).
template <class T>
using NormalForceFunction = T (*)(const Vector3<T>& F, const Vector3<T>& torque,
                                  const FrictionNumbers<T>& c);

/// The components of the reaction force F'', theory (11), that equal the multipliers of a pair's
/// first rows.
enum class ForceRows {
  kNone,    ///< no row is a component of F''
  kAll,     ///< three rows of coincident points, in ground axes
  kAcross,  ///< two, along x'' and y''
  kAlongX,  ///< one, along x''
  kAlong    ///< one, along z''
};

/// The bearing of a joint: the formula of its normal force, none if the joint has no friction law,
/// and which dimensions it needs.
struct BearingLaw {
  Law<NormalForceFunction> normal_force{};
  bool joint_length = false, joint_width = false, pin_radius = false;
};

/// The direction of a freedom in the joint frame.
enum class FreedomAxis {
  kAxis,     ///< `<axis>` of the joint
  kInPlane,  ///< normal to it, plane_axes().x
  kAcross,   ///< normal to both, plane_axes().y
  kX,
  kY,
  kZ,  ///< of the joint frame
};

/// One motion that a joint leaves free: along an axis, or a turn about it. In a joint of the tree
/// it has a coordinate [m or rad].
struct JointFreedom {
  bool turns = false;
  FreedomAxis axis = FreedomAxis::kAxis;
};

/// What a joint leaves free: slides along directions that are normal to each other, after them
/// turns. A joint of the tree has one coordinate for each of them, in this order, and no turn, one,
/// or three about x, y and z, from which its coordinates follow in every position;
/// freedom_coordinates().
struct JointFreedoms {
  std::array<JointFreedom, 6> each{};
  int slides = 0, turns = 0;

  constexpr int size() const { return slides + turns; }
  constexpr void slide(FreedomAxis axis) {
    each[static_cast<std::size_t>(slides++)] = {false, axis};
  }
  constexpr void turn(FreedomAxis axis) {
    each[static_cast<std::size_t>(slides + turns++)] = {true, axis};
  }
};

/// A joint, one row of the table in joint_law.cc: its names, the properties of the pair of bodies
/// that it makes, and its functions of values. Body i is on the parent's side, body j on the
/// child's; z is the joint axis.
struct JointLaw {
  /// value of `<joint type>`; null: no joint of the tree has this type
  const char* of_joints = nullptr;
  const char* of_loops = nullptr;  ///< value of `<loop type>`; null: no loop has it
  /// kOther: nothing but this row depends on it; such a joint is a loop, or arises by folding
  JointType type = JointType::kOther;
  int rows = 0;                        ///< number of constraint rows
  ForceRows force = ForceRows::kNone;  ///< the force components that the first rows stand for
  /// whether the next rows are (T_y, -T_x, T_z) of the reaction torque T'', as far as there are
  /// rows
  bool torque_rows = false;
  /// whether its coordinates are scalars, which hold in all positions; theory (56)
  bool in_forest = false;
  Law<PairRowsFunction> add_rows{};
  BearingLaw bearing{};
  /// number of slip coordinates of isotropic friction (13a); 0: each coordinate has its own
  /// friction, (13)
  int slip_coordinates = 0;
  /// how many of them, from the first on, make up the reported speed and friction
  int slips_of_the_point = 0;
  /// the row of a loop of this type that is held in the plane of its motion only, theory (23c);
  /// null: there is none. It has y'' normal to the plane if the loop slides along z'', else z''
  const JointLaw* in_plane = nullptr;
  JointFreedoms freedoms{};
  /// whether a joint of the tree needs a `<limit>`, whose `lower` and `upper` bound its coordinate
  bool needs_limit = false;

  /// How many of the first rows are components of F''.
  constexpr int force_rows() const {
    return force == ForceRows::kAll      ? 3
           : force == ForceRows::kAcross ? 2
                                         : force != ForceRows::kNone;
  }
  /// Whether friction acts in a plane, whose normal force only the first row enters.
  constexpr bool is_plane() const { return slips_of_the_point == 2; }
  /// Whether it has exactly one coordinate, and with it a scalar position, velocity, acceleration
  /// and effort; whether this is an angle, or a distance.
  constexpr bool has_one_coordinate() const { return freedoms.size() == 1; }
  constexpr bool is_turn() const { return has_one_coordinate() && freedoms.turns == 1; }
  constexpr bool is_slide() const { return has_one_coordinate() && freedoms.slides == 1; }
  /// Whether it turns about its axis, and moves normal to it otherwise.
  constexpr bool turns_in_plane() const {
    bool leaves = freedoms.turns != 1;
    for (int k = 0; k < freedoms.slides; ++k)
      leaves = leaves || freedoms.each[static_cast<std::size_t>(k)].axis == FreedomAxis::kAxis;
    return !leaves;
  }
};

/// The kind of a pair: the relative motion that it allows.
class PairKind : public RowReference<JointLaw> {
 public:
  using RowReference::RowReference;
  static const PairKind kFixed,  ///< none
      kRevolute,                 ///< turn about z
      kPrismatic,                ///< slide along z
      kCylindrical,              ///< turn about z and slide along z
      kUniversal,                ///< turn about z_i and z_j, which keep their angle
      kSpherical,                ///< turn about any axis
      kTable,                    ///< slide in the plane normal to z, no turn
      kPlanar,                   ///< slide in the plane normal to z and turn about z
      kTranslational,            ///< slide anywhere, no turn
      kDistance,                 ///< two points at a constant distance
      kFree;                     ///< any motion
};

/// The row of a type; of kOther there is none by the type alone.
const JointLaw& row_of(JointType type);

/// The library's joints.
std::vector<RowReference<JointLaw>> joint_laws();

/// The kind of pair that a joint makes: a continuous joint is a revolute one without limits.
inline PairKind pair_of(const JointLaw& joint) {
  return joint.type == JointType::kContinuous ? PairKind::kRevolute : PairKind(joint);
}

/// Whether friction in such a pair is isotropic, one law for all directions of slip, doc/theory.md
/// (13a), instead of one law per coordinate, (13).
inline bool slips_isotropically(PairKind kind) { return kind->slip_coordinates > 0; }

}  // namespace codesign
