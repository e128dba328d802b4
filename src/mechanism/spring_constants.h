// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "math/scalar.h"
#include "mechanism/link_frames.h"
#include "mechanism/topology.h"

namespace codesign {

/// A spring-damper between two points; theory (13b).
template <class T>
struct SpringDamperConstants {
  int body_i = -1, body_j = -1;                                   ///< -1: the ground
  Vector3<T> s_i = Vector3<T>::Zero(), s_j = Vector3<T>::Zero();  ///< the points on the bodies [m]
  T stiffness{0.0}, damping{0.0}, free_length{0.0};               ///< [N/m], [N s/m], [m]
};

/// The numbers of a spring-damper. @param links of Constants.
/// @throws InputError for a link without `<inertial>`.
template <class T>
SpringDamperConstants<T> link_element_constants(const RobotDescription& robot,
                                                const Topology& topology,
                                                const SpringDamperDescription& spring,
                                                const LinkFrames<T>& links,
                                                const std::vector<T>& parameters);

/// A sentence that names a spring-damper with an impossible number; empty if it has none.
std::string link_element_fault(const SpringDamperDescription& spring,
                               const SpringDamperConstants<double>& c);

}  // namespace codesign
