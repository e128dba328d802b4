// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "reading/urdf/read_context.h"

namespace codesign {

/// Reads the attribute `type` of a joint, or of a loop if `joint` is one. @throws InputError
void read_joint_type(const XmlElement& element, const Laws& laws, JointDescription* joint);

/// Reads a `<joint>` of the tree. @throws InputError
JointDescription read_joint(const XmlElement& element, const ReadContext& context);

/// Reads a `<loop>`, of URDF+ or with one of our types. @throws InputError
JointDescription read_loop(const XmlElement& element, const ReadContext& context);
/// Reads the parts that joints and loops have in common: axis, dynamics, friction, actuator and torsion spring.
/// @param joint its type and links must be set. @throws InputError
void read_joint_parts(const XmlElement& element, const ReadContext& context, JointDescription* joint);

}  // namespace codesign
