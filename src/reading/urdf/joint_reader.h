// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_READING_URDF_JOINT_READER_H_
#define MECHANISM_CODESIGN_READING_URDF_JOINT_READER_H_

#include "description/robot.h"
#include "reading/urdf/read_context.h"

namespace codesign {

/// A `<joint>` of the tree. @throws InputError
JointDescription read_joint(const XmlElement& element, const ReadContext& context);

/// A `<loop>`, of URDF+ or of ours. @throws InputError
JointDescription read_loop(const XmlElement& element, const ReadContext& context);

/// What joints and loops share: axis, dynamics, friction and torsion spring. `joint` has its type and links already.
void read_joint_parts(const XmlElement& element, const ReadContext& context, JointDescription* joint);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_READING_URDF_JOINT_READER_H_
