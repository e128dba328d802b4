// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reading/urdf/read_context.h"

namespace codesign {

/// The ratio of two links that roll on each other: the `<ratio>` given, else the ratio of the distances from the points of contact, the
/// origins of predecessor and successor, to the axes of the joints above the links; 1 without such points.
double rolling_ratio(const XmlElement& element, const CouplingDescription& coupling, const RobotDescription& robot,
                     const ParameterTable& table);

/// Reads the `<constraint>` elements of mit-biomimetics/URDF-Parser. `type="position"` and `type="spherical_joint"`, where two points
/// coincide, become a spherical loop; `type="rolling"` becomes a coupling with the ratio given or the ratio of the points' distances from
/// the joint axes. A constraint that cannot be read is ignored with a warning (`loop_ignored`).
void read_constraints(const XmlElement& robot, const ReadContext& context, RobotDescription* description);

/// Whether a loop of the description connects two links, named in either order.
bool has_loop_between(const RobotDescription& robot, const std::string& a, const std::string& b);

/// Warns (`loop_ignored`) of elements that close loops or couple joints in other tools and are not read here: `<loop_joint>`,
/// `<gazebo><joint>`, mimic and DetachableJoint plugins, `drake:*_constraint`, `drake:joint`, `drake:linear_bushing_rpy`, MuJoCo's
/// `<equality>`. Each warning shows the element to write instead, with `...` for values that the file does not give. There is no warning
/// where the description has a loop between the two links, or a coupling or `<mimic>` of the joint, already.
/// @param description must already contain the links and joints.
void warn_of_foreign_loops(const XmlElement& robot, const RobotDescription& description, Warnings* warnings);

}  // namespace codesign
