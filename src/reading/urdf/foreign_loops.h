// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_FOREIGN_LOOPS_H_
#define MECHANISM_CODESIGN_READING_URDF_FOREIGN_LOOPS_H_

#include "reading/urdf/read_context.h"

namespace codesign {

/// Reads the `<constraint>` elements of mit-biomimetics/URDF-Parser. `type="position"`, where two points coincide, becomes a spherical
/// loop; `type="rolling"` becomes a coupling with the ratio given or the ratio of the points' distances from the joint axes. A constraint
/// that cannot be read is ignored with a warning (`loop_ignored`).
void read_constraints(const XmlElement& robot, const ReadContext& context, RobotDescription* description);

/// Warns (`loop_ignored`) of elements that close loops or couple joints in other tools and are not read here: `<loop_joint>`,
/// `<gazebo><joint>` and mimic plugins, `drake:*_constraint`, `drake:joint`, `drake:linear_bushing_rpy`, MuJoCo's `<equality>`. Each
/// warning shows the element to write instead, with `...` for values that the file does not give.
/// @param description must already contain the links and joints.
void warn_of_foreign_loops(const XmlElement& robot, const RobotDescription& description, Warnings* warnings);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_FOREIGN_LOOPS_H_
