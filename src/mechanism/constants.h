// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "description/robot.h"
#include "joints/pair_constants.h"
#include "math/scalar.h"
#include "mechanism/contact_constants.h"
#include "mechanism/mass_properties.h"
#include "mechanism/rigid_groups.h"
#include "mechanism/spring_constants.h"
#include "mechanism/topology.h"

namespace codesign {

/// Mass properties of a body. The body frame has the axes of the base link and its origin at the
/// centre of mass.
template <class T>
struct BodyConstants {
  T mass{0.0};                        ///< [kg]
  Matrix3<T> J = Matrix3<T>::Zero();  ///< inertia about the centre of mass, in body axes [kg m^2]
  Vector3<T> centre = Vector3<T>::Zero();  ///< centre of mass in the base link's frame [m]
};

/// The row sum_k coefficients[k] theta_k - offset = 0; theory (8a). Terms in the order of
/// Coupling::terms.
template <class T>
struct CouplingConstants {
  std::vector<T> coefficients;
  T offset{0.0};  ///< [rad or m]
};

/// The numbers of the elements between two links, as RobotDescription has them.
template <class T>
struct LinkElementConstants {
  std::vector<SpringDamperConstants<T>> springs;
  std::vector<ContactConstants<T>> contacts;
};
/// Calls visit(list of the model, list of its numbers) for each kind.
template <class Numbers, class Visit>
void for_each_link_element_list(const RobotDescription& of, Numbers& numbers, const Visit& visit) {
  visit(of.spring_dampers, numbers.springs);
  visit(of.contacts, numbers.contacts);
}

/// All numbers of a mechanism for one design. Indices as in Topology and RobotDescription.
template <class T>
struct Constants : LinkElementConstants<T> {
  std::vector<BodyConstants<T>> bodies;
  std::vector<PairConstants<T>> pairs;
  /// per link; valid for links that belong to a body or the ground
  std::vector<LinkConstants<T>> links;
  /// per joint: its frame, fixed in the child (of a loop: the successor); valid likewise
  std::vector<LinkConstants<T>> joint_frames;
  std::vector<CouplingConstants<T>> couplings;
};

/// Evaluates the description at `parameters`, all named parameters in the order of
/// Study::parameters.
/// @param workspace, constants overwritten; their memory is used again, so that later designs of
/// the same mechanism allocate nothing.
/// @throws InputError for a spring-damper or a contact of a link without <inertial>, and as
/// link_element_constants().
template <class T>
void evaluate_constants(const RobotDescription& robot, const Topology& topology,
                        const std::vector<T>& parameters, MassWorkspace<T>* workspace,
                        Constants<T>* constants);
template <class T>
Constants<T> evaluate_constants(const RobotDescription& robot, const Topology& topology,
                                const std::vector<T>& parameters) {
  Constants<T> constants;
  MassWorkspace<T> workspace;
  evaluate_constants(robot, topology, parameters, &workspace, &constants);
  return constants;
}

/// A sentence that names the first impossible mass, inertia, length or coefficient of a design;
/// empty if there is none. A mass fault that a body also has at the default parameters does not
/// count, since check_bodies() warned of it.
std::string find_impossible(const RobotDescription& robot, const Topology& topology,
                            const Constants<double>& constants);

/// The default values of the model's parameters, in the order of RobotDescription::parameters.
inline std::vector<double> default_values(const RobotDescription& robot) {
  std::vector<double> values;
  for (const Parameter& parameter : robot.parameters) values.push_back(parameter.value);
  return values;
}

/// Mass properties that no solid body can have.
struct MassFault {
  /// negative_mass, inertia_not_positive, triangle_inequality, or empty if there is no fault
  std::string code;
  std::string message;  ///< for example "the inertia breaks the triangle inequality"
  std::string value;    ///< the offending numbers
};

/// Finds a negative mass, a negative principal moment of inertia, or a principal moment above the
/// sum of the other two. The tolerances, 1e-9 and 1e-6 relative, allow for rounded files. Bodies
/// without mass, points, rods and flat bodies have no fault; whether the equations determine their
/// motion is checked elsewhere, theory (14a).
MassFault find_mass_fault(const MassProperties<double>& body);

/// Warns of mass faults at the default parameters. Links joined by fixed joints count as one body;
/// the root link, which is the ground, is not checked.
/// @throws InputError if the masses of a body's links add up to zero, since it then has no centre
/// of mass.
void check_bodies(const RobotDescription& robot, Warnings* warnings);

}  // namespace codesign
