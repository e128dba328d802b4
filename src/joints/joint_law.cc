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

constexpr BearingLaw bearing(Law<NormalForceFunction> normal_force) {
  BearingLaw law;
  law.normal_force = normal_force;
  return law;
}
constexpr BearingLaw hinge(Law<NormalForceFunction> normal_force) {
  BearingLaw law = bearing(normal_force);
  law.joint_length = law.pin_radius = true;
  return law;
}
constexpr BearingLaw rail() {
  BearingLaw law = bearing({translational_normal_force, translational_normal_force});
  law.joint_length = law.joint_width = true;
  return law;
}
constexpr BearingLaw ball() {
  BearingLaw law = bearing({ball_normal_force, ball_normal_force});
  law.pin_radius = true;
  return law;
}
constexpr BearingLaw kPlane = bearing({planar_normal_force, planar_normal_force});
constexpr BearingLaw kPin = hinge({pin_normal_force, pin_normal_force});
constexpr BearingLaw kPinHeldAlong = hinge({revolute_normal_force, revolute_normal_force});

using A = FreedomAxis;

constexpr JointLaw make_row(J type, int rows, F force) {
  JointLaw law;
  law.type = type;
  law.rows = rows;
  law.force = force;
  return law;
}

constexpr JointLaw fixed_in_plane() {
  JointLaw law = make_row(J::kFixed, 3, F::kAcross);
  law.add_rows = {fixed_rows_in_plane, fixed_rows_in_plane};
  return law;
}

constexpr JointLaw revolute_in_plane() {
  JointLaw law = make_row(J::kRevolute, 2, F::kAcross);
  law.add_rows = {revolute_rows_in_plane, revolute_rows_in_plane};
  law.bearing = kPinHeldAlong;
  law.freedoms.turn(A::kAxis);
  return law;
}

constexpr JointLaw prismatic_in_plane() {
  JointLaw law = make_row(J::kPrismatic, 2, F::kAlongX);
  law.torque_rows = true;
  law.add_rows = {prismatic_rows_in_plane, prismatic_rows_in_plane};
  law.bearing = rail();
  law.freedoms.slide(A::kAxis);
  return law;
}

constexpr JointLaw kFixedInPlane = fixed_in_plane(), kRevoluteInPlane = revolute_in_plane(),
                   kPrismaticInPlane = prismatic_in_plane();

constexpr JointLaw fixed() {
  JointLaw law = make_row(J::kFixed, 6, F::kAll);
  law.of_joints = law.of_loops = "fixed";
  law.torque_rows = true;
  law.add_rows = {fixed_rows, fixed_rows};
  law.in_plane = &kFixedInPlane;
  return law;
}

constexpr JointLaw revolute(J type, const char* name) {
  JointLaw law = make_row(type, 5, F::kAll);
  law.of_joints = law.of_loops = name;
  law.torque_rows = law.in_forest = true;
  law.add_rows = {revolute_rows, revolute_rows};
  law.bearing = kPinHeldAlong;
  law.in_plane = &kRevoluteInPlane;
  law.freedoms.turn(A::kAxis);
  law.needs_limit = type == J::kRevolute;
  return law;
}

constexpr JointLaw prismatic() {
  JointLaw law = make_row(J::kPrismatic, 5, F::kAcross);
  law.of_joints = law.of_loops = "prismatic";
  law.torque_rows = law.in_forest = true;
  law.add_rows = {prismatic_rows, prismatic_rows};
  law.bearing = rail();
  law.in_plane = &kPrismaticInPlane;
  law.freedoms.slide(A::kAxis);
  law.needs_limit = true;
  return law;
}

constexpr JointLaw planar() {
  JointLaw law = make_row(J::kPlanar, 3, F::kAlong);
  law.of_joints = law.of_loops = "planar";
  law.torque_rows = law.in_forest = true;
  law.add_rows = {planar_rows, planar_rows};
  law.bearing = kPlane;
  law.slip_coordinates = 3;
  law.slips_of_the_point = 2;
  law.freedoms.slide(A::kInPlane);
  law.freedoms.slide(A::kAcross);
  law.freedoms.turn(A::kAxis);
  return law;
}

