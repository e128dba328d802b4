// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_FOREIGN_LOOPS_H_
#define MECHANISM_CODESIGN_READING_URDF_FOREIGN_LOOPS_H_

#include "reading/urdf/read_context.h"

namespace codesign {

/// `<constraint>` of mit-biomimetics/URDF-Parser: `type="position"` makes two points coincide, a spherical loop; `type="rolling"` is a
/// coupling, its ratio written, or that of the points' distances from the axes. One that cannot be read is a warning.
void read_constraints(const XmlElement& robot, const ReadContext& context, RobotDescription* description);

/// Warns of what closes loops or couples joints in other tools and is not read: `<loop_joint>`, `<gazebo><joint>`, `drake:*_constraint`,
/// `drake:joint`, `drake:linear_bushing_rpy`, MuJoCo's `<equality>`. Each warning shows the element to write, as far as the file says it.
/// @param description with its links and joints.
void warn_of_foreign_loops(const XmlElement& robot, const RobotDescription& description, Warnings* warnings);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_FOREIGN_LOOPS_H_
