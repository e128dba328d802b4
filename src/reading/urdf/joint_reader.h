// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "reading/urdf/read_context.h"

namespace codesign {

/// The attribute `type`. @param spelling of joints or of loops. @param kind the word for it in messages. @throws InputError
JointType read_joint_type(const XmlElement& element, const char* const JointTypeName::*spelling, const std::string& kind);

/// Reads a `<joint>` of the tree. @throws InputError
JointDescription read_joint(const XmlElement& element, const ReadContext& context);

/// Reads a `<loop>`, of URDF+ or with one of our types. @throws InputError
JointDescription read_loop(const XmlElement& element, const ReadContext& context);
/// Reads the parts that joints and loops have in common: axis, dynamics, friction, actuator and torsion spring.
/// @param joint its type and links must be set. @throws InputError
void read_joint_parts(const XmlElement& element, const ReadContext& context, JointDescription* joint);

}  // namespace codesign