constexpr JointLaw floating() {
  JointLaw law = make_row(J::kFloating, 0, F::kNone);
  law.of_joints = "floating";
  for (A axis : {A::kX, A::kY, A::kZ}) law.freedoms.slide(axis);
  for (A axis : {A::kX, A::kY, A::kZ}) law.freedoms.turn(axis);
  return law;
}

constexpr JointLaw spherical() {
  JointLaw law = make_row(J::kSpherical, 3, F::kAll);
  law.of_joints = "spherical";
  law.of_loops = "codesign:spherical";
  law.bearing = ball();
  law.slip_coordinates = law.slips_of_the_point = 3;
  for (A axis : {A::kX, A::kY, A::kZ}) law.freedoms.turn(axis);
  return law;
}

constexpr JointLaw universal() {
  JointLaw law = make_row(J::kUniversal, 4, F::kAll);
  law.of_loops = "codesign:universal";
  law.in_forest = true;
  law.add_rows = {universal_rows, universal_rows};
  law.freedoms.turn(A::kAxis);
  law.freedoms.turn(A::kAxis);
  return law;
}

constexpr JointLaw cylindrical() {
  JointLaw law = make_row(J::kCylindrical, 4, F::kAcross);
  law.of_joints = "cylindrical";
  law.of_loops = "codesign:cylindrical";
  law.torque_rows = law.in_forest = true;
  law.add_rows = {cylindrical_rows, cylindrical_rows};
  law.bearing = kPin;
  law.freedoms.slide(A::kAxis);
  law.freedoms.turn(A::kAxis);
  return law;
}

constexpr JointLaw distance() {
  JointLaw law = make_row(J::kDistance, 1, F::kNone);
  law.of_loops = "codesign:distance";
  law.add_rows = {distance_rows, distance_rows};
  return law;
}

/// A folded chain of two slides.
constexpr JointLaw table() {
  JointLaw law = make_row(J::kOther, 4, F::kAlong);
  law.torque_rows = law.in_forest = true;
  law.add_rows = {table_rows, table_rows};
  law.bearing = kPlane;
  law.slip_coordinates = law.slips_of_the_point = 2;
  return law;
}

/// A folded chain of three slides.
constexpr JointLaw translational() {
  JointLaw law = make_row(J::kOther, 3, F::kNone);
  law.torque_rows = law.in_forest = true;
  law.add_rows = {fixed_rows, fixed_rows};
  return law;
}

constexpr JointLaw kJointTable[] = {fixed(),
                                    revolute(J::kRevolute, "revolute"),
                                    revolute(J::kContinuous, "continuous"),
                                    prismatic(),
                                    planar(),
                                    floating(),
                                    spherical(),
                                    universal(),
                                    cylindrical(),
                                    distance(),
                                    table(),
                                    translational()};

// A constant expression, so that the constants below exist before any static object is made.
constexpr const JointLaw& find_row(JointType type) {
  std::size_t k = 0;
  while (kJointTable[k].type != type) ++k;
  return kJointTable[k];
}

}  // namespace

const JointLaw& row_of(JointType type) { return find_row(type); }

const PairKind PairKind::kFixed{find_row(J::kFixed)}, PairKind::kRevolute{find_row(J::kRevolute)},
    PairKind::kPrismatic{find_row(J::kPrismatic)},
    PairKind::kCylindrical{find_row(J::kCylindrical)},
    PairKind::kUniversal{find_row(J::kUniversal)}, PairKind::kSpherical{find_row(J::kSpherical)},
    PairKind::kPlanar{find_row(J::kPlanar)}, PairKind::kDistance{find_row(J::kDistance)},
    PairKind::kFree{find_row(J::kFloating)}, PairKind::kTable{kJointTable[10]},
    PairKind::kTranslational{kJointTable[11]};

std::vector<RowReference<JointLaw>> joint_laws() {
  return std::vector<RowReference<JointLaw>>(std::begin(kJointTable), std::end(kJointTable));
}

}  // namespace codesign
