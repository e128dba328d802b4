// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/joint_law.h"

#include "codegen/traced.h"
#include "forces/normal_force.h"
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

using J = JointType;
using F = ForceRows;
constexpr Law<PairRowsFunction> kNoRows{}, kTurnless{fixed_rows, fixed_rows}, kHinge{revolute_rows, revolute_rows};
constexpr BearingLaw kPlane{{planar_normal_force, planar_normal_force}}, kPin{{pin_normal_force, pin_normal_force}, true, false, true},
    kPinHeldAlong{{revolute_normal_force, revolute_normal_force}, true, false, true},
    kRail{{translational_normal_force, translational_normal_force}, true, true, false},
    kBall{{ball_normal_force, ball_normal_force}, false, false, true};

}  // namespace

const JointLaw kFixedJoint{"fixed", "fixed", J::kFixed, 6, F::kAll, true, false, kTurnless},
    kRevoluteJoint{"revolute", "revolute", J::kRevolute, 5, F::kAll, true, true, kHinge, kPinHeldAlong},
    kContinuousJoint{"continuous", "continuous", J::kContinuous, 5, F::kAll, true, true, kHinge, kPinHeldAlong},
    kPrismaticJoint{"prismatic", "prismatic", J::kPrismatic, 5, F::kAcross, true, true, {prismatic_rows, prismatic_rows}, kRail},
    kPlanarJoint{"planar", "planar", J::kPlanar, 3, F::kAlong, true, true, {planar_rows, planar_rows}, kPlane, 3, 2},
    kFloatingJoint{"floating", nullptr, J::kFloating, 0, F::kNone, false},
    kSphericalJoint{nullptr, "codesign:spherical", J::kSpherical, 3, F::kAll, false, false, kNoRows, kBall, 3, 3},
    kUniversalJoint{nullptr, "codesign:universal", J::kUniversal, 4, F::kAll, false, true, {universal_rows, universal_rows}},
    kCylindricalJoint{nullptr, "codesign:cylindrical", J::kCylindrical, 4, F::kAcross, true, true, {cylindrical_rows, cylindrical_rows},
                      kPin},
    kDistanceJoint{nullptr, "codesign:distance", J::kDistance, 1, F::kNone, false, false, {distance_rows, distance_rows}},
    kTableJoint{nullptr, nullptr, J::kOther, 4, F::kAlong, true, true, {table_rows, table_rows}, kPlane, 2, 2},
    kTranslationalJoint{nullptr, nullptr, J::kOther, 3, F::kNone, true, true, kTurnless};

}  // namespace codesign
