// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/joint_law.h"

#include <iterator>

#include "codegen/traced.h"
#include "forces/normal_force.h"
#include "joints/pair_constants.h"
#include "joints/pair_rows.h"

namespace codesign {
namespace {

template <class T>
void fixed_rows(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_parallel();
  rows->keep_from_turning();
}

template <class T>
void revolute_rows(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_parallel();
}

template <class T>
void cylindrical_rows(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_in_plane(0);
  rows->keep_in_plane(1);
  rows->keep_parallel();
}

template <class T>
void prismatic_rows(const PairConstants<T>& c, PairRows<T>* rows) {
  cylindrical_rows(c, rows);
  rows->keep_from_turning();
}

template <class T>
void planar_rows(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_in_plane(2);
  rows->keep_parallel();
}

template <class T>
void table_rows(const PairConstants<T>& c, PairRows<T>* rows) {
  planar_rows(c, rows);
  rows->keep_from_turning();
}

template <class T>
void universal_rows(const PairConstants<T>& c, PairRows<T>* rows) {
  rows->add(rows->axis(Side::kI, 2), rows->axis(Side::kJ, 2), c.cosine);
}

template <class T>
void distance_rows(const PairConstants<T>& c, PairRows<T>* rows) {
  rows->add(rows->displacement(), rows->displacement(), c.distance * c.distance, 0.5);
}

// In the plane of motion, theory (23c): what revolute_rows() and prismatic_rows() hold in it.
template <class T>
void revolute_rows_in_plane(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_in_plane(0);
  rows->keep_in_plane(1);
}

template <class T>
void prismatic_rows_in_plane(const PairConstants<T>&, PairRows<T>* rows) {
  rows->keep_in_plane(0);
  rows->add(rows->axis(Side::kI, 0), rows->axis(Side::kJ, 2));
}

template <class T>
void fixed_rows_in_plane(const PairConstants<T>& c, PairRows<T>* rows) {
  revolute_rows_in_plane(c, rows);
  rows->keep_from_turning();
}

using J = JointType;
using F = ForceRows;
constexpr Law<PairRowsFunction> kNoRows{}, kTurnless{fixed_rows, fixed_rows},
    kHinge{revolute_rows, revolute_rows};
constexpr BearingLaw kPlane{{planar_normal_force, planar_normal_force}},
    kPin{{pin_normal_force, pin_normal_force}, true, false, true},
    kPinHeldAlong{{revolute_normal_force, revolute_normal_force}, true, false, true},
    kRail{{translational_normal_force, translational_normal_force}, true, true, false},
    kBall{{ball_normal_force, ball_normal_force}, false, false, true};

// of_joints, of_loops, type, rows, force, torque_rows, in_forest, add_rows, bearing,
// slip_coordinates, slips_of_the_point, in_plane
constexpr JointLaw kFixedInPlane{
    nullptr,    nullptr, J::kFixed, 3,
    F::kAcross, false,   false,     {fixed_rows_in_plane, fixed_rows_in_plane}},
    kRevoluteInPlane{
        nullptr,      nullptr, J::kRevolute, 2,
        F::kAcross,   false,   false,        {revolute_rows_in_plane, revolute_rows_in_plane},
        kPinHeldAlong},
    kPrismaticInPlane{
        nullptr,    nullptr, J::kPrismatic, 2,
        F::kAlongX, true,    false,         {prismatic_rows_in_plane, prismatic_rows_in_plane},
        kRail};
constexpr JointLaw kJointTable[] = {
    {"fixed", "fixed", J::kFixed, 6, F::kAll, true, false, kTurnless, {}, 0, 0, &kFixedInPlane},
    {"revolute", "revolute", J::kRevolute, 5, F::kAll, true, true, kHinge, kPinHeldAlong, 0, 0,
     &kRevoluteInPlane},
    {"continuous", "continuous", J::kContinuous, 5, F::kAll, true, true, kHinge, kPinHeldAlong, 0,
     0, &kRevoluteInPlane},
    {"prismatic",
     "prismatic",
     J::kPrismatic,
     5,
     F::kAcross,
     true,
     true,
     {prismatic_rows, prismatic_rows},
     kRail,
     0,
     0,
     &kPrismaticInPlane},
    {"planar",
     "planar",
     J::kPlanar,
     3,
     F::kAlong,
     true,
     true,
     {planar_rows, planar_rows},
     kPlane,
     3,
     2},
    {"floating", nullptr, J::kFloating, 0, F::kNone, false},
    {nullptr, "codesign:spherical", J::kSpherical, 3, F::kAll, false, false, kNoRows, kBall, 3, 3},
    {nullptr,
     "codesign:universal",
     J::kUniversal,
     4,
     F::kAll,
     false,
     true,
     {universal_rows, universal_rows}},
    {nullptr,
     "codesign:cylindrical",
     J::kCylindrical,
     4,
     F::kAcross,
     true,
     true,
     {cylindrical_rows, cylindrical_rows},
     kPin},
    {nullptr,
     "codesign:distance",
     J::kDistance,
     1,
     F::kNone,
     false,
     false,
     {distance_rows, distance_rows}},
    {nullptr, nullptr, J::kOther, 4, F::kAlong, true, true, {table_rows, table_rows}, kPlane, 2, 2},
    {nullptr, nullptr, J::kOther, 3, F::kNone, true, true, kTurnless},
};

constexpr const JointLaw& row_of(JointType type) {
  std::size_t k = 0;
  while (kJointTable[k].type != type) ++k;
  return kJointTable[k];
}

}  // namespace

const PairKind PairKind::kFixed{row_of(J::kFixed)}, PairKind::kRevolute{row_of(J::kRevolute)},
    PairKind::kPrismatic{row_of(J::kPrismatic)}, PairKind::kCylindrical{row_of(J::kCylindrical)},
    PairKind::kUniversal{row_of(J::kUniversal)}, PairKind::kSpherical{row_of(J::kSpherical)},
    PairKind::kPlanar{row_of(J::kPlanar)}, PairKind::kDistance{row_of(J::kDistance)},
    PairKind::kFree{row_of(J::kFloating)}, PairKind::kTable{kJointTable[10]},
    PairKind::kTranslational{kJointTable[11]};

std::vector<RowReference<JointLaw>> joint_laws() {
  return std::vector<RowReference<JointLaw>>(std::begin(kJointTable), std::end(kJointTable));
}

}  // namespace codesign
