// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "forces/contact_law.h"
#include "forces/contact_shape.h"
#include "math/scalar.h"
#include "mechanism/link_frames.h"
#include "mechanism/topology.h"

namespace codesign {

/// One side of a contact at one design.
template <class T>
struct ContactSide {
  int body = -1;           ///< -1: the ground
  LinkConstants<T> frame;  ///< of the shape, in the body
  ShapeNumbers<T> shape;   ///< with the clearance
  T clearance{0.0};        ///< [m]
};

/// A contact at one design; theory (13k) to (13m).
template <class T>
struct ContactConstants {
  ContactSide<T> surface, points;
  ContactNumbers<T> force;
  FrictionConstants<T> friction;
};

/// The numbers of a contact. @param links of Constants.
/// @throws InputError for a link without `<inertial>`, and for two links of one body.
template <class T>
ContactConstants<T> link_element_constants(const RobotDescription& robot, const Topology& topology,
                                           const ContactDescription& contact,
                                           const LinkFrames<T>& links,
                                           const std::vector<T>& parameters);

/// A sentence that names the first impossible number of a contact's design; empty if there is none.
std::string link_element_fault(const ContactDescription& contact,
                               const ContactConstants<double>& c);

}  // namespace codesign
